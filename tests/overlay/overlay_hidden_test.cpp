// What an overlay hides: what lies behind the traced surface, or beyond a section plane.

#include "accel/make_structure.h"
#include "renderer/camera_rays.h"
#include "renderer/cpu_tracer.h"
#include "renderer/overlay/overlay_renderer.h"
#include "scene/sample_scenes.h"
#include "tests/overlay/overlay_pictures.h"
#include "tests/renderer/test_scenes.h"
#include "tests/support/gl_context.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace encore;
using renderer::OverlayBox;
using renderer::OverlayMode;
using renderer::OverlayPoint;
using renderer::OverlayQuad;
using renderer::OverlayRenderer;
using renderer::OverlaySegment;
using renderer::OverlayView;
using test::Codes;
using test::drawn;
using test::kRed;

constexpr int kWidth = 64;
constexpr int kHeight = 48;

/// A sample scene with the distances that the tracer finds for a camera.
struct Traced {
  scene::Scene scene;
  scene::TriangleList list;
  std::vector<scene::Hit> hits;

  Traced(const char* name, bool orthographic) : scene(*scene::make_sample_scene(name)) {
    scene::update_triangles(scene, 0.0, list);
    const scene::Bounds bounds = list.bounds();
    if (orthographic) scene.camera.orthographic_height = 0.8F * glm::length(bounds.size());
    const auto structure =
        accel::make_structure(accel::default_spec(accel::StructureKind::bvh_median));
    structure->build(list.triangles);
    renderer::CpuTracer tracer(1);
    tracer.init({&scene, &list, structure.get()});
    tracer.trace_hits(scene.camera, kWidth, kHeight, hits);
  }
};

class OverlayHidden : public test::GlTest, public testing::WithParamInterface<bool> {};

TEST_P(OverlayHidden, PointsAreHiddenExactlyBehindTheTracedSurface) {
  const Traced traced("toys", GetParam());
  const auto frame = renderer::make_camera_frame(traced.scene.camera, kWidth, kHeight);
  std::vector<scene::Ray> rays(traced.hits.size());
  renderer::camera_rays(frame, {0, 0, kWidth, kHeight}, rays);
  OverlayRenderer overlay(context_);
  overlay.set_depth(traced.hits, kWidth, kHeight);
  OverlayView view = test::black_view(traced.scene.camera, kWidth, kHeight);

  // A dot on every pixel's ray: on the surface, before it, and behind it, by a hundredth.
  for (const float share : {1.0F, 0.99F, 1.01F}) {
    std::vector<OverlayPoint> points;
    std::vector<int> hit;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool found = traced.hits[i].found();
      hit.push_back(found ? 1 : 0);
      const float t = found ? traced.hits[i].t * share : 100.0F;
      points.push_back({rays[i].origin + t * rays[i].direction, kRed, 1.0F});
    }
    ASSERT_GT(std::count(hit.begin(), hit.end(), 1), kWidth * kHeight / 20);
    ASSERT_GT(std::count(hit.begin(), hit.end(), 0), kWidth * kHeight / 20);
    for (const auto& [mode, behind] : {std::pair{OverlayMode::x_ray, 255},
                                       {OverlayMode::hidden_line, 0},
                                       {OverlayMode::dimmed, 64}}) {
      view.mode = mode;
      const Codes codes = drawn(overlay, view, {.points = points});
      EXPECT_FALSE(overlay.last().depth_missing);
      for (std::size_t i = 0; i < hit.size(); ++i) {
        const int expected = share > 1.0F && hit[i] != 0 ? behind : 255;
        // Neighbours' dots reach in by a code or two.
        ASSERT_NEAR(codes.rgba[4 * i], expected, 4) << "pixel " << i << ", " << share;
      }
    }
  }
}

