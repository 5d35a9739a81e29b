#pragma once

#include "scene/scene.h"
#include "ui/settings.h"

#include <string>
#include <vector>

namespace encore::app {

/// Takes over what a scene file prefers of the window's settings: rays, samples, depth and seed,
/// and for both panes the intersection mode. Other preferences are the command line's. Returns
/// what is wrong, one line each, with its place; such a preference changes nothing.
std::vector<std::string> apply_preferences(const scene::Scene& scene, ui::Settings& settings);

}  // namespace encore::app
