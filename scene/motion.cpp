#include "scene/motion.h"

#include "scene/rotation.h"

#include <algorithm>
#include <cmath>

namespace encore::scene {
namespace {

bool usable(float rate) {
  return std::isfinite(rate) && rate > 0.0F;
}

struct DurationOf {
  double operator()(const std::monostate&) const { return 0.0; }
  double operator()(const RigidMotion& m) const {
    if (m.keys.size() < 2 || !usable(m.keys.back().time_s)) return 0.0;
    return m.keys.back().time_s;
  }
  double operator()(const Deformer& m) const {
    if (!usable(m.frequency_hz) || m.amplitude == 0.0F) return 0.0;
    return 1.0 / double(m.frequency_hz);
  }
  double operator()(const FrameSequence& m) const {
    if (m.frames.size() < 2 || !usable(m.frames_per_second)) return 0.0;
    return static_cast<double>(m.frames.size()) / double(m.frames_per_second);
  }
};

glm::dvec3 mixed(const glm::vec3& a, const glm::vec3& b, double u) {
  return glm::dvec3(a) * (1.0 - u) + glm::dvec3(b) * u;
}

/// Rotation between two keys. A key without an angle takes over its neighbour's axis.
glm::dmat3 rotation_between(const Transform& a, const Transform& b, double u) {
  const glm::vec3 axis_a = a.rotation_degrees == 0.0F ? b.rotation_axis : a.rotation_axis;
  const glm::vec3 axis_b = b.rotation_degrees == 0.0F ? a.rotation_axis : b.rotation_axis;
  const glm::dvec3 ua = unit_or_zero(axis_a);
  const glm::dvec3 ub = unit_or_zero(axis_b);
  if (ua.x * ub.x + ua.y * ub.y + ua.z * ub.z > 1.0 - 1e-12) {
    return axis_angle_matrix(
        axis_a, double(a.rotation_degrees) * (1.0 - u) + double(b.rotation_degrees) * u);
  }
  return rotation_matrix(slerp(rotation_around(axis_a, a.rotation_degrees),
                               rotation_around(axis_b, b.rotation_degrees), u));
}

glm::mat4 pose_between(const Transform& a, const Transform& b, double u) {
  const glm::dmat3 rotation = rotation_between(a, b, u);
  const glm::dvec3 scale = mixed(a.scale, b.scale, u);
  return {glm::vec4(glm::vec3(rotation[0] * scale.x), 0.0F),
          glm::vec4(glm::vec3(rotation[1] * scale.y), 0.0F),
          glm::vec4(glm::vec3(rotation[2] * scale.z), 0.0F),
          glm::vec4(glm::vec3(mixed(a.translation, b.translation, u)), 1.0F)};
}

}  // namespace

double motion_duration_s(const Motion& motion) {
  return std::visit(DurationOf{}, motion);
}

double wrapped_time(double time_s, double duration_s) {
  if (!(duration_s > 0.0) || !std::isfinite(duration_s) || !std::isfinite(time_s)) return 0.0;
  double t = std::fmod(time_s, duration_s);
  if (t < 0.0) t += duration_s;
  return t < duration_s ? t : 0.0;
}

glm::mat4 pose_at(const RigidMotion& motion, double time_s) {
  if (motion.keys.empty()) return glm::mat4(1.0F);
  const auto after =
      std::upper_bound(motion.keys.begin(), motion.keys.end(), time_s,
                       [](double t, const Keyframe& key) { return t < double(key.time_s); });
  // Before the first and after the last key the pose is held.
  if (after == motion.keys.begin()) return motion.keys.front().pose.matrix();
  const Keyframe& a = *(after - 1);
  if (after == motion.keys.end() || time_s == double(a.time_s)) return a.pose.matrix();
  const double u = (time_s - double(a.time_s)) / (double(after->time_s) - double(a.time_s));
  return pose_between(a.pose, after->pose, u);
}

std::size_t frame_at(const FrameSequence& sequence, double time_s) {
  if (sequence.frames.size() < 2 || !usable(sequence.frames_per_second)) return 0;
  // A time computed as k / rate may lie a rounding error before its frame.
  const auto count = static_cast<double>(sequence.frames.size());
  const double frame = std::floor(time_s * double(sequence.frames_per_second) + 1e-6);
  return static_cast<std::size_t>(wrapped_time(frame, count));
}

}  // namespace encore::scene
