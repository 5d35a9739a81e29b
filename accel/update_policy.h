#pragma once

#include "accel/acceleration_structure.h"
#include "accel/auto_policy.h"
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
/// The first of the two goes by quality alone (AutoRule::quality; Lauterbach et al. 2006): rebuild
/// when the hierarchy has lost a set share of it, at the same frames on every run and machine. The
/// second goes by what building, updating and tracing were seen to cost (AutoRule::cost), as soon
/// as that is known and unless `costs` says otherwise.
UpdateAction decide(Policy policy, const AccelerationStructure& structure,
                    scene::TriangleChange change);
UpdateAction decide(Policy policy, const AccelerationStructure& structure,
                    scene::TriangleChange change, const AutoPolicy& costs);

/// Does it. Under `automatic` the quality of what came out is looked at as well (a pass over the
/// nodes, part of the build or update); whoever updates by other means calls assess() himself.
void carry_out(UpdateAction action, Policy policy, AccelerationStructure& structure,
               std::span<const Triangle> triangles);

/// Whether the policy ever updates this structure instead of building it.
bool updates(Policy policy, const AccelerationStructure& structure);

}  // namespace encore::accel
