#include "scene/camera_motion.h"

#include "scene/camera_basis.h"
#include "scene/portable_math.h"
#include "scene/triangle.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace encore::scene {

namespace {

constexpr double kFarthestTarget = 1e36;
constexpr double kLeastDistance = 1e-30;
constexpr double kGreatestDistance = 4e36;
constexpr double kLeastShare = 0x1p-14;  ///< of the coordinates that a distance is added to
/// Between view and pole; more than the 0.0017 rad that roundings turn a view by at most.
constexpr double kPoleGap = 0.004;
constexpr double kMargin = 1.05;

double finite_or(double value, double otherwise) {
  return std::isfinite(value) ? value : otherwise;
}

/// How far to move; what is not finite counts as nothing, and sums never overflow.
double amount(double value) {
  return std::clamp(finite_or(value, 0.0), -1e40, 1e40);
}

double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

glm::dvec3 within(const glm::dvec3& v, double limit) {
  return glm::clamp(v, glm::dvec3(-limit), glm::dvec3(limit));
}

glm::dvec3 unit_axis(Axis axis) {
  return {axis == Axis::x ? 1.0 : 0.0, axis == Axis::y ? 1.0 : 0.0, axis == Axis::z ? 1.0 : 0.0};
}

double distance_of(const Camera& camera) {
  const glm::dvec3 view = glm::dvec3(camera.target) - glm::dvec3(camera.eye);
  return std::sqrt(glm::dot(view, view));
}

/// A distance that floats at `fixed` can hold.
double usable_distance(double distance, const glm::dvec3& fixed) {
  const double least = std::max(kLeastDistance, kLeastShare * largest(fixed));
  return std::clamp(distance, least, kGreatestDistance);
}

/// Looks at `target` along `forward` from a distance.
Camera looking_at(Camera camera, const glm::dvec3& target, const glm::dvec3& forward,
                  double distance) {
  camera.target = glm::vec3(within(target, kFarthestTarget));
  const glm::dvec3 fixed(camera.target);
  camera.eye = glm::vec3(fixed - forward * usable_distance(distance, fixed));
  return camera;
}

/// Looks along `forward` from `eye` at a target at a distance.
Camera looking_from(Camera camera, const glm::dvec3& eye, const glm::dvec3& forward,
                    double distance) {
  camera.eye = glm::vec3(within(eye, kFarthestTarget));
  const glm::dvec3 fixed(camera.eye);
  const double most = std::min(distance, kFarthestTarget);
  camera.target = glm::vec3(fixed + forward * usable_distance(most, fixed));
  return camera;
}

/// A view as angles: of the eye's (or the view's) direction around an axis and above its equator.
/// The three directions are right-handed.
struct Angles {
  glm::dvec3 pole;
  glm::dvec3 zero;
  glm::dvec3 quarter;
  double around = 0.0;
  double above = 0.0;

  [[nodiscard]] glm::dvec3 direction() const {
    return (portable_cos(around) * zero + portable_sin(around) * quarter) * portable_cos(above) +
           portable_sin(above) * pole;
  }
};

/// The angles of `direction`, of unit length; at a pole `at_pole` says which way is forward.
Angles angles_of(const glm::dvec3& direction, Axis up_axis, const glm::dvec3& at_pole) {
  constexpr double kSmallestSine = 1e-6;
  Angles angles;
  angles.pole = unit_axis(up_axis);
  const double height = glm::dot(direction, angles.pole);
  glm::dvec3 level = direction - height * angles.pole;
  if (std::sqrt(glm::dot(level, level)) < kSmallestSine) {
    level = at_pole - glm::dot(at_pole, angles.pole) * angles.pole;
  }
  const double length = std::sqrt(glm::dot(level, level));
  // The direction itself is where turns start from, so no angle needs to be found around the pole.
  angles.zero = length > 0.0 ? level / length : unit_axis(up_axis == Axis::x ? Axis::y : Axis::x);
  angles.quarter = glm::cross(angles.pole, angles.zero);
  angles.above = 0.5 * kPi - portable_acos(height);
  return angles;
}

void turn(Angles& angles, double around, double above) {
  angles.around = std::fmod(amount(around), 2.0 * kPi);
  const double limit = 0.5 * kPi - kPoleGap;
  angles.above = std::clamp(angles.above + amount(above), -limit, limit);
}

/// Moves eye and target by the same way.
Camera moved(const Camera& camera, const glm::dvec3& way) {
  return looking_at(camera, glm::dvec3(camera.target) + way, camera_basis(camera).forward,
                    distance_of(camera));
}

/// The corners of a box from its middle, along the directions of a picture.
std::array<glm::dvec3, 8> corners_in_view(const glm::dvec3& half, const CameraBasis& basis) {
  std::array<glm::dvec3, 8> corners{};
  for (unsigned i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1U) != 0 ? half.x : -half.x, (i & 2U) != 0 ? half.y : -half.y,
                            (i & 4U) != 0 ? half.z : -half.z);
    corners[i] = {glm::dot(corner, basis.right), glm::dot(corner, basis.up),
                  glm::dot(corner, basis.forward)};
  }
  return corners;
}

float usable_height(double height) {
  return static_cast<float>(std::clamp(height, kLeastDistance, kGreatestDistance));
}

double usable_aspect(double aspect) {
  return std::isfinite(aspect) && aspect > 0.0 ? aspect : 1.0;
}

}  // namespace

