#include "scene/deform.h"

#include "scene/motion.h"
#include "scene/portable_math.h"
#include "scene/rotation.h"

#include <cmath>

namespace encore::scene {
namespace {

double dot(const glm::dvec3& a, const glm::dvec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

glm::dvec3 cross(const glm::dvec3& a, const glm::dvec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

glm::dvec3 axis_or_up(const glm::vec3& axis) {
  const glm::dvec3 a = unit_or_zero(axis);
  return a == glm::dvec3(0.0) ? glm::dvec3(0.0, 1.0, 0.0) : a;
}

double wavelength_or_one(const Deformer& d) {
  return std::isfinite(d.wavelength) && d.wavelength != 0.0F ? double(d.wavelength) : 1.0;
}

/// With displacement A sin(...) along a and the gradient k along d (perpendicular to a), the
/// derivative is I + k a d^T, whose inverse transpose is I - k d a^T.
void wave(const Deformer& deformer, double phase, std::span<glm::vec3> positions,
          std::span<glm::vec3> normals) {
  const glm::dvec3 axis = axis_or_up(deformer.axis);
  const glm::dvec3 direction = across(deformer.axis);
  const double amplitude = deformer.amplitude;
  const double wavelength = wavelength_or_one(deformer);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double turns = phase - dot(direction, glm::dvec3(positions[i])) / wavelength;
    // Only the fraction of a turn matters; taking it first keeps far-away vertices accurate.
    const double angle = 2.0 * kPi * (turns - std::floor(turns));
    positions[i] += glm::vec3(axis * (amplitude * portable_sin(angle)));
    if (normals.empty()) continue;
    const double slope = -2.0 * kPi / wavelength * amplitude * portable_cos(angle);
    const glm::dvec3 n(normals[i]);
    normals[i] = glm::vec3(n - direction * (slope * dot(axis, n)));
  }
}

/// With the rotation R by an angle of slope t along a, and q the offset from the axis, the
/// derivative is R (I + w a^T), w = t a x q, whose inverse transpose is R (I - a w^T).
void twist(const Deformer& deformer, double phase, const glm::vec3& centre,
           std::span<glm::vec3> positions, std::span<glm::vec3> normals) {
  const glm::dvec3 axis = axis_or_up(deformer.axis);
  const double slope =
      double(deformer.amplitude) * portable_sin(2.0 * kPi * phase) / wavelength_or_one(deformer);
  const auto rotated = [&axis](const glm::dvec3& v, double s, double c) {
    return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1.0 - c));
  };
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const glm::dvec3 q = glm::dvec3(positions[i]) - glm::dvec3(centre);
    const double angle = slope * dot(axis, q);
    const double s = portable_sin(angle);
    const double c = portable_cos(angle);
    positions[i] = glm::vec3(glm::dvec3(centre) + rotated(q, s, c));
    if (normals.empty()) continue;
    const glm::dvec3 n(normals[i]);
    const glm::dvec3 w = cross(axis, q) * slope;
    normals[i] = glm::vec3(rotated(n - axis * dot(w, n), s, c));
  }
}

/// A well-mixed 32-bit number for each triangle: multiples of 2^32 divided by the golden ratio
/// (made odd) spread evenly; folding the upper half down between two rounds breaks the pattern.
std::uint32_t scrambled(std::uint32_t x) {
  constexpr std::uint32_t kGolden = 0x9E3779B9U;
  x = (x + 1U) * kGolden;
  x = (x ^ (x >> 16U)) * kGolden;
  return x ^ (x >> 15U);
}

}  // namespace

double deformer_phase(const Deformer& deformer, double time_s) {
  const double period = motion_duration_s(Motion(deformer));
  if (period == 0.0) return 0.0;
  const double phase = wrapped_time(time_s, period) / period;
  return phase < 1.0 ? phase : 0.0;
}

void deform(const Deformer& deformer, double phase, const glm::vec3& centre,
            std::span<glm::vec3> positions, std::span<glm::vec3> normals) {
  switch (deformer.kind) {
    case Deformer::Kind::wave:
      wave(deformer, phase, positions, normals);
      break;
    case Deformer::Kind::twist:
      twist(deformer, phase, centre, positions, normals);
      break;
    case Deformer::Kind::explode:
      break;
  }
}

glm::vec3 explode_offset(const Deformer& deformer, double phase, const glm::vec3& centre,
                         const glm::vec3& centroid, std::uint32_t triangle) {
  const glm::dvec3 away = unit_or_zero(centroid - centre);
  const double factor = 0.5 + scrambled(triangle) * 0x1p-32;
  return glm::vec3(away * (double(deformer.amplitude) * phase * factor));
}

glm::dvec3 across(const glm::vec3& axis) {
  const glm::dvec3 a = axis_or_up(axis);
  glm::dvec3 d(1.0, 0.0, 0.0);
  if (std::fabs(a.y) < std::fabs(a.x) && std::fabs(a.y) <= std::fabs(a.z)) {
    d = {0.0, 1.0, 0.0};
  } else if (std::fabs(a.z) < std::fabs(a.x)) {
    d = {0.0, 0.0, 1.0};
  }
  d -= a * dot(a, d);
  return d / std::sqrt(dot(d, d));
}

}  // namespace encore::scene
