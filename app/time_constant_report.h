#pragma once

#include "app/log_plot_svg.h"
#include "energy/battery_life/step_study.h"
#include "energy/convergence/time_constant_study.h"

#include <filesystem>
#include <string>
#include <vector>

namespace encore::app {

/// Errors as a table a method: time constants down, steps across.
std::string time_constant_text(const std::vector<energy::TimeConstantTable>& tables);
/// The JSON member "time_constants".
std::string time_constant_json(const std::vector<energy::TimeConstantTable>& tables);

/// What `encore battery --steps` studied.
struct StepStudy {
  std::vector<energy::StepTable> battery;
  std::vector<energy::TimeConstantTable> time_constants;
};

/// One line a combination, both studies; what does not apply or is not known is empty. Throws
/// energy::SessionError.
void write_step_csv(const std::filesystem::path& file, const StepStudy& study);

/// Error against step size and against run time, of both studies.
std::vector<LogPlot> step_plots(const StepStudy& study);

}  // namespace encore::app
