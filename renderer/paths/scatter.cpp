#include "renderer/paths/scatter.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace encore::renderer {

namespace {

using glm::dvec3;

double largest_coordinate(const dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

double share(float value) {
  return std::min(std::max(static_cast<double>(value), 0.0), 1.0);
}

/// d - 2 (d.n) n, or about the geometric normal if that leads below the surface.
dvec3 mirrored(const dvec3& along, const dvec3& normal, const dvec3& geometric) {
  const dvec3 out = along - normal * (2.0 * glm::dot(along, normal));
  if (glm::dot(out, geometric) > 0.0) return out;
  return along - geometric * (2.0 * glm::dot(along, geometric));
}

/// What a smooth boundary does to a ray that comes along `along`.
struct Boundary {
  bool total = false;     ///< all of it is mirrored
  double mirrored = 0.0;  ///< share that is mirrored
  dvec3 direction{0.0};   ///< of what goes through; not of unit length
};

/// Snell's law about `normal`.
Boundary refract(const dvec3& along, const dvec3& normal, double eta) {
  if (eta == 1.0) return {.direction = along};
  const double cosine = std::min(-glm::dot(along, normal), 1.0);
  const double squared = 1.0 - eta * eta * (1.0 - cosine * cosine);
  if (!(squared > 0.0)) return {.total = true, .mirrored = 1.0};
  return {.mirrored = fresnel(cosine, eta),
          .direction = along * eta + normal * (eta * cosine - std::sqrt(squared))};
}

Boundary cross_boundary(const dvec3& along, const dvec3& normal, const SurfacePoint& at,
                        const scene::Material& material) {
  const double given = material.index_of_refraction;
  const double index = given > 0.0 ? given : 1.0;
  const double eta = at.entering ? 1.0 / index : index;
  const Boundary about_normal = refract(along, normal, eta);
  if (about_normal.total || glm::dot(about_normal.direction, at.geometric) < 0.0) {
    return about_normal;
  }
  return refract(along, at.geometric, eta);
}

/// The ray that leaves the surface in a direction of any length, if it counts enough.
std::optional<Continuation> go_on(const SurfacePoint& at, const dvec3& side, const dvec3& direction,
                                  const dvec3& share_of_light, const glm::vec3& weight) {
  Continuation next;
  next.weight = glm::vec3(share_of_light);
  const glm::vec3 here = next.weight * weight;
  if (!(std::max({here.r, here.g, here.b}) >= kLeastWeight)) return std::nullopt;
  const double scale = 1.0 / std::sqrt(glm::dot(direction, direction));
  next.ray.origin = lifted_origin(at, side);
  next.ray.direction = glm::vec3(direction * scale);
  return next;
}

/// The mirrored light's colour: the specular one, as bright as white.
dvec3 mirror_tint(const scene::Material& material) {
  const dvec3 specular(material.specular);
  const double mean = (specular.r + specular.g + specular.b) / 3.0;
  return mean > 0.0 ? specular / mean : dvec3(1.0);
}

}  // namespace

SurfacePoint surface_point(const scene::Ray& ray, const scene::Hit& hit,
                           const scene::Triangle& triangle,
                           const std::array<glm::vec3, 3>* smooth) {
  const dvec3 corner(triangle.v0);
  const dvec3 edge1 = dvec3(triangle.v1) - corner;
  const dvec3 edge2 = dvec3(triangle.v2) - corner;
  const dvec3 view = -dvec3(ray.direction);
  const double u = hit.u;
  const double v = hit.v;

  SurfacePoint at;
  at.point = corner + edge1 * u + edge2 * v;
  at.reach =
      std::max({largest_coordinate(at.point), largest_coordinate(corner),
                largest_coordinate(dvec3(triangle.v1)), largest_coordinate(dvec3(triangle.v2))});
  const dvec3 facing = glm::cross(edge1, edge2);
  const double squared_area = glm::dot(facing, facing);
  at.entering = !(glm::dot(facing, view) < 0.0);
  at.geometric = view;
  if (squared_area > 0.0) {
    at.geometric = facing * ((at.entering ? 1.0 : -1.0) / std::sqrt(squared_area));
  }
  at.normal = at.geometric;
  if (smooth != nullptr && squared_area > 0.0) {
    const dvec3 normal =
        dvec3((*smooth)[0]) * (1.0 - u - v) + dvec3((*smooth)[1]) * u + dvec3((*smooth)[2]) * v;
    const double squared = glm::dot(normal, normal);
    if (squared > 0.0) {
      const double sign = glm::dot(normal, at.geometric) < 0.0 ? -1.0 : 1.0;
      at.normal = normal * (sign / std::sqrt(squared));
    }
  }
  return at;
}

glm::vec3 lifted_origin(const SurfacePoint& at, const glm::dvec3& side) {
  return glm::vec3(at.point + side * (kOriginLift * at.reach));
}

double fresnel(double cosine, double eta) {
  if (eta == 1.0) return 0.0;
  const double squared = 1.0 - eta * eta * (1.0 - cosine * cosine);
  if (!(squared > 0.0)) return 1.0;
  const double through = std::sqrt(squared);
  const double across = (eta * cosine - through) / (eta * cosine + through);
  const double along = (eta * through - cosine) / (eta * through + cosine);
  return 0.5 * (across * across + along * along);
}

Scattering scatter(const scene::Ray& ray, const SurfacePoint& at, const scene::Material& material,
                   const Bounces& wanted, bool at_limit, const glm::vec3& weight) {
  const double mirror = wanted.reflections ? share(material.reflectivity) : 0.0;
  const double glass = wanted.refractions ? (1.0 - mirror) * (1.0 - share(material.opacity)) : 0.0;
  Scattering result;
  result.own = static_cast<float>((1.0 - mirror) - glass);
  if (at_limit || !(mirror > 0.0 || glass > 0.0)) return result;

  const dvec3 along(ray.direction);
  const dvec3 normal = glm::dot(along, at.normal) < 0.0 ? at.normal : at.geometric;
  dvec3 mirrored_share = mirror_tint(material) * mirror;
  if (glass > 0.0) {
    const Boundary boundary = cross_boundary(along, normal, at, material);
    if (boundary.total) {
      result.refraction =
          go_on(at, at.geometric, mirrored(along, normal, at.geometric), dvec3(glass), weight);
    } else {
      if (wanted.reflections) mirrored_share += dvec3(glass * boundary.mirrored);
      result.refraction = go_on(at, -at.geometric, boundary.direction,
                                dvec3(glass * (1.0 - boundary.mirrored)), weight);
    }
  }
  if (wanted.reflections) {
    result.reflection =
        go_on(at, at.geometric, mirrored(along, normal, at.geometric), mirrored_share, weight);
  }
  return result;
}

std::optional<scene::Ray> shadow_ray(const SurfacePoint& at, const glm::vec3& light) {
  const dvec3 place(light);
  if (!(glm::dot(at.normal, place - at.point) > 0.0)) return std::nullopt;
  scene::Ray ray;
  ray.origin = lifted_origin(at, at.geometric);
  const dvec3 way = place - dvec3(ray.origin);
  if (!(glm::dot(at.geometric, way) > 0.0)) return std::nullopt;
  const double distance = std::sqrt(glm::dot(way, way));
  ray.direction = glm::vec3(way * (1.0 / distance));
  ray.t_max = static_cast<float>(distance) * kShadowReach;
  return ray;
}

}  // namespace encore::renderer
