#include "renderer/camera_rays.h"

#include "scene/portable_math.h"
#include "scene/triangle.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <stdexcept>

namespace encore::renderer {

namespace {

/// `up` at unit length, or an axis in its place if it cannot tell what is up for this view.
glm::dvec3 usable_up(const glm::dvec3& forward, const glm::dvec3& wanted) {
  constexpr double kSmallestSine = 1e-6;
  const double length = std::sqrt(glm::dot(wanted, wanted));
  if (length > 0.0) {
    const glm::dvec3 up = wanted / length;
    const glm::dvec3 side = glm::cross(forward, up);
    if (std::sqrt(glm::dot(side, side)) > kSmallestSine) return up;
  }
  const glm::dvec3 size = glm::abs(forward);
  if (size.y <= size.x && size.y <= size.z) return {0.0, 1.0, 0.0};
  return size.z <= size.x ? glm::dvec3{0.0, 0.0, 1.0} : glm::dvec3{1.0, 0.0, 0.0};
}

void check(const scene::Camera& camera, int width, int height) {
  if (width <= 0 || height <= 0) {
    throw std::invalid_argument("an image needs at least one pixel each way");
  }
  if (!scene::is_finite(camera.eye) || !scene::is_finite(camera.target) ||
      !scene::is_finite(camera.up)) {
    throw std::invalid_argument("the camera has a coordinate that is not a finite number");
  }
  if (camera.eye == camera.target) {
    throw std::invalid_argument("the camera's eye and target are the same point; move one of them");
  }
  if (!(camera.vertical_fov_degrees > 0.0F && camera.vertical_fov_degrees < 180.0F)) {
    throw std::invalid_argument("the camera's field of view must be inside (0, 180) degrees");
  }
}

}  // namespace

CameraFrame make_camera_frame(const scene::Camera& camera, int width, int height) {
  check(camera, width, height);
  CameraFrame frame;
  frame.origin = camera.eye;

  // An orthonormal basis; squares of float coordinates neither overflow nor vanish in double.
  const glm::dvec3 view = glm::dvec3(camera.target) - glm::dvec3(camera.eye);
  frame.forward = view / std::sqrt(glm::dot(view, view));
  const glm::dvec3 side =
      glm::cross(frame.forward, usable_up(frame.forward, glm::dvec3(camera.up)));
  const glm::dvec3 right = side / std::sqrt(glm::dot(side, side));
  const glm::dvec3 up = glm::cross(right, frame.forward);

  // The image spans 2 tan(fov / 2) in height at distance 1; a pixel is as wide as it is high.
  const double half_angle = 0.5 * static_cast<double>(camera.vertical_fov_degrees);
  const double half_height =
      scene::portable_sin_degrees(half_angle) / scene::portable_cos_degrees(half_angle);
  const double pixel = 2.0 * half_height / height;
  frame.right = right * pixel;
  frame.up = up * pixel;
  frame.center_x = 0.5 * width;
  frame.center_y = 0.5 * height;
  return frame;
}

void camera_rays(const CameraFrame& frame, const PixelRect& rect, std::span<scene::Ray> rays) {
  std::size_t i = 0;
  for (int y = rect.y0; y < rect.y1; ++y) {
    const glm::dvec3 row = frame.forward + (frame.center_y - (y + 0.5)) * frame.up;
    for (int x = rect.x0; x < rect.x1; ++x, ++i) {
      const glm::dvec3 along = row + ((x + 0.5) - frame.center_x) * frame.right;
      const double scale = 1.0 / std::sqrt(glm::dot(along, along));
      rays[i] = scene::Ray{.origin = frame.origin, .direction = glm::vec3(along * scale)};
    }
  }
}

}  // namespace encore::renderer
