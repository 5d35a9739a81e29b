#include "app/bench/ray_set.h"

#include "app/bench/random.h"
#include "renderer/camera_rays.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace encore::app::bench {

namespace {

/// Lifts origins clear of the surface in single precision, whichever way it is computed.
constexpr float kLift = 0x1p-16F;

/// Fills everything but `tiles`.
void list_rays(RaySet& set) {
  set.rays.clear();
  set.place.clear();
  set.first.assign(1, 0);
  for (std::size_t i = 0; i < set.tiles.size(); ++i) {
    if (set.tiles[i].t_max >= 0.0F) {
      set.rays.push_back(set.tiles[i]);
      set.place.push_back(static_cast<std::uint32_t>(i));
    }
    if ((i + 1) % RaySet::kTileRays == 0) set.first.push_back(set.rays.size());
  }
}

scene::Ray no_ray() {
  return {.origin = glm::vec3(0.0F), .t_min = 0.0F, .direction = {0, 0, -1}, .t_max = -1.0F};
}

struct SurfacePoint {
  glm::vec3 position;  ///< lifted off
  glm::vec3 normal;    ///< to the side that was seen, of length 1
};

SurfacePoint surface_point(const scene::Ray& ray, const scene::Hit& hit,
                           const scene::Triangle& triangle, float lift) {
  const glm::dvec3 edge1 = glm::dvec3(triangle.v1) - glm::dvec3(triangle.v0);
  const glm::dvec3 edge2 = glm::dvec3(triangle.v2) - glm::dvec3(triangle.v0);
  glm::dvec3 normal = glm::normalize(glm::cross(edge1, edge2));
  if (glm::dot(normal, glm::dvec3(ray.direction)) > 0.0) normal = -normal;
  const glm::dvec3 point = glm::dvec3(triangle.v0) + double{hit.u} * edge1 + double{hit.v} * edge2;
  return {glm::vec3(point + double{lift} * normal), glm::vec3(normal)};
}

glm::vec3 cosine_direction(const glm::vec3& normal, float u, float v) {
  const float radius = std::sqrt(u);
  const float angle = 2.0F * std::numbers::pi_v<float> * v;
  const glm::vec3 other = std::fabs(normal.x) < 0.5F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 tangent = glm::normalize(glm::cross(normal, other));
  const glm::vec3 bitangent = glm::cross(normal, tangent);
  const float height = std::sqrt(std::max(0.0F, 1.0F - u));
  return radius * std::cos(angle) * tangent + radius * std::sin(angle) * bitangent +
         height * normal;
}

scene::Bounds bounds_of_all(std::span<const scene::Triangle> triangles) {
  scene::Bounds bounds;
  for (const scene::Triangle& t : triangles) bounds.extend(scene::bounds_of(t));
  return bounds;
}

float largest_coordinate(const scene::Bounds& bounds) {
  const glm::vec3 far = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
  return std::max({far.x, far.y, far.z});
}

/// A ray from each hit, by make(point, index of the ray in primary.tiles).
template <class Make>
RaySet rays_from_hits(const RaySet& primary, std::span<const scene::Hit> hits,
                      std::span<const scene::Triangle> triangles, float lift, const Make& make) {
  RaySet set;
  set.tiles.assign(primary.tiles.size(), no_ray());
  for (std::size_t i = 0; i < primary.rays.size(); ++i) {
    if (!hits[i].found()) continue;
    const SurfacePoint point =
        surface_point(primary.rays[i], hits[i], triangles[hits[i].triangle], lift);
    const std::uint32_t place = primary.place[i];
    // Triangles of no area have no normal; nothing finite comes of them.
    if (scene::is_finite(point.position)) set.tiles[place] = make(point, place);
  }
  list_rays(set);
  return set;
}

}  // namespace

