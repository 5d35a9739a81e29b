#include "renderer/raster_view.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace {

using namespace encore;
using renderer::CameraFrame;
using renderer::RasterView;

struct Projected {
  double column;  ///< in pixels from the left
  double row;     ///< in pixels from the top
  double depth;
};

/// What shaders/raster.vert and the device make of a point.
Projected project(const RasterView& view, const glm::vec3& point, int width, int height) {
  const glm::vec3 d = (point - view.eye) * view.scale;
  if (view.orthographic) {
    return {(double{glm::dot(view.clip_x, d)} + 1.0) * 0.5 * width,
            (double{glm::dot(view.clip_y, d)} + 1.0) * 0.5 * height,
            1.0 - 0.5 * double{glm::dot(view.forward, d)}};
  }
  const double w = glm::dot(view.forward, d);
  return {(glm::dot(view.clip_x, d) / w + 1.0) * 0.5 * width,
          (glm::dot(view.clip_y, d) / w + 1.0) * 0.5 * height, double{view.near_plane} / w};
}

constexpr int kWidth = 160;
constexpr int kHeight = 90;

const scene::Camera kCamera{.eye = {3.0F, -2.0F, 7.0F},
                            .target = {-1.0F, 0.5F, 0.0F},
                            .up = {0.1F, 1.0F, 0.0F},
                            .vertical_fov_degrees = 70.0F};

TEST(RasterView, APointOnAPixelsRayFallsOnItsCentre) {
  for (const float fov : {1.0F, 70.0F, 150.0F, 179.9F}) {
    scene::Camera camera = kCamera;
    camera.vertical_fov_degrees = fov;
    const CameraFrame frame = renderer::make_camera_frame(camera, kWidth, kHeight);
    const scene::Bounds bounds{glm::vec3(-20.0F), glm::vec3(20.0F)};
    const RasterView view = renderer::make_raster_view(frame, kWidth, kHeight, bounds);
    for (const auto& [x, y] :
         std::array<std::array<int, 2>, 4>{{{0, 0}, {159, 0}, {31, 80}, {80, 45}}}) {
      const glm::dvec3 along = frame.forward + (x + 0.5 - frame.center_x) * frame.right +
                               (frame.center_y - y - 0.5) * frame.up;
      const auto point = glm::vec3(glm::dvec3(frame.origin) + 5.0 * along);
      const Projected found = project(view, point, kWidth, kHeight);
      // A coordinate of 10 is off by up to 5e-7, which is 1e-3 pixels at one degree.
      EXPECT_NEAR(found.column, x + 0.5, 0.01) << fov;
      EXPECT_NEAR(found.row, y + 0.5, 0.01) << fov;
    }
  }
}

TEST(RasterView, AnOrthographicPixelsPointsFallOnItsCentreAtEveryDistance) {
  for (const float height : {0.5F, 9.0F, 300.0F}) {
    scene::Camera camera = kCamera;
    camera.orthographic_height = height;
    const CameraFrame frame = renderer::make_camera_frame(camera, kWidth, kHeight);
    const scene::Bounds bounds{glm::vec3(-20.0F), glm::vec3(20.0F)};
    const RasterView view = renderer::make_raster_view(frame, kWidth, kHeight, bounds);
    for (const auto& [x, y] :
         std::array<std::array<int, 2>, 4>{{{0, 0}, {159, 0}, {31, 80}, {80, 45}}}) {
      double last = 1.0;
      for (const double distance : {0.1, 3.0, 12.0}) {
        const glm::dvec3 point = glm::dvec3(frame.origin) + distance * frame.forward +
                                 (x + 0.5 - frame.center_x) * frame.right +
                                 (frame.center_y - y - 0.5) * frame.up;
        const Projected found = project(view, glm::vec3(point), kWidth, kHeight);
        EXPECT_NEAR(found.column, x + 0.5, 0.01) << height;
        EXPECT_NEAR(found.row, y + 0.5, 0.01) << height;
        EXPECT_LT(found.depth, last);
        EXPECT_GT(found.depth, 0.0);
        last = found.depth;
      }
    }
    // Depths above 1 are cut off: what lies behind the eye.
    const auto behind = glm::vec3(glm::dvec3(frame.origin) - 0.01 * frame.forward);
    EXPECT_GT(project(view, behind, kWidth, kHeight).depth, 1.0);
  }
}

TEST(RasterView, OrthographicExtremesStayFinite) {
  for (const float height : {1e-45F, 1e-20F, 1e20F, 1e37F}) {
    for (const float size : {1e-45F, 1e-20F, 1e20F, 1e37F}) {
      const scene::Camera camera{.eye = {0, 0, size}, .target = {}, .orthographic_height = height};
      const CameraFrame frame = renderer::make_camera_frame(camera, kWidth, kHeight);
      const RasterView view =
          renderer::make_raster_view(frame, kWidth, kHeight, {glm::vec3(0.0F), glm::vec3(size)});
      const Projected found = project(view, glm::vec3(0.0F), kWidth, kHeight);
      EXPECT_TRUE(std::isfinite(found.column + found.row + found.depth)) << height << ", " << size;
    }
  }
}

TEST(RasterView, DepthFallsWithDistance) {
  const CameraFrame frame = renderer::make_camera_frame(kCamera, kWidth, kHeight);
  const scene::Bounds bounds{glm::vec3(-1e9F), glm::vec3(1e9F)};
  const RasterView view = renderer::make_raster_view(frame, kWidth, kHeight, bounds);
  double last = 1.0;
  for (const double distance : {1e-9, 1e-3, 1.0, 1.00001, 1e3, 1e9}) {
    const auto d = glm::vec3(frame.forward * distance) * view.scale;
    const double depth = double{view.near_plane} / double{glm::dot(view.forward, d)};
    EXPECT_LT(depth, last) << distance;
    EXPECT_GT(static_cast<float>(depth), 0x1p-126F) << "too small to be told apart";
    last = depth;
  }
}

TEST(RasterView, ScenesOfAnySizeAreBroughtToOne) {
  for (const int exponent : {-60, -40, -1, 0, 5, 60}) {
    const float size = std::ldexp(1.0F, exponent);
    scene::Camera camera = kCamera;
    camera.eye *= size;
    camera.target *= size;
    const CameraFrame frame = renderer::make_camera_frame(camera, kWidth, kHeight);
    const scene::Bounds bounds{glm::vec3(-2.0F * size), glm::vec3(size)};
    const RasterView view = renderer::make_raster_view(frame, kWidth, kHeight, bounds);
    // The farthest corner's farthest coordinate is 9 sizes from the eye.
    EXPECT_EQ(view.scale * size, 0x1p-4F) << exponent;
  }
}

TEST(RasterView, ExtremesStayFinite) {
  const CameraFrame frame = renderer::make_camera_frame(kCamera, kWidth, kHeight);
  const auto scale_of = [&](const scene::Bounds& bounds) {
    return renderer::make_raster_view(frame, kWidth, kHeight, bounds).scale;
  };
  EXPECT_EQ(scale_of({}), 1.0F);
  EXPECT_TRUE(std::isnormal(scale_of({glm::vec3(0.0F), glm::vec3(3e38F)})));
  // An eye in the only point of the scene.
  EXPECT_EQ(scale_of({frame.origin, frame.origin}), 1.0F);
  CameraFrame small = frame;
  small.origin = glm::vec3(0.0F);
  const RasterView view =
      renderer::make_raster_view(small, kWidth, kHeight, {glm::vec3(0.0F), glm::vec3(1e-45F)});
  EXPECT_TRUE(std::isnormal(view.scale));
}

}  // namespace
