#include "renderer/camera_rays.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

using namespace encore;
using renderer::camera_rays;
using renderer::make_camera_frame;
using renderer::PixelRect;

std::vector<scene::Ray> all_rays(const scene::Camera& camera, int width, int height) {
  std::vector<scene::Ray> rays(PixelRect{0, 0, width, height}.count());
  camera_rays(make_camera_frame(camera, width, height), {0, 0, width, height}, rays);
  return rays;
}

void expect_near(const glm::vec3& a, const glm::dvec3& b, double tolerance = 1e-7) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(CameraRays, TheCentreOfAnOddImageLooksExactlyAtTheTarget) {
  const auto rays = all_rays({}, 3, 3);
  EXPECT_EQ(rays[4].direction, glm::vec3(0.0F, 0.0F, -1.0F));
  EXPECT_EQ(rays[4].origin, glm::vec3(0.0F, 0.0F, 25.0F));
  EXPECT_EQ(rays[4].t_min, 0.0F);
  EXPECT_EQ(rays[4].t_max, std::numeric_limits<float>::infinity());
}

TEST(CameraRays, CornersLieWhereTheFieldOfViewPutsThem) {
  // 90 degrees: the image spans [-1, 1] vertically at distance 1, [-2, 2] horizontally at 4:2.
  const auto rays = all_rays({}, 4, 2);
  const auto expected = [](double x, double y) { return glm::normalize(glm::dvec3(x, y, -1.0)); };
  expect_near(rays[0].direction, expected(-1.5, 0.5));
  expect_near(rays[3].direction, expected(1.5, 0.5));
  expect_near(rays[4].direction, expected(-1.5, -0.5));
  expect_near(rays[7].direction, expected(1.5, -0.5));
}

TEST(CameraRays, NarrowFieldOfViewOfATurnedCamera) {
  const scene::Camera camera{.eye = {1.0F, 2.0F, 3.0F},
                             .target = {11.0F, 2.0F, 3.0F},
                             .up = {0.0F, 0.0F, 1.0F},
                             .vertical_fov_degrees = 60.0F};
  // Looking along +x with +z up, +y is to the left.
  const auto rays = all_rays(camera, 2, 2);
  const double half = std::tan(M_PI / 6.0) / 2.0;
  expect_near(rays[0].direction, glm::normalize(glm::dvec3(1.0, half, half)));
  expect_near(rays[3].direction, glm::normalize(glm::dvec3(1.0, -half, -half)));
}

TEST(CameraRays, DirectionsHaveUnitLength) {
  for (const scene::Ray& ray : all_rays({.vertical_fov_degrees = 170.0F}, 37, 19)) {
    EXPECT_NEAR(glm::length(glm::dvec3(ray.direction)), 1.0, 1e-7);
  }
}

TEST(CameraRays, ARayDependsOnItsPixelAlone) {
  const auto whole = all_rays({}, 40, 30);
  const auto frame = make_camera_frame({}, 40, 30);
  const PixelRect rect{7, 11, 23, 29};
  std::vector<scene::Ray> part(rect.count());
  camera_rays(frame, rect, part);
  std::size_t i = 0;
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x, ++i) {
      EXPECT_EQ(part[i].direction, whole[static_cast<std::size_t>(y * 40 + x)].direction);
    }
  }
}

TEST(CameraRays, UpParallelToTheViewOrZeroIsReplaced) {
  for (const glm::vec3 up : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -3), glm::vec3(0.0F)}) {
    const auto rays = all_rays({.up = up}, 2, 2);
    const auto usual = all_rays({}, 2, 2);  // looks along -z, so y takes over
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(rays[i].direction, usual[i].direction);
  }
  // Straight down with the default up: z takes over; whatever the way round, the basis is whole.
  const auto frame = make_camera_frame({.eye = {0, 9, 0}, .target = {0, 0, 0}}, 8, 8);
  EXPECT_NEAR(glm::length(frame.right), glm::length(frame.up), 1e-15);
  EXPECT_NEAR(glm::dot(frame.right, frame.up), 0.0, 1e-15);
  EXPECT_NEAR(glm::dot(frame.right, frame.forward), 0.0, 1e-15);
  EXPECT_GT(frame.up.z, 0.0);
}

TEST(CameraRays, ScaleDoesNotChangeDirections) {
  const auto usual = all_rays({}, 5, 5);
  for (const float scale : {1e-30F, 1e30F}) {
    const auto rays = all_rays({.eye = {0, 0, scale}, .up = {0, scale, 0}}, 5, 5);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(rays[i].direction, usual[i].direction) << scale;
    }
  }
}

