#pragma once

#include "accel/settings.h"
#include "app/terminal.h"
#include "scene/scene.h"

#include <CLI/CLI.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace encore::app {

/// Options that several commands share; each add_* function declares one group on a subcommand.
struct CommonOptions {
  bool json = false;
  bool quiet = false;
  std::vector<std::string> scenes;       ///< names or paths; empty: the default scene
  std::vector<std::string> search_path;  ///< where scene files look for models
  std::vector<std::string> structures;   ///< names; empty or "all": all but brute
  std::vector<std::string> settings;     ///< "key=value", e.g. "grid.cells_per_axis=64"
  std::string memory = "pool";
  std::vector<std::string> presets;        ///< of bvh-sah; empty: what the settings say
  std::vector<std::string> groupings;      ///< of rays; empty: packets
  int threads = 0;                         ///< 0: all
  std::vector<std::string> intersections;  ///< names of modes; empty: the scene's own
  // As scene::apply_ray_setting() takes them; empty: the scene's own (app/ray_options.h).
  std::string rays;
  std::string samples;
  std::string depth;
};

void add_output_options(CLI::App& command, CommonOptions& options);
/// `many`: the command takes several scenes, else at most one.
void add_scene_options(CLI::App& command, CommonOptions& options, bool many);
void add_structure_options(CLI::App& command, CommonOptions& options, bool many);
void add_thread_option(CLI::App& command, CommonOptions& options);

/// Loads the scene (scene::load_scene) and prints its warnings. Throws scene::InputError.
scene::Scene open_scene(const std::string& name_or_path, const CommonOptions& options,
                        Terminal& terminal);

/// The structures asked for: --structure, else the scene's own preference, else all but brute;
/// with settings from the scene's preferences, then from --set, then --memory; each once for every
/// intersection mode and ray grouping, and bvh-sah for every preset. Throws UsageError (with the
/// nearest name) or scene::InputError (for a wrong preference of the scene file).
std::vector<accel::StructureSpec> chosen_structures(const CommonOptions& options,
                                                    const scene::Scene& scene);

/// The last value that the scene file states for a setting; null if it does not.
const scene::Preference* preference(const scene::Scene& scene, std::string_view key);

/// The threads to render with: --threads, else the scene's preference, else 0 (all). Throws
/// scene::InputError for a wrong preference.
int chosen_threads(const CommonOptions& options, const scene::Scene& scene);

/// Parses "256" (square) or "640x480"; throws UsageError unless both are in 1 … 16384.
struct ImageSize {
  int width = 256;
  int height = 256;
};
ImageSize parse_size(const std::string& text);

}  // namespace encore::app
