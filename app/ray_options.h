#pragma once

#include "app/common_options.h"
#include "scene/needs.h"
#include "scene/ray_settings.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace encore::app {

/// Declares --rays, --samples and --depth on a subcommand that draws.
void add_ray_options(CLI::App& command, CommonOptions& options);

/// The rays that pictures of a scene are made of: the command line's, over the scene's own
/// preferences, over the defaults. Throws UsageError or scene::InputError.
scene::RaySettings chosen_rays(const CommonOptions& options, const scene::Scene& scene);

/// What of the settings a scene has a use for: rays that would change nothing are off, and so the
/// same picture always goes by the same settings.
scene::RaySettings useful_rays(const scene::Scene& scene, const scene::RaySettings& rays);

/// The intersection modes asked for, else the scene's own, else `precise`; each once. Throws
/// UsageError or scene::InputError.
std::vector<accel::IntersectionMode> chosen_intersections(const CommonOptions& options,
                                                          const scene::Scene& scene);

}  // namespace encore::app