TEST_P(OverlayHidden, FacesAndLinesAreHiddenToo) {
  const Traced traced("toys", GetParam());
  const auto frame = renderer::make_camera_frame(traced.scene.camera, kWidth, kHeight);
  // A plane across the view, through the middle of the scene, and a line in it.
  const glm::dvec3 forward = frame.forward;
  const scene::Bounds bounds = traced.list.bounds();
  const glm::dvec3 eye(frame.origin);
  const double depth = glm::dot(glm::dvec3(bounds.center()) - eye, forward);
  const double wide = frame.orthographic ? 1.0 : depth;
  const auto corner = [&](double x, double y) {
    return glm::vec3(eye + depth * forward + x * wide * frame.right + y * wide * frame.up);
  };
  const OverlayQuad quad{{corner(-99, -99), corner(99, -99), corner(99, 99), corner(-99, 99)},
                         0xFF0000FFU};
  const OverlaySegment line{corner(-99, 0), corner(99, 0), kRed, 4.0F};
  OverlayRenderer overlay(context_);
  overlay.set_depth(traced.hits, kWidth, kHeight);
  OverlayView view = test::black_view(traced.scene.camera, kWidth, kHeight);
  view.mode = OverlayMode::hidden_line;
  view.depth_bias = 0.0F;
  const Codes faces = drawn(overlay, view, {.quads = std::span(&quad, 1)});
  const Codes lines = drawn(overlay, view, {.segments = std::span(&line, 1)});
  std::vector<scene::Ray> rays(traced.hits.size());
  renderer::camera_rays(frame, {0, 0, kWidth, kHeight}, rays);
  int hidden = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto i = static_cast<std::size_t>(y * kWidth + x);
      // Where this pixel's ray meets the plane.
      const double t = depth / glm::dot(glm::dvec3(rays[i].direction), forward);
      if (std::fabs(static_cast<double>(traced.hits[i].t) - t) < 1e-5 * t) continue;
      const bool before = t < static_cast<double>(traced.hits[i].t);
      hidden += before ? 0 : 1;
      ASSERT_EQ(faces.red(x, y), before ? 255 : 0) << x << ", " << y;
      if (y == kHeight / 2) {
        ASSERT_EQ(lines.red(x, y), before ? 255 : 0) << x;
      }
    }
  }
  EXPECT_GT(hidden, 50);
}

INSTANTIATE_TEST_SUITE_P(Views, OverlayHidden, testing::Values(false, true),
                         [](const auto& tested) {
                           return tested.param ? "Orthographic" : "Perspective";
                         });

using OverlayDepth = test::GlTest;

TEST_F(OverlayDepth, WithoutDistancesNothingIsHiddenAndTheReportSaysSo) {
  OverlayRenderer overlay(context_);
  const OverlayPoint point{glm::vec3(0.0F), kRed, 9.0F};
  OverlayView view = test::black_view({.eye = {0.0F, 0.0F, 2.0F}}, 16, 16);
  const Codes open = drawn(overlay, view, {.points = std::span(&point, 1)});
  EXPECT_FALSE(overlay.last().depth_missing) << "none is wanted";
  for (const OverlayMode mode : {OverlayMode::hidden_line, OverlayMode::dimmed}) {
    view.mode = mode;
    EXPECT_EQ(drawn(overlay, view, {.points = std::span(&point, 1)}).rgba, open.rgba);
    EXPECT_TRUE(overlay.last().depth_missing);
  }
  view.mode = OverlayMode::hidden_line;
  overlay.set_depth(std::vector<float>(4, 1.0F), 2, 2);
  EXPECT_EQ(drawn(overlay, view, {.points = std::span(&point, 1)}).red_sum(), 0U);
  EXPECT_FALSE(overlay.last().depth_missing);
  overlay.clear_depth();
  EXPECT_EQ(drawn(overlay, view, {.points = std::span(&point, 1)}).rgba, open.rgba);
  EXPECT_TRUE(overlay.last().depth_missing);
}

