#include "accel/test_rays.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace encore::accel {

namespace {

/// Random numbers that are the same everywhere: the standard fixes the engine's bits, not what its
/// distributions make of them.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// In [0, 1), a multiple of 2^-24.
  float unit() { return static_cast<float>(engine_() >> 40) * 0x1p-24F; }
  float between(float low, float high) { return low + (high - low) * unit(); }
  std::uint32_t below(std::size_t count) {
    return static_cast<std::uint32_t>(engine_() % std::max<std::size_t>(count, 1));
  }
  /// A direction with components in [-1, 1), never zero.
  glm::vec3 direction() {
    for (;;) {
      const glm::vec3 d{between(-1, 1), between(-1, 1), between(-1, 1)};
      if (glm::dot(d, d) > 0.01F) return d;
    }
  }
  glm::vec3 inside(const Bounds& b) {
    return {between(b.min.x, b.max.x), between(b.min.y, b.max.y), between(b.min.z, b.max.z)};
  }
  glm::vec3 on(const Triangle& t) {
    float u = unit();
    float v = unit();
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    return t.v0 + u * (t.v1 - t.v0) + v * (t.v2 - t.v0);
  }
  float signed_zero() { return below(2) == 0 ? 0.0F : -0.0F; }

 private:
  std::mt19937_64 engine_;
};

/// A plane of the structure: x, y or z equal to a position.
struct Plane {
  int axis;
  float position;
};

std::vector<Plane> planes_of(const AccelerationStructure& structure, const Bounds& scene) {
  std::vector<Plane> planes;
  constexpr std::size_t kEnough = 4096;
  structure.visit([&](const NodeView& node) {
    if (node.split_axis >= 0) planes.push_back({node.split_axis, node.split_position});
    if (!node.bounds.empty()) {
      const int axis = static_cast<int>(planes.size() % 3);
      planes.push_back({axis, node.bounds.min[axis]});
      planes.push_back({axis, node.bounds.max[axis]});
    }
    return planes.size() < kEnough;
  });
  for (int axis = 0; axis < 3; ++axis) {
    planes.push_back({axis, scene.min[axis]});
    planes.push_back({axis, scene.max[axis]});
  }
  return planes;
}

class RayMaker {
 public:
  RayMaker(std::uint64_t seed, std::span<const Triangle> triangles)
      : random_(seed), triangles_(triangles) {
    for (const Triangle& t : triangles) bounds_.extend(scene::bounds_of(t));
    const glm::vec3 size = bounds_.size();
    radius_ = std::max({size.x, size.y, size.z, bounds_.max.x * 0x1p-20F});
    if (!(radius_ > 0)) radius_ = 1.0F;
  }

  [[nodiscard]] const Bounds& bounds() const { return bounds_; }

  Ray make(RayKind kind, const std::vector<Plane>& planes) {
    switch (kind) {
      case RayKind::outside:
        return towards(bounds_.center() + 1.5F * radius_ * random_.direction());
      case RayKind::inside:
        return {random_.inside(bounds_), 0.0F, random_.direction()};
      case RayKind::far:
        return towards(bounds_.center() + 1e6F * radius_ * random_.direction());
      case RayKind::axis:
        return axis_ray();
      case RayKind::plane:
        return plane_ray(planes[random_.below(planes.size())]);
      case RayKind::surface:
        return {random_.on(any_triangle()), 0.0F, random_.direction()};
      case RayKind::edge:
        return edge_ray();
      case RayKind::limited:
        return limited_ray();
    }
    return {};
  }

 private:
  const Triangle& any_triangle() { return triangles_[random_.below(triangles_.size())]; }

  Ray towards(const glm::vec3& origin) {
    const glm::vec3 aim =
        random_.below(2) == 0 ? random_.inside(bounds_) : random_.on(any_triangle());
    return {origin, 0.0F, nonzero(aim - origin)};
  }

