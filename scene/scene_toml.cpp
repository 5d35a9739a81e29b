#include "scene/assets.h"
#include "scene/load_watch.h"
#include "scene/scene_file.h"
#include "scene/scene_toml_camera.h"
#include "scene/scene_toml_material.h"
#include "scene/scene_toml_model.h"
#include "scene/toml_reading.h"

#include <fmt/format.h>

#include <utility>

namespace encore::scene {
namespace {

/// One value of [settings] as text; whoever uses it checks what it means.
std::string preference_value(const toml::node& node, const TomlTable& table) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* boolean = node.as_boolean()) return boolean->get() ? "true" : "false";
  throw InputError(fmt::format("{}: a setting must be a string, a number or a boolean, not {}",
                               table.place_of(node), kind_of(node)));
}

/// [settings] and its subtables as dotted keys, in alphabetical order.
void read_preferences(const toml::table& table, const std::string& prefix, const TomlTable& root,
                      std::vector<Preference>& preferences) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (const auto* inner = node.as_table()) {
      if (!prefix.empty()) {
        throw InputError(fmt::format("{}: settings are nested once at most, as in grid.density",
                                     root.place_of(node)));
      }
      read_preferences(*inner, name + ".", root, preferences);
      continue;
    }
    preferences.push_back({name, preference_value(node, root), root.place_of(node)});
  }
}

NamedMaterials read_materials(TomlTable& root, Assets& assets, Warnings& warnings) {
  NamedMaterials materials;
  for (TomlTable& table : root.tables("material")) {
    Material material = read_material(table, assets, warnings);
    if (material.name.empty()) table.fail("name", "a material needs a 'name'");
    const std::string name = material.name;
    if (!materials.emplace(name, std::move(material)).second) {
      table.fail("name", fmt::format("there are two materials '{}'", name));
    }
  }
  return materials;
}

Light read_light(TomlTable& table, Warnings& warnings) {
  Light light;
  const auto position = table.vector("position");
  if (!position) table.fail("position", "a light needs a 'position'");
  light.position = *position;
  light.color = table.number_or_vector("color", kNotNegative).value_or(light.color);
  table.warn_about_unknown_keys(warnings);
  return light;
}

}  // namespace

Scene parse_scene_toml(std::string_view text, const std::string& file_name,
                       const std::filesystem::path& folder,
                       const std::vector<std::filesystem::path>& search_path) {
  const toml::table document = parse_toml(text, file_name);
  TomlTable root(document, "", file_name);
  Assets assets(folder, search_path);
  Scene scene;
  scene.source = file_name;
  scene.name = root.text("name").value_or(std::filesystem::path(file_name).stem().string());
  scene.background = root.number_or_vector("background", kNotNegative).value_or(scene.background);
  if (auto camera = root.table("camera")) scene.camera = read_camera(*camera, scene.warnings);
  for (TomlTable& light : root.tables("light")) {
    scene.lights.push_back(read_light(light, scene.warnings));
  }
  add_default_light(scene);
  // For `encore battery`, which checks it.
  (void)root.has("battery");
  if (auto settings = root.table("settings")) {
    read_preferences(settings->raw(), "", *settings, scene.preferences);
  }

  // Models last: what is wrong with the rest of the file is found before anything large is read.
  const NamedMaterials materials = read_materials(root, assets, scene.warnings);
  std::vector<TomlTable> models = root.tables("model");
  const auto count = static_cast<double>(models.size());
  for (std::size_t i = 0; i < models.size(); ++i) {
    const auto at = static_cast<double>(i);
    const LoadPart part(at / count, (at + 1.0) / count);
    check_load();
    read_model_table(models[i], materials, assets, scene);
  }
  root.warn_about_unknown_keys(scene.warnings);
  return scene;
}

}  // namespace encore::scene
