#pragma once

#include "scene/material.h"
#include "scene/ray.h"
#include "scene/triangle.h"

#include <glm/vec3.hpp>

#include <array>
#include <optional>

namespace encore::renderer {

/// How light goes on at a surface (Whitted 1980; shaders/scatter.glsl is the twin). Everything here
/// is computed in double precision as it is written, on both devices, so that CPU and GPU send the
/// very same rays on.

/// Rays whose whole way here passes on less than this share of the light (in its strongest colour)
/// are not traced.
inline constexpr float kLeastWeight = 0x1p-10F;
/// How far the origin of a ray that leaves a surface is lifted off it: this share of the largest
/// coordinate in sight (the point's, the corners'), along the geometric normal on the side that the
/// ray leaves to. Above what rounding the point to single precision may take away, so that a
/// surface never hides from itself, whatever the scene's scale or place.
inline constexpr double kOriginLift = 0x1p-21;
/// Shadow rays end this short of the light, as a share of the way.
inline constexpr float kShadowReach = 1.0F - 0x1p-20F;

/// A point on a triangle, and which way is up there.
struct SurfacePoint {
  glm::dvec3 point{0.0};
  glm::dvec3 geometric{0.0};  ///< unit normal of the triangle on the viewer's side
  glm::dvec3 normal{0.0};     ///< unit shading normal on that side; where there is none `geometric`
  double reach = 0.0;         ///< the largest coordinate (by its size) of point and corners
  /// Whether the ray meets the triangle's front (the side from which it runs counterclockwise), and
  /// so enters what the mesh encloses.
  bool entering = true;
};

/// `smooth`: the corners' shading normals; null if there are none. A triangle without area has the
/// direction that the ray came from as its normals.
SurfacePoint surface_point(const scene::Ray& ray, const scene::Hit& hit,
                           const scene::Triangle& triangle, const std::array<glm::vec3, 3>* smooth);

/// The origin of a ray that leaves the surface towards `side` (the geometric normal, or against
/// it): point + side * (kOriginLift * reach), rounded to single precision.
glm::vec3 lifted_origin(const SurfacePoint& at, const glm::dvec3& side);

/// Share of unpolarised light that a smooth boundary mirrors (Fresnel's equations). `cosine`: of
/// the angle of incidence, in [0, 1]; `eta`: index of refraction where the ray comes from over that
/// of where it goes to. 1 at total internal reflection, 0 for eta == 1.
double fresnel(double cosine, double eta);

/// Which further rays are traced at all.
struct Bounces {
  bool reflections = false;
  bool refractions = false;
};

/// A ray that goes on, and which share of what it brings back counts here. Its direction has unit
/// length; t runs over (0, inf).
struct Continuation {
  scene::Ray ray;
  glm::vec3 weight{0.0F};
};

/// What becomes of a ray at a surface.
///
/// With m = reflectivity (0 without reflections) and glass share a = (1 - m) (1 - opacity) (0
/// without refractions):
/// - the surface's own colour (Phong) counts (1 - m) - a;
/// - the mirrored ray counts m * tint + a * F, F by fresnel(); tint = specular / mean(specular)
///   where a specular colour is given, else 1; the a * F part is left out without reflections;
/// - the refracted ray counts a (1 - F). At total internal reflection it is the one that is
///   mirrored, and counts a: refraction's ray, not reflection's.
/// Mirrored: d - 2 (d.n) n about the shading normal; about the geometric one if that would lead
/// below the surface. Refracted: by Snell's law about the shading normal with eta = 1 / index when
/// entering, index when leaving; about the geometric one if that would not lead below the surface.
/// A shading normal that faces away from the ray (d.n >= 0) counts as the geometric one in all of
/// this, and an index of refraction that is not above 0 as 1. With an index of 1 a ray goes
/// straight on.
struct Scattering {
  /// Where this is 0 the surface is not shaded at all, and asks for no shadow rays.
  float own = 1.0F;
  std::optional<Continuation> reflection;
  std::optional<Continuation> refraction;
};

/// `at_limit`: nothing goes on, and the shares that would have are lost. `weight`: of the ray here;
/// continuations whose weight times `weight` is below kLeastWeight in its largest component are
/// left out.
Scattering scatter(const scene::Ray& ray, const SurfacePoint& at, const scene::Material& material,
                   const Bounces& wanted, bool at_limit, const glm::vec3& weight);

/// The ray that asks whether a light is in sight: from the lifted origin in unit direction to the
/// light's place, t over (0, distance * kShadowReach]. (Unit length as the directions of all rays
/// here: neither huge nor tiny scenes then overflow where a traversal divides by it.) Nothing if
/// the light adds nothing, or is not on the viewer's side of the triangle as seen from that origin.
std::optional<scene::Ray> shadow_ray(const SurfacePoint& at, const glm::vec3& light);

}  // namespace encore::renderer
