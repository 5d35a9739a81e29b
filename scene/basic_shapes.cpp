#include "scene/basic_shapes.h"

#include "scene/portable_math.h"

#include <algorithm>

namespace encore::scene {

Model sphere_model(int slices, int stacks) {
  slices = std::max(slices, 3);
  stacks = std::max(stacks, 2);
  Model model;
  model.name = "sphere";
  model.materials.emplace_back();
  auto& positions = model.mesh.positions;

  // North pole, the rings from north to south, south pole.
  positions.emplace_back(0.0F, 1.0F, 0.0F);
  for (int ring = 1; ring < stacks; ++ring) {
    const double polar = 180.0 * ring / stacks;
    const double radius = portable_sin_degrees(polar);
    for (int i = 0; i < slices; ++i) {
      const double azimuth = 360.0 * i / slices;
      positions.emplace_back(radius * portable_sin_degrees(azimuth), portable_cos_degrees(polar),
                             radius * portable_cos_degrees(azimuth));
    }
  }
  positions.emplace_back(0.0F, -1.0F, 0.0F);
  model.mesh.normals = positions;

  // A fan at each pole and two triangles a cell between the rings, all counter-clockwise from
  // outside.
  const auto at = [slices](int ring, int i) {
    return static_cast<std::uint32_t>(1 + (ring - 1) * slices + i % slices);
  };
  const auto south = static_cast<std::uint32_t>(positions.size() - 1);
  auto& triangles = model.mesh.triangles;
  for (int i = 0; i < slices; ++i) triangles.emplace_back(0U, at(1, i), at(1, i + 1));
  for (int ring = 1; ring + 1 < stacks; ++ring) {
    for (int i = 0; i < slices; ++i) {
      triangles.emplace_back(at(ring, i), at(ring + 1, i), at(ring + 1, i + 1));
      triangles.emplace_back(at(ring, i), at(ring + 1, i + 1), at(ring, i + 1));
    }
  }
  for (int i = 0; i < slices; ++i)
    triangles.emplace_back(at(stacks - 1, i), south, at(stacks - 1, i + 1));
  return model;
}

Model box_model() {
  Model model;
  model.name = "box";
  model.materials.emplace_back();
  // Bit 0, 1, 2 of the vertex number say which side of x, y, z it lies on.
  for (int i = 0; i < 8; ++i) {
    model.mesh.positions.emplace_back((i & 1) != 0 ? 0.5F : -0.5F, (i & 2) != 0 ? 0.5F : -0.5F,
                                      (i & 4) != 0 ? 0.5F : -0.5F);
  }
  model.mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                          {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return model;
}

Model square_model() {
  Model model;
  model.name = "square";
  model.materials.emplace_back();
  model.mesh.positions = {
      {-0.5F, -0.5F, 0.0F}, {0.5F, -0.5F, 0.0F}, {0.5F, 0.5F, 0.0F}, {-0.5F, 0.5F, 0.0F}};
  model.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return model;
}

const std::vector<std::string_view>& basic_shape_names() {
  static const std::vector<std::string_view> names = {"sphere", "box", "square"};
  return names;
}

std::shared_ptr<const Model> make_basic_shape(std::string_view name) {
  if (name == "sphere") return std::make_shared<const Model>(sphere_model());
  if (name == "box") return std::make_shared<const Model>(box_model());
  if (name == "square") return std::make_shared<const Model>(square_model());
  return nullptr;
}

}  // namespace encore::scene
