#include "accel/watertight_study.h"
#include "scene/basic_shapes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace encore::accel {

namespace {

using Corner = std::array<float, 3>;
// Either zero is the same place.
Corner corner(const glm::vec3& p) {
  return {p.x + 0.0F, p.y + 0.0F, p.z + 0.0F};
}

/// The model's triangles after `place` has moved its vertices: a function of the position alone, so
/// that what is shared stays shared bit for bit.
template <class Place>
std::vector<Triangle> moved(const scene::Model& model, const Place& place) {
  std::vector<Triangle> triangles;
  const auto& positions = model.mesh.positions;
  for (const glm::uvec3& t : model.mesh.triangles) {
    triangles.push_back(
        scene::make_triangle(place(positions[t.x]), place(positions[t.y]), place(positions[t.z])));
  }
  return triangles;
}

/// In [0, 1), without order but always the same for a place.
float scattered(const glm::vec3& p) {
  std::uint32_t h = 0;
  for (const float x : corner(p)) {
    h = (h ^ std::bit_cast<std::uint32_t>(x)) * 0x9E3779B1U;
    h = (h ^ h >> 15U) * 0x85EBCA77U;
  }
  return static_cast<float>(h >> 8U) * 0x1p-24F;
}

}  // namespace

bool is_closed(std::span<const Triangle> triangles) {
  using Edge = std::pair<Corner, Corner>;
  std::vector<Edge> forward, backward;
  for (const Triangle& t : triangles) {
    const glm::vec3 corners[3] = {t.v0, t.v1, t.v2};
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner a = corner(corners[i]), b = corner(corners[(i + 1) % 3]);
      if (a == b) return false;
      forward.emplace_back(a, b);
      backward.emplace_back(b, a);
    }
  }
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  return !forward.empty() && forward == backward &&
         std::adjacent_find(forward.begin(), forward.end()) == forward.end();
}

std::optional<WatertightCase> make_watertight_case(std::string name,
                                                   std::span<const Triangle> triangles,
                                                   const glm::vec3& center) {
  if (!is_closed(triangles)) return std::nullopt;
  WatertightCase mesh{std::move(name), {triangles.begin(), triangles.end()}, center, 0.0F, 0.0F};
  // Seen whole from the centre, the mesh lies on one side of it of each of its planes; the nearest
  // plane bounds the ball.
  double nearest = std::numeric_limits<double>::max();
  double farthest = 0.0;
  double side = 0.0;
  for (const Triangle& t : triangles) {
    const glm::dvec3 a = glm::dvec3(t.v0) - glm::dvec3(center);
    const glm::dvec3 b = glm::dvec3(t.v1) - glm::dvec3(center);
    const glm::dvec3 c = glm::dvec3(t.v2) - glm::dvec3(center);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double area = glm::length(normal);
    if (!(area > 0)) return std::nullopt;
    const double height = glm::dot(normal, a) / area;
    if (height == 0 || height * side < 0) return std::nullopt;
    side = height;
    nearest = std::min(nearest, std::fabs(height));
    for (const glm::dvec3& p : {a, b, c}) farthest = std::max(farthest, glm::length(p));
  }
  mesh.clearance = static_cast<float>(0.99 * nearest);
  mesh.radius = static_cast<float>(farthest);
  return mesh;
}

std::vector<WatertightCase> watertight_cases() {
  std::vector<WatertightCase> cases;
  const auto add = [&cases](const char* name, const std::vector<Triangle>& triangles,
                            const glm::vec3& center) {
    if (auto mesh = make_watertight_case(name, triangles, center)) {
      cases.push_back(std::move(*mesh));
    }
  };
  const glm::vec3 origin(0.0F);
  const auto as_it_is = [](const glm::vec3& p) { return p; };
  add("sphere", moved(scene::sphere_model(), as_it_is), origin);
  add("box", moved(scene::box_model(), as_it_is), origin);
  add("bumpy",
      moved(scene::sphere_model(128, 64),
            [](const glm::vec3& p) { return p * (1.0F + 0.05F * scattered(p)); }),
      origin);
  add("needles",
      moved(scene::sphere_model(200, 6),
            [](const glm::vec3& p) { return p * glm::vec3(0.01F, 10.0F, 0.01F); }),
      origin);
  const glm::vec3 away(3000.0F, -2000.0F, 1000.0F);
  add("far", moved(scene::sphere_model(), [&](const glm::vec3& p) { return p + away; }), away);
  return cases;
}

}  // namespace encore::accel
