#include "app/common_options.h"

#include "app/exit_code.h"
#include "app/ray_options.h"
#include "scene/ray_settings.h"
#include "scene/sample_scenes.h"
#include "scene/scene_file.h"
#include "scene/text_suggestion.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

namespace encore::app {

namespace {

std::vector<std::string_view> structure_names() {
  std::vector<std::string_view> names;
  for (const accel::StructureKind kind : accel::all_structure_kinds()) {
    names.push_back(accel::to_string(kind));
  }
  return names;
}

/// All that a comparison of structures is about: everything but the oracle.
std::vector<accel::StructureKind> default_kinds() {
  std::vector<accel::StructureKind> kinds = accel::all_structure_kinds();
  std::erase(kinds, accel::StructureKind::brute);
  return kinds;
}

std::string unknown_structure(std::string_view name) {
  const auto names = structure_names();
  return fmt::format("unknown structure '{}'; there are {}{}", name, fmt::join(names, ", "),
                     scene::did_you_mean(name, names));
}

std::vector<accel::StructureKind> kinds_from_names(const std::vector<std::string>& names) {
  std::vector<accel::StructureKind> kinds;
  for (const std::string& name : names) {
    if (name == "all") {
      const auto all = default_kinds();
      kinds.insert(kinds.end(), all.begin(), all.end());
      continue;
    }
    const auto kind = accel::parse_structure_kind(name);
    if (!kind) throw UsageError(unknown_structure(name));
    kinds.push_back(*kind);
  }
  return kinds;
}

/// The kinds that the scene file prefers; empty if it does not say.
std::vector<accel::StructureKind> kinds_from_scene(const scene::Scene& scene) {
  std::vector<accel::StructureKind> kinds;
  for (const scene::Preference& preference : scene.preferences) {
    if (preference.key != "structure") continue;
    if (preference.value == "all") return default_kinds();
    const auto kind = accel::parse_structure_kind(preference.value);
    if (!kind) {
      throw scene::InputError(preference.place + ": " + unknown_structure(preference.value));
    }
    kinds.push_back(*kind);
  }
  return kinds;
}

bool is_structure_setting(std::string_view key) {
  return key.starts_with("grid.") || key.starts_with("kd.") || key.starts_with("bvh.");
}

std::string setting_problem(accel::StructureSpec& spec, std::string_view key,
                            std::string_view value) {
  std::string problem = accel::apply_setting(spec, key, value);
  if (problem.starts_with("unknown")) problem += scene::did_you_mean(key, accel::setting_keys());
  return problem;
}

/// A preference that nothing will read is misspelt.
void warn_of_unknown(const scene::Preference& preference, Terminal& terminal) {
  std::vector<std::string_view> known{"structure", "policy", "device", "threads", "intersection"};
  const auto rays = scene::ray_setting_keys();
  known.insert(known.end(), rays.begin(), rays.end());
  known.insert(known.end(), accel::setting_keys().begin(), accel::setting_keys().end());
  if (std::find(known.begin(), known.end(), preference.key) != known.end()) return;
  // Unknown keys of a known structure are errors where they are applied.
  if (is_structure_setting(preference.key)) return;
  terminal.warning(fmt::format("{}: unknown setting '{}' is ignored{}", preference.place,
                               preference.key, scene::did_you_mean(preference.key, known)));
}

void apply_settings(accel::StructureSpec& spec, const CommonOptions& options,
                    const scene::Scene& scene) {
  for (const scene::Preference& preference : scene.preferences) {
    if (!is_structure_setting(preference.key)) continue;
    const std::string problem = setting_problem(spec, preference.key, preference.value);
    if (!problem.empty()) throw scene::InputError(preference.place + ": " + problem);
  }
  for (const std::string& setting : options.settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw UsageError(fmt::format("--set takes key=value, not '{}'", setting));
    }
    const std::string_view view(setting);
    const std::string problem =
        setting_problem(spec, view.substr(0, equals), view.substr(equals + 1));
    if (!problem.empty()) throw UsageError("--set: " + problem);
  }
}

/// The groupings asked for, else packets; each once.
std::vector<accel::RayGrouping> chosen_groupings(const CommonOptions& options) {
  std::vector<accel::RayGrouping> groupings;
  for (const std::string& name : options.groupings) {
    const auto grouping = accel::parse_ray_grouping(name);
    if (!grouping) {
      throw UsageError(
          fmt::format("unknown ray grouping '{}'; there are packets and single", name));
    }
    if (std::find(groupings.begin(), groupings.end(), *grouping) == groupings.end()) {
      groupings.push_back(*grouping);
    }
  }
  if (groupings.empty()) groupings.push_back(accel::RayGrouping::packets);
  return groupings;
}

/// The presets asked for, else the one that the settings say; one for structures that have none.
std::vector<accel::BuildPreset> chosen_presets(const CommonOptions& options,
                                               const accel::StructureSpec& spec) {
  std::vector<accel::BuildPreset> presets;
  for (const std::string& name : options.presets) {
    const auto preset = accel::parse_build_preset(name);
    if (!preset) {
      throw UsageError(fmt::format("unknown preset '{}'; there are fast, balanced and best", name));
    }
    if (std::find(presets.begin(), presets.end(), *preset) == presets.end()) {
      presets.push_back(*preset);
    }
  }
  const auto* bvh = std::get_if<accel::BvhSettings>(&spec.settings);
  if (presets.empty() || spec.kind != accel::StructureKind::bvh_sah) {
    return {bvh != nullptr ? bvh->preset : accel::BuildPreset::balanced};
  }
  return presets;
}

}  // namespace

