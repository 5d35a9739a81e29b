// What an overlay draws lies on the pixels at which the tracers show the same points.

#include "renderer/camera_rays.h"
#include "renderer/cpu_tracer.h"
#include "renderer/overlay/overlay_renderer.h"
#include "tests/overlay/overlay_pictures.h"
#include "tests/renderer/test_scenes.h"
#include "tests/support/gl_context.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

namespace {

using namespace encore;
using renderer::CameraFrame;
using renderer::kOverlayBoxFilled;
using renderer::OverlayBlock;
using renderer::OverlayBox;
using renderer::OverlayPoint;
using renderer::OverlayRenderer;
using renderer::OverlaySegment;
using renderer::OverlayView;
using test::Codes;
using test::drawn;
using test::kRed;
using test::kWhite;
using OverlayProjection = test::GlTest;

constexpr int kWidth = 61;
constexpr int kHeight = 47;

/// Two cameras, with perspective and without, at a scale and a place.
std::vector<scene::Camera> cameras(float scale) {
  scene::Camera camera{.eye = glm::vec3(3.0F, -2.0F, 7.0F) * scale,
                       .target = glm::vec3(-1.0F, 0.5F, 0.0F) * scale,
                       .up = {0.1F, 1.0F, 0.0F},
                       .vertical_fov_degrees = 70.0F};
  scene::Camera flat = camera;
  flat.orthographic_height = 9.0F * scale;
  return {camera, flat};
}

/// A point on the ray through a pixel's centre.
glm::vec3 point_at(const scene::Camera& camera, int x, int y, double distance) {
  const CameraFrame frame = renderer::make_camera_frame(camera, kWidth, kHeight);
  std::vector<scene::Ray> rays(1);
  renderer::camera_rays(frame, {x, y, x + 1, y + 1}, rays);
  return glm::vec3(glm::dvec3(rays[0].origin) + distance * glm::dvec3(rays[0].direction));
}

TEST_F(OverlayProjection, APointOnAPixelsRayIsThatPixelAtEveryScale) {
  OverlayRenderer overlay(context_);
  for (const float scale : {1e-18F, 1e-3F, 1.0F, 1e6F, 1e18F}) {
    for (const scene::Camera& camera : cameras(scale)) {
      for (const auto& [x, y] : {std::pair{0, 0}, {60, 0}, {11, 40}, {30, 23}, {60, 46}}) {
        const OverlayPoint point{point_at(camera, x, y, 5.0 * double{scale}), kRed, 1.0F};
        const Codes codes = drawn(overlay, test::black_view(camera, kWidth, kHeight),
                                  {.points = std::span(&point, 1)});
        // A disc of one pixel around the centre leaves next to nothing to the neighbours.
        EXPECT_GT(codes.red(x, y), 250) << scale << ": " << x << ", " << y;
        EXPECT_LT(codes.red_sum(), 270U) << scale << ": " << x << ", " << y;
      }
    }
  }
}

TEST_F(OverlayProjection, ShadersAndPickingPlaceAPointAlike) {
  for (const scene::Camera& camera : cameras(1.0F)) {
    const scene::Bounds bounds{glm::vec3(-20.0F), glm::vec3(20.0F)};
    const OverlayBlock block =
        renderer::make_overlay_block(test::black_view(camera, kWidth, kHeight), bounds, false);
    for (const auto& [x, y] : {std::pair{0, 0}, {60, 46}, {17, 5}}) {
      const auto pixel = overlay_pixel(block, point_at(camera, x, y, 6.0));
      ASSERT_TRUE(pixel.has_value());
      EXPECT_NEAR(pixel->x, static_cast<float>(x) + 0.5F, 1e-3F);
      EXPECT_NEAR(pixel->y, static_cast<float>(y) + 0.5F, 1e-3F);
    }
    EXPECT_FALSE(overlay_pixel(block, point_at(camera, 30, 23, -1.0)).has_value());
  }
}

TEST_F(OverlayProjection, AFilledBoxCoversThePixelsWhoseRaysHitIt) {
  // The same box as twelve triangles, traced.
  const OverlayBox box{{-1.0F, -0.7F, -2.0F}, kWhite, {1.5F, 2.0F, 1.0F}, kOverlayBoxFilled};
  renderer::test::TestScene setup;
  const auto corner = [&](int i) {
    return glm::vec3((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                     (i & 4) != 0 ? box.max.z : box.min.z);
  };
  constexpr int kFaces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  for (const auto& f : kFaces) {
    setup.list.triangles.push_back(scene::make_triangle(corner(f[0]), corner(f[1]), corner(f[2])));
    setup.list.triangles.push_back(scene::make_triangle(corner(f[0]), corner(f[2]), corner(f[3])));
  }
  renderer::CpuTracer tracer(1);
  tracer.init(setup.input());
  OverlayRenderer overlay(context_);
  overlay.set_boxes(std::span(&box, 1), 1);
  const std::vector<std::uint32_t> first = {0};
  for (const scene::Camera& camera : cameras(1.0F)) {
    std::vector<scene::Hit> hits;
    tracer.trace_hits(camera, kWidth, kHeight, hits);
    OverlayView view = test::black_view(camera, kWidth, kHeight);
    view.fill_opacity = 1.0F;
    view.edge_px = 0.0F;
    const Codes codes = drawn(overlay, view, {.boxes = first});
    int covered = 0;
    int differing = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool hit = hits[static_cast<std::size_t>(y * kWidth + x)].found();
        covered += hit ? 1 : 0;
        differing += (codes.red(x, y) > 0) != hit ? 1 : 0;
      }
    }
    EXPECT_GT(covered, 150);
    // The device rounds corners to its subpixel grid: a pixel's centre may lie right on an edge.
    EXPECT_LE(differing, 2);
  }
}

