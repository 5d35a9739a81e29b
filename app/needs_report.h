#pragma once

#include "app/needs_cost.h"
#include "app/workloads.h"
#include "scene/left_out.h"

#include <atomic>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// What a scene did without in a run.
struct SceneLeftOut {
  std::string scene;
  std::vector<scene::LeftOut> features;
  std::optional<NeedsCost> cost;  ///< where it was measured
};

/// What each scene of these tests did without, in their order; scenes that nothing draws are left
/// out. Milliseconds are measured for those that the CPU draws standing still (TestKind::fixed),
/// unless `stop` is set.
std::vector<SceneLeftOut> scenes_left_out(const std::vector<WorkloadSpec>& specs,
                                          const std::atomic<bool>& stop);

/// A table a scene for people; empty where nothing is left out.
std::string left_out_text(const std::vector<SceneLeftOut>& scenes);

/// The same as a JSON array, indented as a member of the report; what does not apply or was not
/// measured is null.
std::string left_out_json(const std::vector<SceneLeftOut>& scenes);

/// What a picture and a run use: "lights, shading normals, animation, device cpu".
std::string needs_text(const scene::RunNeeds& needs, const scene::RunParts& parts);

}  // namespace encore::app
