#pragma once

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace encore::scene {

/// Cuts a polygon into exactly corners - 2 triangles, appended as indices into `polygon`, each in
/// the polygon's own turning direction. Convex polygons become a fan around the first corner,
/// concave ones (also with holes that a doubled edge connects) are cut ear by ear in the plane that
/// they fit best (Newell's normal). Fewer than three corners give nothing.
/// Self-crossing outlines have no right answer; they are cut all the same. So that no file can take
/// quadratic time, a polygon that needs more than about a thousand point tests a corner is finished
/// as a fan; the result is then false.
bool triangulate(std::span<const glm::vec3> polygon, std::vector<glm::uvec3>& triangles);

}  // namespace encore::scene