void add_output_options(CLI::App& command, CommonOptions& options) {
  command.add_flag("--json", options.json, "Print the result as JSON on standard output");
  command.add_flag("--quiet,-q", options.quiet, "No progress, information or warnings");
}

void add_scene_options(CLI::App& command, CommonOptions& options, bool many) {
  auto* scenes = command.add_option(
      many ? "scenes" : "scene", options.scenes,
      fmt::format("Sample scene, scene file (.toml, .txt) or model file (.obj, .ply, .3ds …); "
                  "default: {}",
                  scene::kDefaultSceneName));
  if (!many) scenes->expected(0, 1);
  command
      .add_option("--search-path", options.search_path,
                  "Folder where scene files look for their models (repeatable)")
      ->allow_extra_args(false);
}

void add_structure_options(CLI::App& command, CommonOptions& options, bool many) {
  const auto names = structure_names();
  auto* structure =
      command.add_option("--structure,-s", options.structures,
                         fmt::format("{}; {}", fmt::join(names, ", "),
                                     many ? "several separated by commas; default: all but brute"
                                          : "default: bvh-median"));
  structure->delimiter(',')->allow_extra_args(false);
  if (!many) structure->expected(1);
  command
      .add_option("--set", options.settings,
                  fmt::format("Structure setting key=value (repeatable; docs/settings.md): {}",
                              fmt::join(accel::setting_keys(), ", ")))
      ->allow_extra_args(false);
  std::vector<std::string_view> modes;
  for (const auto mode : accel::all_intersection_modes()) modes.push_back(accel::to_string(mode));
  auto* intersection = command.add_option(
      "--intersection", options.intersections,
      fmt::format("How a ray is held against a triangle: {}{} (default: precise)",
                  fmt::join(modes, ", "), many ? "; several separated by commas" : ""));
  intersection->delimiter(',')->allow_extra_args(false);
  if (!many) intersection->expected(1);
  auto* preset = command.add_option(
      "--preset", options.presets,
      fmt::format("How much bvh-sah spends on its tree: fast, balanced, best{} (default: balanced)",
                  many ? "; several separated by commas" : ""));
  preset->delimiter(',')->allow_extra_args(false);
  auto* grouping = command.add_option(
      "--grouping", options.groupings,
      fmt::format("packets: neighbouring rays of a picture go together on the CPU (default); "
                  "single: one after the other, as in the thesis{}",
                  many ? "; several separated by commas" : ""));
  grouping->delimiter(',')->allow_extra_args(false);
  if (!many) {
    preset->expected(1);
    grouping->expected(1);
  }
  command.add_option("--memory", options.memory,
                     "pool: reuse memory from build to build (default); malloc: allocate afresh");
}

