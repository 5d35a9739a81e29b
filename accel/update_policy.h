#pragma once

#include "accel/acceleration_structure.h"
#include "accel/settings.h"
#include "scene/triangles.h"

#include <span>

namespace encore::accel {

/// What is done to a structure before it is traced again.
enum class UpdateAction { none, build, update };

/// What a policy makes of a change of the triangles:
/// - nothing changed: none, whatever the policy;
/// - rebuild: build;
/// - refit: update while the triangles only moved, else build;
/// - automatic: as refit, but a structure that has decayed is built;
/// - fixed: none.
/// Structures that cannot refit are built where others are updated.
///
/// Under `automatic` a structure is judged by what the last carry_out() left, so that a frame pays
/// for an update or a build, never for both; the frame that is found too bad is traced as it is.
/// The rule is Lauterbach et al.'s (2006): rebuild when the hierarchy has lost a set share of its
/// quality. Weighing times against each other (Kopta et al. 2012) would rebuild less where builds
/// are dear, but at other frames on every run and machine, and a session could not be repeated.
UpdateAction decide(Policy policy, const AccelerationStructure& structure,
                    scene::TriangleChange change);

/// Does it. Under `automatic` the quality of what came out is looked at as well (a pass over the
/// nodes, part of the build or update); whoever updates by other means calls assess() himself.
void carry_out(UpdateAction action, Policy policy, AccelerationStructure& structure,
               std::span<const Triangle> triangles);

/// Whether the policy ever updates this structure instead of building it.
bool updates(Policy policy, const AccelerationStructure& structure);

}  // namespace encore::accel
