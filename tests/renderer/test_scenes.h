#pragma once

#include "accel/brute_force.h"
#include "renderer/cpu_tracer.h"
#include "scene/scene.h"
#include "scene/triangles.h"

#include <cmath>
#include <memory>

namespace encore::renderer::test {

/// A scene whose triangles are given directly, with brute force over them.
struct TestScene {
  scene::Scene scene;
  scene::TriangleList list;
  accel::BruteForce structure;

  [[nodiscard]] RenderInput input() {
    structure.build(list.triangles);
    return {&scene, &list, &structure};
  }
};

/// A square with corners (-half, -half, z) … (half, half, z), two triangles, facing +z.
inline void add_square(scene::TriangleList& list, float half, float z, std::uint32_t material = 0) {
  const glm::vec3 a{-half, -half, z}, b{half, -half, z}, c{half, half, z}, d{-half, half, z};
  list.triangles.push_back(scene::make_triangle(a, b, c, material));
  list.triangles.push_back(scene::make_triangle(a, c, d, material));
}

/// A unit sphere around the origin of 2 * rings * rings triangles, with its exact normals.
inline void add_sphere(scene::TriangleList& list, int rings, std::uint32_t material = 0) {
  const auto point = [&](int i, int j) {
    const double polar = M_PI * i / rings;
    const double around = 2.0 * M_PI * j / rings;
    return glm::vec3(std::sin(polar) * std::cos(around), std::cos(polar),
                     std::sin(polar) * std::sin(around));
  };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < rings; ++j) {
      const glm::vec3 a = point(i, j), b = point(i + 1, j), c = point(i + 1, j + 1),
                      d = point(i, j + 1);
      list.triangles.push_back(scene::make_triangle(a, b, c, material));
      list.normals.push_back({a, b, c});
      list.triangles.push_back(scene::make_triangle(a, c, d, material));
      list.normals.push_back({a, c, d});
    }
  }
}

/// A lit sphere with highlights and smooth normals in front of a square, seen from z = 3.
inline std::unique_ptr<TestScene> sphere_before_square() {
  auto setup = std::make_unique<TestScene>();
  setup->scene.camera = {.eye = {0.0F, 0.0F, 3.0F}, .vertical_fov_degrees = 60.0F};
  setup->scene.background = {0.25F, 0.5F, 0.75F};
  setup->scene.materials.resize(2);
  setup->scene.materials[0].specular = glm::vec3(0.5F);
  setup->scene.materials[1].diffuse = {0.2F, 0.6F, 0.1F};
  setup->scene.lights = {{.position = {2.0F, 3.0F, 4.0F}, .color = {1.0F, 0.9F, 0.8F}},
                         {.position = {-5.0F, 1.0F, 2.0F}, .color = {0.1F, 0.2F, 0.3F}}};
  add_sphere(setup->list, 12, 0);
  add_square(setup->list, 1.2F, -1.5F, 1);
  setup->list.normals.resize(setup->list.triangles.size());  // the square keeps its flat normal
  return setup;
}

}  // namespace encore::renderer::test
