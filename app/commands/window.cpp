#include "app/commands/commands.h"
#include "app/gpu_device.h"
#include "app/interrupt.h"
#include "app/window/application.h"
#include "scene/diagnostics.h"
#include "scene/sample_scenes.h"
#include "scene/shipped_files.h"
#include "scene/text_suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace encore::app {

namespace {

namespace fs = std::filesystem;

/// What names a file rather than a command: it has a folder or an ending.
bool looks_like_file(const std::string& word) {
  return word.find('/') != std::string::npos || word.find('.') != std::string::npos;
}

/// A word that is neither a command nor a scene would else open a window only to say so there.
void check_scene(const CLI::App& app, const std::string& word) {
  std::error_code error;
  if (word.empty() || fs::exists(word, error)) return;
  if (looks_like_file(word)) {
    throw scene::InputError(word + ": there is no such file");
  }
  std::vector<std::string> names;
  for (const scene::SampleScene& sample : scene::sample_scenes()) names.push_back(sample.name);
  for (const std::string& name : scene::shipped_names("scenes")) names.push_back(name);
  if (std::find(names.begin(), names.end(), word) != names.end()) return;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  throw UsageError(
      fmt::format("'{}' is no command, no scene and no file{}; 'encore --help' lists "
                  "the commands, 'encore scenes' the scenes",
                  word, scene::did_you_mean(word, candidates)));
}

}  // namespace

void add_window(CLI::App& app, ExitCode& result) {
  const auto options = std::make_shared<WindowOptions>();
  app.add_option("scene", options->scene,
                 "Opens the window on this scene: a sample's name, a scene file or a model "
                 "(default: toys)");
  app.add_option("--search", options->search_path, "Also look for models in this folder")
      ->type_name("FOLDER");
  add_source_options(app, options->measuring);
  add_gl_device_option(app, options->gl_device);
  app.add_option("--threads", options->threads, "For tracing on the CPU (default 0: all)")
      ->check(CLI::Range(0, 1024));
  app.add_option("--window-size", options->size, "Of the window: WIDTHxHEIGHT");
  app.add_flag("--fresh", options->fresh,
               "Start as for the first time: kept settings are neither read nor written");
  // For tests and screen recorders.
  app.add_option("--widget-map", options->widget_map)->group("");
  app.add_option("--frame-times", options->timings)->group("");
  app.add_flag("--gl-debug", options->gl_debug)->group("");
  app.final_callback([&app, options, &result] {
    if (!app.get_subcommands().empty()) return;
    check_scene(app, options->scene);
    result = run_window(*options, interrupted);
    if (interrupted) result = ExitCode::interrupted;
  });
}

}  // namespace encore::app