TEST_F(OverlayDepth, ACoarserPictureOfDistancesIsStretched) {
  OverlayRenderer overlay(context_);
  const float inf = std::numeric_limits<float>::infinity();
  overlay.set_depth(std::vector<float>{1.0F, inf}, 2, 1);  // the left half is covered
  const OverlaySegment line{{-9.0F, 0.0F, 0.0F}, {9.0F, 0.0F, 0.0F}, kRed, 40.0F};
  OverlayView view = test::black_view({.eye = {0.0F, 0.0F, 2.0F}}, 16, 8);
  view.mode = OverlayMode::hidden_line;
  const Codes codes = drawn(overlay, view, {.segments = std::span(&line, 1)});
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) EXPECT_EQ(codes.red(x, y), x < 8 ? 0 : 255) << x << ", " << y;
  }
}

TEST_F(OverlayDepth, DistancesOfAnySceneScaleCompareAlike) {
  OverlayRenderer overlay(context_);
  for (const float scale : {1e-18F, 1.0F, 1e18F}) {
    overlay.set_depth(std::vector<float>(1, 2.0F * scale), 1, 1);
    OverlayView view = test::black_view({.eye = {0.0F, 0.0F, 2.0F * scale}}, 9, 9);
    view.mode = OverlayMode::hidden_line;
    for (const float z : {-0.02F, 0.0F, 0.02F}) {
      const OverlayPoint point{{0.0F, 0.0F, z * scale}, kRed, 3.0F};
      const Codes codes = drawn(overlay, view, {.points = std::span(&point, 1)});
      EXPECT_EQ(codes.red(4, 4), z < 0.0F ? 0 : 255) << scale << ", " << z;
    }
  }
}

TEST_F(OverlayDepth, TheSectionPlaneCutsFacesEdgesAndPoints) {
  OverlayRenderer overlay(context_);
  const OverlayBox box{glm::vec3(-1.0F), kRed, glm::vec3(1.0F), renderer::kOverlayBoxFilled};
  overlay.set_boxes(std::span(&box, 1), 1);
  const std::vector<std::uint32_t> first = {0};
  const std::vector<OverlayPoint> points = {{{0.5F, 0.0F, 0.0F}, test::kGreen, 5.0F},
                                            {{-0.5F, 0.0F, 0.0F}, test::kGreen, 5.0F}};
  for (const float height : {0.0F, 4.0F}) {
    scene::Camera camera{.eye = {0.0F, 0.0F, 3.0F}};
    camera.orthographic_height = height;
    OverlayView view = test::black_view(camera, 40, 40);
    view.fill_opacity = 0.5F;
    const Codes whole = drawn(overlay, view, {.boxes = first, .points = points});
    // x > 0 is cut away; the normal's length does not matter.
    for (const float length : {1e-12F, 1.0F, 1e12F}) {
      view.section_plane = glm::vec4(length, 0.0F, 0.0F, 0.0F);
      const Codes cut = drawn(overlay, view, {.boxes = first, .points = points});
      for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) {
          // Round ends of the cut lines reach over by half a line's width.
          if (x >= 22) {
            ASSERT_EQ(cut.at(x, y), (std::array{0, 0, 0, 255})) << x << ", " << y;
          }
          if (x < 18) {
            ASSERT_EQ(cut.at(x, y), whole.at(x, y)) << x << ", " << y;
          }
        }
      }
      EXPECT_GT(cut.red_sum(), whole.red_sum() / 3);
    }
    // Far from where anything is, on either side.
    view.section_plane = glm::vec4(1.0F, 0.0F, 0.0F, -5.0F);
    EXPECT_EQ(drawn(overlay, view, {.boxes = first, .points = points}).rgba, whole.rgba);
    view.section_plane = glm::vec4(1.0F, 0.0F, 0.0F, 5.0F);
    EXPECT_EQ(drawn(overlay, view, {.boxes = first, .points = points}).red_sum(), 0U);
  }
}

}  // namespace