  /// Directions of unit order, so that t counts in scene sizes at any scale.
  glm::vec3 nonzero(const glm::vec3& d) {
    const float size = std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)});
    return size > 0 && std::isfinite(size) ? d / size : glm::vec3(0, 0, -1);
  }

  Ray axis_ray() {
    const auto axis = static_cast<int>(random_.below(3));
    glm::vec3 direction{random_.signed_zero(), random_.signed_zero(), random_.signed_zero()};
    direction[axis] = random_.below(2) == 0 ? 1.0F : -1.0F;
    glm::vec3 origin = random_.below(2) == 0 ? random_.inside(bounds_) : random_.on(any_triangle());
    // Half of them start outside, so that they enter through a face.
    if (random_.below(2) == 0) {
      origin[axis] =
          direction[axis] > 0 ? bounds_.min[axis] - radius_ : bounds_.max[axis] + radius_;
    }
    return {origin, 0.0F, direction};
  }

  Ray plane_ray(const Plane& plane) {
    glm::vec3 origin = random_.below(2) == 0 ? random_.inside(bounds_) : random_.on(any_triangle());
    origin[plane.axis] = plane.position;
    glm::vec3 direction = random_.direction();
    if (random_.below(4) != 0) direction[plane.axis] = random_.signed_zero();
    // Some along a line where two planes may meet.
    if (random_.below(4) == 0) direction[(plane.axis + 1) % 3] = random_.signed_zero();
    if (direction == glm::vec3(0.0F)) direction[(plane.axis + 2) % 3] = 1.0F;
    if (random_.below(2) == 0) origin -= 2.0F * radius_ * direction;
    origin[plane.axis] = direction[plane.axis] == 0.0F ? plane.position : origin[plane.axis];
    return {origin, 0.0F, direction};
  }

  Ray edge_ray() {
    const Triangle& t = any_triangle();
    const glm::vec3 vertices[3] = {t.v0, t.v1, t.v2};
    const std::uint32_t first = random_.below(3);
    const glm::vec3 a = vertices[first];
    const glm::vec3 b = vertices[(first + 1) % 3];
    const float share = random_.below(2) == 0 ? 0.0F : random_.unit();
    const glm::vec3 origin = bounds_.center() + 1.5F * radius_ * random_.direction();
    return {origin, 0.0F, nonzero(a + share * (b - a) - origin)};
  }

  Ray limited_ray() {
    Ray ray = towards(bounds_.center() + 1.5F * radius_ * random_.direction());
    const float reach = 4.0F * radius_;
    ray.t_min = random_.between(0.0F, reach);
    ray.t_max = random_.between(ray.t_min, reach);
    return ray;
  }

  Random random_;
  std::span<const Triangle> triangles_;
  Bounds bounds_;
  float radius_ = 1.0F;
};

constexpr std::array kKinds{RayKind::outside, RayKind::inside,  RayKind::far,  RayKind::axis,
                            RayKind::plane,   RayKind::surface, RayKind::edge, RayKind::limited};

}  // namespace

std::string_view to_string(RayKind kind) {
  switch (kind) {
    case RayKind::outside:
      return "outside";
    case RayKind::inside:
      return "inside";
    case RayKind::far:
      return "far";
    case RayKind::axis:
      return "axis";
    case RayKind::plane:
      return "plane";
    case RayKind::surface:
      return "surface";
    case RayKind::edge:
      return "edge";
    case RayKind::limited:
      return "limited";
  }
  return "unknown";
}

std::span<const RayKind> all_ray_kinds() {
  return kKinds;
}

std::vector<Ray> test_rays(RayKind kind, std::size_t count, std::uint64_t seed,
                           std::span<const Triangle> triangles,
                           const AccelerationStructure& structure) {
  std::vector<Ray> rays;
  if (triangles.empty()) return rays;
  RayMaker maker(seed, triangles);
  const std::vector<Plane> planes =
      kind == RayKind::plane ? planes_of(structure, maker.bounds()) : std::vector<Plane>{};
  rays.reserve(count);
  for (std::size_t i = 0; i < count; ++i) rays.push_back(maker.make(kind, planes));
  return rays;
}

}  // namespace encore::accel