RaySet primary_rays(const scene::Camera& camera, int side) {
  RaySet set;
  set.kind = "primary";
  const auto frame = renderer::make_camera_frame(camera, side, side);
  set.tiles.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  std::size_t next = 0;
  for (int y = 0; y < side; y += RaySet::kTileSide) {
    for (int x = 0; x < side; x += RaySet::kTileSide) {
      renderer::camera_rays(frame, {x, y, x + RaySet::kTileSide, y + RaySet::kTileSide},
                            std::span(set.tiles).subspan(next, RaySet::kTileRays));
      next += RaySet::kTileRays;
    }
  }
  list_rays(set);
  return set;
}

scene::Camera zoomed(const scene::Camera& camera, const RaySet& primary,
                     std::span<const scene::Hit> hits, int side) {
  int low_x = side;
  int low_y = side;
  int high_x = -1;
  int high_y = -1;
  const int tiles_a_row = side / RaySet::kTileSide;
  for (std::size_t i = 0; i < primary.rays.size(); ++i) {
    if (!hits[i].found()) continue;
    const auto tile = static_cast<int>(primary.place[i] / RaySet::kTileRays);
    const auto within = static_cast<int>(primary.place[i] % RaySet::kTileRays);
    const int x = tile % tiles_a_row * RaySet::kTileSide + within % RaySet::kTileSide;
    const int y = tile / tiles_a_row * RaySet::kTileSide + within / RaySet::kTileSide;
    low_x = std::min(low_x, x);
    high_x = std::max(high_x, x);
    low_y = std::min(low_y, y);
    high_y = std::max(high_y, y);
  }
  if (high_x < 0 || camera.orthographic()) return camera;
  const auto frame = renderer::make_camera_frame(camera, side, side);
  const double across = 0.5 * (low_x + high_x + 1) - frame.center_x;
  const double down = 0.5 * (low_y + high_y + 1) - frame.center_y;
  const glm::dvec3 view = frame.forward + across * frame.right - down * frame.up;
  const double half = 0.5 * std::max(high_x - low_x + 1, high_y - low_y + 1);
  const double half_angle = std::atan2(half * glm::length(frame.right), glm::length(view));
  scene::Camera result = camera;
  const double distance = glm::length(glm::dvec3(camera.target) - glm::dvec3(camera.eye));
  result.target = glm::vec3(glm::dvec3(camera.eye) + distance * glm::normalize(view));
  result.vertical_fov_degrees = static_cast<float>(2.0 * half_angle * 180.0 / std::numbers::pi);
  return result;
}

RaySet bounce_rays(const RaySet& primary, std::span<const scene::Hit> hits,
                   std::span<const scene::Triangle> triangles, std::uint64_t seed) {
  const float lift = kLift * largest_coordinate(bounds_of_all(triangles));
  RaySet set = rays_from_hits(
      primary, hits, triangles, lift, [&](const SurfacePoint& point, std::uint32_t place) {
        scene::Ray ray;
        ray.origin = point.position;
        ray.direction = cosine_direction(point.normal, random_unit(seed, 2 * std::uint64_t{place}),
                                         random_unit(seed, 2 * std::uint64_t{place} + 1));
        return ray;
      });
  set.kind = "bounce";
  return set;
}

RaySet shadow_rays(const RaySet& primary, std::span<const scene::Hit> hits,
                   std::span<const scene::Triangle> triangles) {
  const scene::Bounds bounds = bounds_of_all(triangles);
  const glm::vec3 size = bounds.size();
  const glm::vec3 light =
      bounds.center() + std::max({size.x, size.y, size.z}) * glm::vec3(0.5F, 1.2F, 0.7F);
  RaySet set = rays_from_hits(primary, hits, triangles, kLift * largest_coordinate(bounds),
                              [&](const SurfacePoint& point, std::uint32_t) {
                                scene::Ray ray;
                                ray.origin = point.position;
                                ray.direction = light - point.position;
                                ray.t_max = 1.0F;
                                return ray;
                              });
  set.kind = "shadow";
  set.any_hit = true;
  return set;
}

}  // namespace encore::app::bench
