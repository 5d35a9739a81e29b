#pragma once

#include "scene/animation.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

namespace encore::scene {

/// Where a deformer's cycle stands: the fraction of its period, in [0, 1). Equal phases give equal
/// shapes. 0 for a deformer that never moves.
double deformer_phase(const Deformer& deformer, double time_s);

/// Deforms vertices in place; `normals` is empty or one a position, and is turned along by the
/// inverse transpose of the deformation's derivative. `centre` is the middle of the shape at rest.
/// wave: position += axis * amplitude * sin(2 pi (phase - s / wavelength)), where s is the
/// coordinate along across(axis). twist: rotation around the axis through `centre` by
/// amplitude * sin(2 pi phase) * (height above the centre / wavelength) radians. explode: nothing,
/// its triangles move as a whole (explode_offset).
void deform(const Deformer& deformer, double phase, const glm::vec3& centre,
            std::span<glm::vec3> positions, std::span<glm::vec3> normals);

/// How far a triangle has flown in an explosion: away from `centre`, straight, by
/// amplitude * phase * a factor in [0.5, 1.5) that depends on the triangle's number only.
glm::vec3 explode_offset(const Deformer& deformer, double phase, const glm::vec3& centre,
                         const glm::vec3& centroid, std::uint32_t triangle);

/// The direction in which a wave along `axis` travels: the coordinate axis that is least aligned
/// with it (the first of equals), made perpendicular to it. Unit length.
glm::dvec3 across(const glm::vec3& axis);

}  // namespace encore::scene