TEST(CameraRays, OrthographicRaysStartAtTheirPixelsAndRunAlongTheView) {
  // 4 units high: pixels of 2 units.
  const auto rays =
      all_rays({.eye = {1, 2, 25}, .target = {1, 2, 3}, .orthographic_height = 4}, 3, 2);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(rays[i].direction, glm::vec3(0.0F, 0.0F, -1.0F));
    EXPECT_EQ(rays[i].t_min, 0.0F);
    EXPECT_EQ(rays[i].t_max, std::numeric_limits<float>::infinity());
  }
  EXPECT_EQ(rays[0].origin, glm::vec3(-1.0F, 3.0F, 25.0F));
  EXPECT_EQ(rays[2].origin, glm::vec3(3.0F, 3.0F, 25.0F));
  EXPECT_EQ(rays[4].origin, glm::vec3(1.0F, 1.0F, 25.0F));
}

TEST(CameraRays, OrthographicStartsLieOnThePlaneThroughTheEye) {
  const scene::Camera camera{.eye = {3, -2, 7}, .target = {-1, 0.5F, 0}, .orthographic_height = 9};
  const auto frame = make_camera_frame(camera, 37, 19);
  for (const scene::Ray& ray : all_rays(camera, 37, 19)) {
    EXPECT_EQ(ray.direction, glm::vec3(frame.forward));
    const glm::dvec3 from_eye = glm::dvec3(ray.origin) - glm::dvec3(camera.eye);
    EXPECT_NEAR(glm::dot(from_eye, frame.forward), 0.0, 2e-6);
    EXPECT_LE(std::abs(glm::dot(from_eye, glm::normalize(frame.up))), 4.5);
    EXPECT_LE(std::abs(glm::dot(from_eye, glm::normalize(frame.right))), 4.5 * 37 / 19);
  }
}

TEST(CameraRays, AnOrthographicRayDependsOnItsPixelAlone) {
  const scene::Camera camera{.eye = {3, -2, 7}, .orthographic_height = 9};
  const auto whole = all_rays(camera, 40, 30);
  const PixelRect rect{7, 11, 23, 29};
  std::vector<scene::Ray> part(rect.count());
  camera_rays(make_camera_frame(camera, 40, 30), rect, part);
  std::size_t i = 0;
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x, ++i) {
      EXPECT_EQ(part[i].origin, whole[static_cast<std::size_t>(y * 40 + x)].origin);
    }
  }
}

TEST(CameraRays, OrthographicHeightsAreFiniteAndThenTheFieldOfViewDoesNotMatter) {
  const float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float height : {-1.0F, inf, -inf, nan, 3e38F}) {
    // A height of 3e38 spans more than floats hold in a picture twice as wide, around such an eye.
    EXPECT_THROW(make_camera_frame({.eye = {0, 0, 3e38F}, .orthographic_height = height}, 64, 16),
                 std::invalid_argument)
        << height;
  }
  for (const float height : {1e-45F, 1e-15F, 1.0F, 1e30F}) {
    const auto rays =
        all_rays({.vertical_fov_degrees = 500.0F, .orthographic_height = height}, 5, 5);
    for (const scene::Ray& ray : rays) EXPECT_TRUE(std::isfinite(ray.origin.x + ray.origin.y));
  }
}

TEST(CameraRays, UnusableCamerasAndSizesAreRejected) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_THROW(make_camera_frame({.eye = {1, 2, 3}, .target = {1, 2, 3}}, 8, 8),
               std::invalid_argument);
  EXPECT_THROW(make_camera_frame({.eye = {nan, 2, 3}}, 8, 8), std::invalid_argument);
  EXPECT_THROW(make_camera_frame({.target = {0, inf, 3}}, 8, 8), std::invalid_argument);
  EXPECT_THROW(make_camera_frame({.up = {0, nan, 3}}, 8, 8), std::invalid_argument);
  for (const float fov : {0.0F, -10.0F, 180.0F, 400.0F, nan}) {
    EXPECT_THROW(make_camera_frame({.vertical_fov_degrees = fov}, 8, 8), std::invalid_argument)
        << fov;
  }
  EXPECT_THROW(make_camera_frame({}, 0, 8), std::invalid_argument);
  EXPECT_THROW(make_camera_frame({}, 8, -1), std::invalid_argument);
}

}  // namespace
