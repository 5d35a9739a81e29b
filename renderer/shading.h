#pragma once

#include "scene/needs.h"
#include "scene/ray.h"
#include "scene/scene.h"
#include "scene/triangles.h"

#include <glm/vec3.hpp>

#include <span>

namespace encore::renderer {

/// The light that comes from everywhere: a surface's ambient colour counts this much. (Model files
/// commonly repeat the diffuse colour as the ambient one, made for a dim ambient light.)
inline constexpr float kAmbientLight = 0.2F;

/// What the shading of a scene has to do; whatever is off costs nothing in the inner loop. Without
/// light nothing is on: surfaces then show what they emit and reflect of the ambient light.
struct ShadingNeeds {
  bool normals = false;   ///< interpolate shading normals
  bool colors = false;    ///< interpolate vertex colours
  bool textures = false;  ///< look textures up
  bool specular = false;  ///< highlights: some material has a specular colour, and there is a light

  friend bool operator==(const ShadingNeeds&, const ShadingNeeds&) = default;
};

/// The part of what a scene needs (scene/needs.h) that concerns shading.
ShadingNeeds shading_needs(const scene::Needs& needs);

/// What shading reads; both stay the caller's.
struct ShadingScene {
  const scene::Scene* scene = nullptr;
  const scene::TriangleList* triangles = nullptr;
};

/// Colours (linear RGB, not clamped) of rays.size() == hits.size() == colors.size() rays.
///
/// Phong's model (1975) for point lights without falloff and without shadows, as in the thesis:
///   emission + kAmbientLight * ambient
///     + sum over lights of light * (diffuse * vertex colour * texture * N.L
///                                   + specular * (R.V)^shininess)
/// with highlights only where N.L > 0. Surfaces are two-sided: the geometric normal is turned
/// towards the viewer, an interpolated one towards the same side as the geometric one, so that
/// neither the triangle's winding nor a silhouette flips the light. Where the interpolated normal
/// is zero the geometric one is used; a light at the very point that it lights adds nothing. A miss
/// shows the scene's background. Ray directions must have unit length. A triangle whose material
/// does not exist is shaded as Material{}. Textures: texture_lookup.h.
///
/// Vectors are computed in double: neither large nor tiny scenes overflow, and every machine and
/// thread gets the same bits.
using ShadeFunction = void (*)(const ShadingScene& input, std::span<const scene::Ray> rays,
                               std::span<const scene::Hit> hits, std::span<glm::vec3> colors);

/// The variant that does what is needed and no more; chosen once a frame.
ShadeFunction choose_shading(const ShadingNeeds& needs);

}  // namespace encore::renderer