TEST_F(OverlayProjection, EdgesEndWhereTheCornersAre) {
  const OverlayBox box{{-1.0F, -0.7F, -2.0F}, kRed, {1.5F, 2.0F, 1.0F}, 0};
  OverlayRenderer overlay(context_);
  overlay.set_boxes(std::span(&box, 1), 1);
  const std::vector<std::uint32_t> first = {0};
  for (const scene::Camera& camera : cameras(1.0F)) {
    OverlayView view = test::black_view(camera, kWidth, kHeight);
    view.edge_px = 2.0F;
    const OverlayBlock block = renderer::make_overlay_block(view, {box.min, box.max}, false);
    const Codes codes = drawn(overlay, view, {.boxes = first});
    glm::vec2 low(1e9F), high(-1e9F);
    for (int i = 0; i < 8; ++i) {
      const auto pixel = overlay_pixel(
          block, {(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                  (i & 4) != 0 ? box.max.z : box.min.z});
      ASSERT_TRUE(pixel.has_value());
      EXPECT_GT(codes.red(static_cast<int>(pixel->x), static_cast<int>(pixel->y)), 120) << i;
      low = glm::min(low, *pixel);
      high = glm::max(high, *pixel);
    }
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (codes.red(x, y) == 0) continue;
        EXPECT_GE(static_cast<float>(x), low.x - 2.5F);
        EXPECT_LE(static_cast<float>(x), high.x + 1.5F);
        EXPECT_GE(static_cast<float>(y), low.y - 2.5F);
        EXPECT_LE(static_cast<float>(y), high.y + 1.5F);
      }
    }
  }
}

TEST_F(OverlayProjection, ALineIsAsWideAsItIsToldAndFadesBelowAPixel) {
  OverlayRenderer overlay(context_);
  const scene::Camera camera{.eye = {0.0F, 0.0F, 2.0F}};
  for (const float width : {0.25F, 1.0F, 3.0F, 8.0F}) {
    const OverlaySegment line{{-100.0F, 0.03F, 0.0F}, {100.0F, 0.03F, 0.0F}, kRed, width};
    const Codes codes =
        drawn(overlay, test::black_view(camera, 32, 32), {.segments = std::span(&line, 1)});
    int column = 0;
    for (int y = 0; y < 32; ++y) column += codes.red(16, y);
    EXPECT_NEAR(column / 255.0, width, 0.02) << width;
  }
}

TEST_F(OverlayProjection, WhatPassesTheEyeIsCutOffCleanly) {
  OverlayRenderer overlay(context_);
  // From in front of the eye, below it, to far behind: the visible part runs from the middle of
  // the picture's width straight down to its lower border.
  const OverlaySegment line{{0.0F, -0.5F, -1000.0F}, {0.0F, -0.5F, 5000.0F}, kRed, 2.0F};
  scene::Camera camera{.eye = glm::vec3(0.0F), .target = {0.0F, 0.0F, -1.0F}};
  const Codes seen =
      drawn(overlay, test::black_view(camera, 40, 40), {.segments = std::span(&line, 1)});
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const bool on_line = (x == 19 || x == 20) && y >= 20;
      if (on_line) {
        EXPECT_GT(seen.red(x, y), 200) << x << ", " << y;
      }
      if (x < 18 || x > 21 || y < 18) {
        EXPECT_EQ(seen.red(x, y), 0) << x << ", " << y;
      }
    }
  }
}