Camera orbit(const Camera& camera, double dx, double dy, Axis up_axis) {
  const CameraBasis basis = camera_basis(camera);
  // Looking down from a pole, the picture's up points away from the eye's side; looking up, to it.
  const bool above = glm::dot(basis.forward, unit_axis(up_axis)) < 0.0;
  Angles angles = angles_of(-basis.forward, up_axis, above ? -basis.up : basis.up);
  turn(angles, dx, dy);
  return looking_at(with_up_axis(camera, up_axis), glm::dvec3(camera.target), -angles.direction(),
                    distance_of(camera));
}

Camera look(const Camera& camera, double dx, double dy, Axis up_axis) {
  const CameraBasis basis = camera_basis(camera);
  const bool down = glm::dot(basis.forward, unit_axis(up_axis)) < 0.0;
  Angles angles = angles_of(basis.forward, up_axis, down ? basis.up : -basis.up);
  turn(angles, dx, dy);
  return looking_from(with_up_axis(camera, up_axis), glm::dvec3(camera.eye), angles.direction(),
                      distance_of(camera));
}

Camera pan(const Camera& camera, double dx, double dy, double aspect) {
  const CameraBasis basis = camera_basis(camera);
  const double height = picture_height_at_target(camera);
  const double width = height * usable_aspect(aspect);
  return moved(camera, amount(dy * height) * basis.up - amount(dx * width) * basis.right);
}

Camera fly(const Camera& camera, double forward, double right, double up) {
  const CameraBasis basis = camera_basis(camera);
  return moved(camera, amount(forward) * basis.forward + amount(right) * basis.right +
                           amount(up) * basis.up);
}

Camera dolly(const Camera& camera, double factor) {
  return zoom_at(camera, factor, 0.5, 0.5, 1.0);
}

Camera zoom_at(const Camera& camera, double factor, double x, double y, double aspect) {
  if (!(std::isfinite(factor) && factor > 0.0)) return camera;
  const CameraBasis basis = camera_basis(camera);
  const double distance = distance_of(camera);
  const double height = picture_height_at_target(camera);
  const double width = height * usable_aspect(aspect);
  Camera zoomed = camera;
  double used = factor;
  if (camera.orthographic()) {
    const double least = kLeastShare * largest(glm::dvec3(camera.target)) * 0x1p-6;
    zoomed.orthographic_height = usable_height(
        factor < 1.0 ? std::max(height * factor, std::min(least, height)) : height * factor);
    used = zoomed.orthographic_height / height;
  } else {
    used = usable_distance(distance * factor, glm::dvec3(camera.target)) / distance;
  }
  // The point under the cursor stays, everything else comes nearer to it by the factor.
  const glm::dvec3 point = amount((finite_or(x, 0.5) - 0.5) * width) * basis.right +
                           amount((0.5 - finite_or(y, 0.5)) * height) * basis.up;
  return looking_at(zoomed, glm::dvec3(camera.target) + point * (1.0 - used), basis.forward,
                    camera.orthographic() ? distance : distance * used);
}

Camera focus(const Camera& camera, const Bounds& box, double aspect) {
  if (box.empty() || !is_finite(box.min) || !is_finite(box.max)) return camera;
  const CameraBasis basis = camera_basis(camera);
  const glm::dvec3 middle = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
  const glm::dvec3 half = 0.5 * (glm::dvec3(box.max) - glm::dvec3(box.min));
  const double radius = std::sqrt(glm::dot(half, half));
  Camera framed = camera;
  if (radius == 0.0) return looking_at(framed, middle, basis.forward, distance_of(camera));

  // Boxes seen edge on are given some thickness, in which roundings of the view get lost.
  const double slack = 0.02 * radius + 0x1p-22 * largest(middle);
  const double shape = usable_aspect(aspect);
  double half_height = 0.0;
  double distance = radius;
  const double slope = half_height_at_one(camera);
  for (const glm::dvec3& corner : corners_in_view(half, basis)) {
    const double needed =
        std::max(std::abs(corner.y) + slack, (std::abs(corner.x) + slack) / shape);
    half_height = std::max(half_height, needed);
    if (!camera.orthographic()) distance = std::max(distance, needed / slope - corner.z);
  }
  if (camera.orthographic()) {
    framed.orthographic_height = usable_height(2.0 * kMargin * half_height);
    distance = 2.0 * radius;
  }
  return looking_at(framed, middle, basis.forward, kMargin * distance);
}

Camera view_along_axis(const Camera& camera, ViewAxis axis, Axis up_axis) {
  const int place = static_cast<int>(axis);
  const auto along = static_cast<Axis>(place / 2);
  const double sign = place % 2 == 0 ? 1.0 : -1.0;
  const glm::dvec3 forward = sign * unit_axis(along);
  Camera turned = with_up_axis(camera, up_axis);
  if (along == up_axis) {
    const glm::dvec3 front =
        up_axis == Axis::z ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, -1.0);
    turned.up = glm::vec3(-sign * front);
  }
  return looking_at(turned, glm::dvec3(camera.target), forward, distance_of(camera));
}

Camera toggle_projection(const Camera& camera) {
  Camera toggled = camera;
  if (!camera.orthographic()) {
    toggled.orthographic_height = usable_height(picture_height_at_target(camera));
    return toggled;
  }
  if (!(camera.vertical_fov_degrees > 0.0F && camera.vertical_fov_degrees < 180.0F)) {
    toggled.vertical_fov_degrees = Camera{}.vertical_fov_degrees;
  }
  toggled.orthographic_height = 0.0F;
  const double distance = 0.5 * camera.orthographic_height / half_height_at_one(toggled);
  return looking_at(toggled, glm::dvec3(camera.target), camera_basis(camera).forward, distance);
}

Camera with_up_axis(const Camera& camera, Axis up_axis) {
  Camera turned = camera;
  turned.up = glm::vec3(unit_axis(up_axis));
  return turned;
}

}  // namespace encore::scene
