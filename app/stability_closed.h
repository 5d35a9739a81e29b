#pragma once

#include "app/stability.h"

#include <string>
#include <vector>

namespace encore::app {

/// "closed-" and the name of each of accel::watertight_cases().
std::vector<std::string> closed_case_names();

/// One structure over a closed mesh, by every mode of the plan, on the CPU: rays aimed at vertices
/// and edges (accel::run_watertight_case). Empty if the plan leaves the CPU out.
std::vector<StabilityRow> run_closed_case(const std::string& name, const accel::StructureSpec& spec,
                                          const StabilityPlan& plan);

}  // namespace encore::app
