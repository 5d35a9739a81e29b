#include "scene/scene_file.h"

#include "scene/assets.h"
#include "scene/classic_scene_file.h"
#include "scene/mesh_reader.h"
#include "scene/placement.h"
#include "scene/sample_scenes.h"
#include "scene/shipped_files.h"
#include "scene/text_suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <system_error>
#include <utility>

namespace encore::scene {
namespace fs = std::filesystem;
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The file itself, or the first of that path or bare name in the search path; else empty.
fs::path existing(const std::string& name, const std::vector<fs::path>& search_path) {
  const fs::path wanted(name);
  std::vector<fs::path> candidates{wanted};
  for (const fs::path& entry : search_path) {
    candidates.push_back(entry / wanted);
    candidates.push_back(entry / wanted.filename());
  }
  for (const fs::path& candidate : candidates) {
    std::error_code error;
    if (fs::is_regular_file(candidate, error)) return candidate;
  }
  return {};
}

[[noreturn]] void unknown_scene(const std::string& name) {
  std::error_code error;
  if (fs::is_directory(fs::path(name), error)) {
    throw InputError(fmt::format("{}: is a folder; give a scene or model file", name));
  }
  if (fs::exists(fs::path(name), error)) {
    throw InputError(fmt::format("{}: is not a regular file", name));
  }
  std::vector<std::string_view> names;
  for (const SampleScene& sample : sample_scenes()) names.emplace_back(sample.name);
  const std::vector<std::string> shipped = shipped_names("scenes");
  names.insert(names.end(), shipped.begin(), shipped.end());
  std::string hint = did_you_mean(name, names);
  const bool bare = fs::path(name).filename() == name && !fs::path(name).has_extension();
  if (hint.empty() && bare && shipped_folder().empty()) hint = "; " + shipped_files_missing();
  throw InputError(
      fmt::format("{}: there is no such file or sample scene{} (the sample scenes: "
                  "encore scenes)",
                  name, hint));
}

}  // namespace

Scene place_model(Model model) {
  Scene scene;
  scene.name = model.name;
  scene.source = model.name;
  scene.warnings.add(model.warnings);
  scene.materials = model.materials;
  if (scene.materials.empty()) scene.materials.emplace_back();
  Instance instance;
  instance.name = model.name;
  instance.transform = fit_matrix(bounds_under(model.mesh, glm::mat4(1.0F)), kThesisSize);
  instance.model = std::make_shared<const Model>(std::move(model));
  scene.instances.push_back(std::move(instance));
  add_default_light(scene);
  return scene;
}

Scene load_scene(const std::string& name_or_path, const std::vector<fs::path>& search_path) {
  if (auto sample = make_sample_scene(name_or_path)) return std::move(*sample);
  fs::path path = existing(name_or_path, search_path);
  if (path.empty()) path = shipped_file("scenes", name_or_path);
  if (path.empty()) unknown_scene(name_or_path);

  // Files beside the scene file are named relative to it; an empty folder would forbid them.
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const std::string extension = lower(path.extension().string());
  if (extension == ".toml") {
    return parse_scene_toml(read_scene_text(path), path.string(), folder, search_path);
  }
  if (extension == ".txt") {
    return parse_classic_scene(read_scene_text(path), path.string(), folder, search_path);
  }
  Scene scene = place_model(read_model(path));
  scene.source = path.string();
  return scene;
}

}  // namespace encore::scene
