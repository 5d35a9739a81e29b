#pragma once

#include "app/common_options.h"
#include "app/measuring_options.h"
#include "app/terminal.h"
#include "app/workloads.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace encore::app {

/// What `encore profile` is asked to do, as the command line says it.
struct ProfileOptions : CommonOptions {
  std::vector<std::string> policies;  ///< empty: the scene's own preference, else rebuild
  std::vector<std::string> tests;     ///< empty: all that apply
  std::string size = "256";
  MeasuringOptions measuring;
  std::string out;                   ///< session folder; empty: a new one among the user's data
  std::string build_on = "auto";     ///< where trees for the gpu are built: auto, cpu, device
  std::string update_case;           ///< empty: as the structure's settings say
  std::vector<std::string> devices;  ///< empty: the scene's own preference, else cpu
};

/// Makes a scene from its name or path; throws scene::InputError.
using SceneOpener = std::function<std::shared_ptr<const scene::Scene>(const std::string&)>;

/// Opens the scenes and lists everything to measure, scene by scene, device by device, structure by
/// structure, in the order asked for. The graphics device is opened only where it depends on it
/// whether a tree is built there. A test that does not apply is left out,
/// with a warning if it was asked for by name. Throws UsageError for a wrong option or if nothing
/// is left, scene::InputError.
std::vector<WorkloadSpec> list_workloads(const ProfileOptions& options, const WorkloadTools& tools,
                                         Terminal& terminal);
/// The same with scenes from `open`, so that several calls may share them.
std::vector<WorkloadSpec> list_workloads(const ProfileOptions& options, const WorkloadTools& tools,
                                         Terminal& terminal, const SceneOpener& open);

}  // namespace encore::app
