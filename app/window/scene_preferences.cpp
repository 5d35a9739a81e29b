#include "app/window/scene_preferences.h"

#include "scene/ray_settings.h"
#include "scene/text_suggestion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace encore::app {

namespace {

std::string apply_intersection(const std::string& value, ui::Settings& settings) {
  const auto mode = accel::parse_intersection_mode(value);
  if (!mode) {
    std::vector<std::string_view> known;
    for (const auto one : accel::all_intersection_modes()) known.push_back(accel::to_string(one));
    return fmt::format("unknown intersection mode '{}'{}; there are {}", value,
                       scene::did_you_mean(value, known), fmt::join(known, ", "));
  }
  for (ui::PaneSettings& pane : settings.panes) pane.structure.intersection = *mode;
  return {};
}

}  // namespace

std::vector<std::string> apply_preferences(const scene::Scene& scene, ui::Settings& settings) {
  std::vector<std::string> problems;
  const auto keys = scene::ray_setting_keys();
  for (const scene::Preference& one : scene.preferences) {
    std::string problem;
    if (std::find(keys.begin(), keys.end(), one.key) != keys.end()) {
      problem = scene::apply_ray_setting(settings.rays, one.key, one.value);
    } else if (one.key == "intersection") {
      problem = apply_intersection(one.value, settings);
    }
    if (!problem.empty()) problems.push_back(one.place + ": " + problem);
  }
  return problems;
}

}  // namespace encore::app