TEST_F(OverlayProjection, TheEyeInsideABoxSeesItAllAround) {
  OverlayRenderer overlay(context_);
  // Edges and faces cross the plane through the eye; one edge runs straight through it.
  const std::vector<OverlayBox> boxes = {
      {glm::vec3(-1.0F), kRed, glm::vec3(1.0F), kOverlayBoxFilled},
      {glm::vec3(0.25F, 0.25F, -3.0F), kRed, glm::vec3(2.0F), kOverlayBoxFilled}};
  overlay.set_boxes(boxes, 7);
  const std::vector<std::uint32_t> all = {0, 1};
  for (const glm::vec3 target :
       {glm::vec3(1, 0.3, 0.2), glm::vec3(0, 0, -1), glm::vec3(-1, 2, 3)}) {
    for (const float height : {0.0F, 0.5F}) {
      scene::Camera camera{.eye = {0.25F, 0.25F, 0.0F}, .target = target};
      camera.orthographic_height = height;
      OverlayView view = test::black_view(camera, 33, 21);
      view.fill_opacity = 1.0F;
      const Codes codes = drawn(overlay, view, {.boxes = all});
      EXPECT_EQ(codes.red_sum(), 33U * 21U * 255U);
    }
  }
}

TEST_F(OverlayProjection, AnEdgeThroughTheEyeLeavesNoStreak) {
  OverlayRenderer overlay(context_);
  // Seen along itself it is a dot, whatever single precision makes of its direction near the eye.
  const glm::vec3 eye(0.1F, 0.2F, 0.3F);
  for (int i = 0; i < 40; ++i) {
    const glm::vec3 way(std::cos(0.7F * static_cast<float>(i)),
                        0.05F * static_cast<float>(i) - 1.0F,
                        std::sin(1.3F * static_cast<float>(i)) + 1.5F);
    const OverlaySegment line{eye - 3.0F * way, eye + 5.0F * way, kRed, 1.0F};
    const scene::Camera camera{.eye = eye, .target = eye + way};
    const Codes codes =
        drawn(overlay, test::black_view(camera, 65, 65), {.segments = std::span(&line, 1)});
    for (int y = 0; y < 65; ++y) {
      for (int x = 0; x < 65; ++x) {
        if (std::abs(x - 32) <= 2 && std::abs(y - 32) <= 2) continue;
        ASSERT_EQ(codes.red(x, y), 0) << i << ": " << x << ", " << y;
      }
    }
  }
}

TEST_F(OverlayProjection, FarEyesAndEmptyBoxesAreFine) {
  OverlayRenderer overlay(context_);
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<OverlayBox> boxes = {
      {glm::vec3(inf), kRed, glm::vec3(-inf), kOverlayBoxFilled},
      {glm::vec3(-inf), kRed, glm::vec3(inf), kOverlayBoxFilled},
      {glm::vec3(1.0F), kRed, glm::vec3(0.0F), kOverlayBoxFilled},
  };
  overlay.set_boxes(boxes, 1);
  const std::vector<std::uint32_t> all = {0, 1, 2};
  const OverlayView view = test::black_view({.eye = {0.0F, 0.0F, 1e12F}}, 16, 16);
  EXPECT_EQ(drawn(overlay, view, {.boxes = all}).red_sum(), 0U);
  // A box of a third of the view's height, from far away through a narrow view.
  const OverlayBox far_box{glm::vec3(-1e9F), kRed, glm::vec3(1e9F), kOverlayBoxFilled};
  overlay.set_boxes(std::span(&far_box, 1), 2);
  OverlayView narrow = view;
  narrow.camera.vertical_fov_degrees = 0.34377F;  // 6e9 units at 1e12
  narrow.fill_opacity = 1.0F;
  narrow.edge_px = 0.0F;
  narrow.width = narrow.height = 60;
  const std::vector<std::uint32_t> first = {0};
  const Codes codes = drawn(overlay, narrow, {.boxes = first});
  EXPECT_NEAR(static_cast<double>(codes.red_sum()) / 255.0, 400.0, 1.0);
}

}  // namespace