void add_thread_option(CLI::App& command, CommonOptions& options) {
  command
      .add_option("--threads,-t", options.threads,
                  "Threads for building and rendering; 0: all (default)")
      ->check(CLI::Range(0, 4096));
}

scene::Scene open_scene(const std::string& name_or_path, const CommonOptions& options,
                        Terminal& terminal) {
  const std::vector<std::filesystem::path> search(options.search_path.begin(),
                                                  options.search_path.end());
  scene::Scene scene = scene::load_scene(name_or_path, search);
  for (const std::string& message : scene.warnings.messages) terminal.warning(message);
  for (const scene::Preference& preference : scene.preferences) {
    warn_of_unknown(preference, terminal);
  }
  return scene;
}

std::vector<accel::StructureSpec> chosen_structures(const CommonOptions& options,
                                                    const scene::Scene& scene) {
  const auto memory = accel::parse_memory_mode(options.memory);
  if (!memory) {
    throw UsageError(
        fmt::format("unknown memory mode '{}'; there are pool and malloc", options.memory));
  }
  std::vector<accel::StructureKind> kinds = kinds_from_names(options.structures);
  if (kinds.empty()) kinds = kinds_from_scene(scene);
  if (kinds.empty()) kinds = default_kinds();

  const std::vector<accel::IntersectionMode> modes = chosen_intersections(options, scene);
  const std::vector<accel::RayGrouping> groupings = chosen_groupings(options);
  std::vector<accel::StructureSpec> specs;
  for (const accel::StructureKind kind : kinds) {
    accel::StructureSpec spec = accel::default_spec(kind);
    spec.memory = *memory;
    apply_settings(spec, options, scene);
    for (const accel::BuildPreset preset : chosen_presets(options, spec)) {
      if (kind == accel::StructureKind::bvh_sah) {
        std::get<accel::BvhSettings>(spec.settings).preset = preset;
      }
      for (const accel::IntersectionMode mode : modes) {
        spec.intersection = mode;
        for (const accel::RayGrouping grouping : groupings) {
          spec.grouping = grouping;
          specs.push_back(spec);
        }
      }
    }
  }
  return specs;
}

ImageSize parse_size(const std::string& text) {
  const auto number = [&](std::string_view part) {
    int value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc{} || end != part.data() + part.size() || value < 1 || value > 16384) {
      throw UsageError(
          fmt::format("--size takes a side or WIDTHxHEIGHT, each 1 to 16384, not '{}'", text));
    }
    return value;
  };
  const std::string_view view(text);
  const std::size_t cross = view.find('x');
  if (cross == std::string_view::npos) return {number(view), number(view)};
  return {number(view.substr(0, cross)), number(view.substr(cross + 1))};
}

const scene::Preference* preference(const scene::Scene& scene, std::string_view key) {
  const scene::Preference* found = nullptr;
  for (const scene::Preference& one : scene.preferences) {
    if (one.key == key) found = &one;
  }
  return found;
}

int chosen_threads(const CommonOptions& options, const scene::Scene& scene) {
  if (options.threads > 0) return options.threads;
  const scene::Preference* stated = preference(scene, "threads");
  if (stated == nullptr) return 0;
  int threads = 0;
  const char* end = stated->value.data() + stated->value.size();
  const auto result = std::from_chars(stated->value.data(), end, threads);
  if (result.ec != std::errc{} || result.ptr != end || threads < 0 || threads > 4096) {
    throw scene::InputError(
        fmt::format("{}: threads must be 0 to 4096, not '{}'", stated->place, stated->value));
  }
  return threads;
}

}  // namespace encore::app
