#include "accel/update_policy.h"

#include <optional>

namespace encore::accel {

bool updates(Policy policy, const AccelerationStructure& structure) {
  switch (policy) {
    case Policy::refit:
    case Policy::automatic:
      return structure.can_refit();
    case Policy::rebuild:
    case Policy::fixed:
      return false;
  }
  return false;
}

UpdateAction decide(Policy policy, const AccelerationStructure& structure,
                    scene::TriangleChange change) {
  if (change == scene::TriangleChange::none || policy == Policy::fixed) return UpdateAction::none;
  if (change == scene::TriangleChange::topology || !updates(policy, structure)) {
    return UpdateAction::build;
  }
  const bool spent = policy == Policy::automatic && structure.decayed();
  return spent ? UpdateAction::build : UpdateAction::update;
}

UpdateAction decide(Policy policy, const AccelerationStructure& structure,
                    scene::TriangleChange change, const AutoPolicy& costs) {
  const UpdateAction by_quality = decide(policy, structure, change);
  const bool free = policy == Policy::automatic && change == scene::TriangleChange::moved &&
                    structure.can_refit();
  if (!free) return by_quality;
  // A tree that decays, but whose decay nobody knows, can only be built.
  if (!structure.decay() && structure.decayed()) return UpdateAction::build;
  const std::optional<bool> builds = costs.builds_next();
  if (!builds) return by_quality;
  return *builds ? UpdateAction::build : UpdateAction::update;
}

void carry_out(UpdateAction action, Policy policy, AccelerationStructure& structure,
               std::span<const Triangle> triangles) {
  switch (action) {
    case UpdateAction::none:
      return;
    case UpdateAction::build:
      structure.build(triangles);
      break;
    case UpdateAction::update:
      structure.update(triangles);
      break;
  }
  if (policy == Policy::automatic) structure.assess();
}

}  // namespace encore::accel
