#pragma once

#include "app/exit_code.h"
#include "app/profile_options.h"
#include "app/profile_report.h"
#include "app/terminal.h"
#include "app/workloads.h"
#include "energy/session.h"

#include <atomic>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// What a profile run leaves: its exit code, and the report for standard output.
struct ProfileResult {
  ExitCode code = ExitCode::ok;
  std::string output;
};

/// The names of the scenes of these tests, each once, in order.
std::vector<std::string> scene_names(const std::vector<WorkloadSpec>& specs);

/// Opens the graphics device if one of these tests needs it, and names it in a line of information.
/// Throws renderer::gl::GlUnavailable.
std::optional<GpuInfo> open_gpu_for(const std::vector<WorkloadSpec>& specs,
                                    const WorkloadTools& tools, Terminal& terminal);

/// Threads that render on the CPU: one number, or "2 (toys), 4 (bunny)" where scenes ask for
/// different ones; empty if nothing renders there.
std::string rendering_threads(const std::vector<WorkloadSpec>& specs);

/// How a run ended, and everything that it measured.
struct ProfileOutcome {
  ExitCode code = ExitCode::ok;
  ProfileReport report;
};

/// Measures these configurations as run_profile() does, options telling how.
ProfileOutcome measure_profile(const ProfileOptions& options,
                               const std::vector<WorkloadSpec>& specs, const WorkloadTools& tools,
                               const std::atomic<bool>& stop, Terminal& terminal);

/// Measures everything that the options ask for, one configuration after the other, and writes the
/// session as it goes. Once `stop` is set it ends after the current operation with what it has
/// (ExitCode::interrupted). A structure that differs from brute force ends it with
/// ExitCode::mismatch and a message on standard error. A configuration that fails on the graphics
/// device is told and left out, the others are measured, and it ends with ExitCode::failure. Throws
/// UsageError, scene::InputError and, where a device needs OpenGL and there is none,
/// renderer::gl::GlUnavailable before anything is measured or written, energy::SessionError if the
/// session cannot be.
ProfileResult run_profile(const ProfileOptions& options, const WorkloadTools& tools,
                          const std::atomic<bool>& stop, Terminal& terminal);

}  // namespace encore::app
