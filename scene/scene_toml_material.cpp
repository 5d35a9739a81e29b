#include "scene/scene_toml_material.h"

#include "scene/checker_texture.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace encore::scene {
namespace {

constexpr std::string_view kChecker = "checker";
constexpr NumberRange kCells{1.0, kMostCheckerCells};

std::shared_ptr<const Texture> read_checker(TomlTable& table) {
  std::array<glm::vec3, 2> colors{glm::vec3(1.0F), glm::vec3(0.25F)};
  if (const auto stated = table.numbers_or_vectors("texture_colors", kShare)) {
    if (stated->size() != 2) {
      table.fail("texture_colors",
                 fmt::format("'texture_colors' must hold two colours, not {}", stated->size()));
    }
    colors = {(*stated)[0], (*stated)[1]};
  }
  const float cells = table.number("texture_cells", kCells).value_or(8.0F);
  if (cells != std::floor(cells)) {
    table.fail("texture_cells",
               fmt::format("'texture_cells' must be a whole number, not {}", cells));
  }
  return std::make_shared<const Texture>(checker_texture(colors, static_cast<int>(cells)));
}

std::shared_ptr<const Texture> read_texture_keys(TomlTable& table, Assets& assets) {
  const auto texture = table.text("texture");
  if (texture == kChecker) return read_checker(table);
  for (const std::string_view key : {"texture_colors", "texture_cells"}) {
    if (table.has(key)) {
      table.fail(key,
                 fmt::format("'{}' describes a checker; it needs texture = \"{}\"", key, kChecker));
    }
  }
  if (!texture) return nullptr;
  return assets.texture(*texture, table.place("texture"));
}

}  // namespace

Material read_material(TomlTable& table, Assets& assets, Warnings& warnings) {
  Material m;
  m.name = table.text("name").value_or(m.name);
  m.diffuse = table.number_or_vector("diffuse", kShare).value_or(m.diffuse);
  m.specular = table.number_or_vector("specular", kShare).value_or(m.specular);
  m.ambient = table.number_or_vector("ambient", kShare).value_or(m.ambient);
  m.emission = table.number_or_vector("emission", kNotNegative).value_or(m.emission);
  m.shininess = table.number("shininess", kNotNegative).value_or(m.shininess);
  m.opacity = table.number("opacity", kShare).value_or(m.opacity);
  m.index_of_refraction =
      table.number("index_of_refraction", kPositive).value_or(m.index_of_refraction);
  m.reflectivity = table.number("reflectivity", kShare).value_or(m.reflectivity);
  m.diffuse_texture = read_texture_keys(table, assets);
  table.warn_about_unknown_keys(warnings);
  return m;
}

}  // namespace encore::scene
