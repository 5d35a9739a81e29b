#pragma once

#include "app/exit_code.h"
#include "app/profile_options.h"
#include "app/terminal.h"
#include "app/workloads.h"

#include <atomic>
#include <string>

namespace encore::app {

/// What a profile run leaves: its exit code, and the report for standard output.
struct ProfileResult {
  ExitCode code = ExitCode::ok;
  std::string output;
};

/// The names of the scenes of these tests, each once, in order.
std::vector<std::string> scene_names(const std::vector<WorkloadSpec>& specs);

/// Threads that render: one number, or "2 (toys), 4 (bunny)" where scenes ask for different ones.
std::string rendering_threads(const std::vector<WorkloadSpec>& specs);

/// Measures everything that the options ask for, one configuration after the other, and writes the
/// session as it goes. Once `stop` is set it ends after the current operation with what it has
/// (ExitCode::interrupted). A structure that differs from brute force ends it with
/// ExitCode::mismatch and a message on standard error. Throws UsageError and scene::InputError
/// before anything is written, energy::SessionError if the session cannot be.
ProfileResult run_profile(const ProfileOptions& options, const WorkloadTools& tools,
                          const std::atomic<bool>& stop, Terminal& terminal);

}  // namespace encore::app
