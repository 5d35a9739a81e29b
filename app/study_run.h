#pragma once

#include "app/exit_code.h"
#include "app/study_file.h"
#include "app/terminal.h"
#include "app/workloads.h"

#include <atomic>
#include <functional>
#include <string>

namespace encore::app {

/// What `encore study` is asked to do.
struct StudyOptions {
  std::string file;
  std::string out;     ///< session folder; empty: a new one among the user's data
  std::string resume;  ///< session folder to go on with; empty: none
  bool dry_run = false;
  bool json = false;
  MeasuringOptions measuring;  ///< what is given here goes before the file
};

struct StudyResult {
  ExitCode code = ExitCode::ok;
  std::string output;
};

/// Asked between two tests: returns when the study may go on, false if it is to end.
using PausePoint = std::function<bool()>;

/// Runs a study, or tells what it would do. Once `stop` is set it ends after the current operation
/// with what it has (ExitCode::interrupted); `--resume` goes on from there, and from a crash.
/// Throws scene::InputError for a wrong study, UsageError, energy::SensorError and
/// energy::SessionError.
StudyResult run_study(const StudyOptions& options, const WorkloadTools& tools,
                      const std::atomic<bool>& stop, const PausePoint& pause, Terminal& terminal);

}  // namespace encore::app
