#include "scene/basic_shapes.h"

#include "scene/portable_math.h"

#include <algorithm>
#include <iterator>

namespace encore::scene {

namespace {

constexpr glm::vec2 kCornersOfTexture[4] = {{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}};

}  // namespace

Model sphere_model(int slices, int stacks) {
  slices = std::max(slices, 3);
  stacks = std::max(stacks, 2);
  Model model;
  model.name = "sphere";
  model.materials.emplace_back();
  auto& positions = model.mesh.positions;
  auto& texcoords = model.mesh.texcoords;

  // A north pole for each slice, the rings from north to south, each with its first vertex once
  // more at its end, a south pole for each slice: all for the sake of texture coordinates. Those
  // beyond 1 are the same places of a picture that repeats.
  const auto longitude = [slices](double i) { return static_cast<float>(0.5 + i / slices); };
  for (int i = 0; i < slices; ++i) {
    positions.emplace_back(0.0F, 1.0F, 0.0F);
    texcoords.emplace_back(longitude(i + 0.5), 1.0F);
  }
  for (int ring = 1; ring < stacks; ++ring) {
    const double polar = 180.0 * ring / stacks;
    const double radius = portable_sin_degrees(polar);
    for (int i = 0; i <= slices; ++i) {
      const double azimuth = i < slices ? 360.0 * i / slices : 0.0;
      positions.emplace_back(radius * portable_sin_degrees(azimuth), portable_cos_degrees(polar),
                             radius * portable_cos_degrees(azimuth));
      texcoords.emplace_back(longitude(i), 1.0 - polar / 180.0);
    }
  }
  for (int i = 0; i < slices; ++i) {
    positions.emplace_back(0.0F, -1.0F, 0.0F);
    texcoords.emplace_back(longitude(i + 0.5), 0.0F);
  }
  model.mesh.normals = positions;

  // A fan at each pole and two triangles a cell between the rings, all counter-clockwise from
  // outside.
  const auto at = [slices](int ring, int i) {
    return static_cast<std::uint32_t>(slices + (ring - 1) * (slices + 1) + i);
  };
  const std::uint32_t south = at(stacks, 0);
  auto& triangles = model.mesh.triangles;
  for (int i = 0; i < slices; ++i) {
    triangles.emplace_back(static_cast<std::uint32_t>(i), at(1, i), at(1, i + 1));
  }
  for (int ring = 1; ring + 1 < stacks; ++ring) {
    for (int i = 0; i < slices; ++i) {
      triangles.emplace_back(at(ring, i), at(ring + 1, i), at(ring + 1, i + 1));
      triangles.emplace_back(at(ring, i), at(ring + 1, i + 1), at(ring, i + 1));
    }
  }
  for (int i = 0; i < slices; ++i) {
    triangles.emplace_back(at(stacks - 1, i), south + static_cast<std::uint32_t>(i),
                           at(stacks - 1, i + 1));
  }
  return model;
}

Model box_model() {
  Model model;
  model.name = "box";
  model.materials.emplace_back();
  // Bit 0, 1, 2 of a corner's number say which side of x, y, z it lies on. A face names its corners
  // from the lower left one of its texture, counter-clockwise from outside, and the two triangles
  // in the order (and from the corner) in which they have always been.
  struct Face {
    int corners[4];
    glm::uvec3 first, second;
  };
  constexpr Face kFaces[6] = {
      {{1, 0, 2, 3}, {1, 2, 3}, {1, 3, 0}}, {{4, 5, 7, 6}, {0, 1, 2}, {0, 2, 3}},
      {{0, 1, 5, 4}, {0, 1, 2}, {0, 2, 3}}, {{6, 7, 3, 2}, {3, 0, 1}, {3, 1, 2}},
      {{0, 4, 6, 2}, {0, 1, 2}, {0, 2, 3}}, {{5, 1, 3, 7}, {1, 2, 3}, {1, 3, 0}}};
  for (const Face& face : kFaces) {
    const auto base = static_cast<std::uint32_t>(model.mesh.positions.size());
    for (const int i : face.corners) {
      model.mesh.positions.emplace_back((i & 1) != 0 ? 0.5F : -0.5F, (i & 2) != 0 ? 0.5F : -0.5F,
                                        (i & 4) != 0 ? 0.5F : -0.5F);
    }
    for (const glm::vec2& t : kCornersOfTexture) model.mesh.texcoords.push_back(t);
    model.mesh.triangles.push_back(face.first + base);
    model.mesh.triangles.push_back(face.second + base);
  }
  return model;
}

Model square_model() {
  Model model;
  model.name = "square";
  model.materials.emplace_back();
  model.mesh.positions = {
      {-0.5F, -0.5F, 0.0F}, {0.5F, -0.5F, 0.0F}, {0.5F, 0.5F, 0.0F}, {-0.5F, 0.5F, 0.0F}};
  model.mesh.texcoords.assign(std::begin(kCornersOfTexture), std::end(kCornersOfTexture));
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
