#include "app/commands/commands.h"
#include "app/common_options.h"
#include "app/json_text.h"
#include "scene/sample_scenes.h"

#include <fmt/format.h>

#include <memory>

namespace encore::app {

namespace {

void print_table() {
  fmt::print("{:<16} {:>10}  {:<14} {:<12} {}\n", "scene", "triangles", "animation", "thesis",
             "description");
  for (const scene::SampleScene& sample : scene::sample_scenes()) {
    fmt::print("{:<16} {:>10}  {:<14} {:<12} {}{}\n", sample.name, sample.triangles,
               sample.animation, sample.thesis_name, sample.description,
               sample.name == scene::kDefaultSceneName ? " (default)" : "");
  }
}

void print_json() {
  fmt::print("[\n");
  const char* separator = "";
  for (const scene::SampleScene& sample : scene::sample_scenes()) {
    fmt::print(
        "{}  {{\"name\": {}, \"triangles\": {}, \"animation\": {}, \"thesis_name\": {}, "
        "\"description\": {}, \"default\": {}}}",
        separator, json_text(sample.name), sample.triangles, json_text(sample.animation),
        json_text(sample.thesis_name), json_text(sample.description),
        sample.name == scene::kDefaultSceneName);
    separator = ",\n";
  }
  fmt::print("\n]\n");
}

}  // namespace

void add_scenes_command(CLI::App& app, ExitCode& result) {
  auto* command = app.add_subcommand("scenes", "List the sample scenes");
  const auto options = std::make_shared<CommonOptions>();
  add_output_options(*command, *options);
  command->callback([options, &result] {
    if (options->json) {
      print_json();
    } else {
      print_table();
    }
    result = ExitCode::ok;
  });
}

}  // namespace encore::app
