#pragma once

#include "renderer/cpu_tracer.h"
#include "renderer/image.h"
#include "tests/renderer/test_scenes.h"

#include <cstddef>
#include <cstring>
#include <memory>

namespace encore::renderer::test {

/// The scene's picture with these rays.
inline Image picture_with(TestScene& setup, const scene::RaySettings& rays, int width, int height,
                          int threads = 1) {
  CpuTracer tracer(threads);
  tracer.set_rays(rays);
  tracer.init(setup.input());
  Image image;
  image.resize(width, height);
  tracer.render(setup.scene.camera, image);
  return image;
}

inline const glm::vec3& pixel(const Image& image, int x, int y) {
  return image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                      static_cast<std::size_t>(x)];
}

inline bool same_bits(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

/// Only glows, whatever light there is.
inline scene::Material glowing(const glm::vec3& color) {
  scene::Material material;
  material.diffuse = material.ambient = glm::vec3(0.0F);
  material.emission = color;
  return material;
}

/// Shows nothing of itself.
inline scene::Material mirror() {
  scene::Material material = glowing(glm::vec3(0.0F));
  material.reflectivity = 1.0F;
  return material;
}

inline scene::Material glass(float index) {
  scene::Material material = glowing(glm::vec3(0.0F));
  material.opacity = 0.0F;
  material.index_of_refraction = index;
  return material;
}

/// Four corners in order round the square, which faces the side they run counterclockwise on.
inline void add_quad(scene::TriangleList& list, const glm::vec3& a, const glm::vec3& b,
                     const glm::vec3& c, const glm::vec3& d, std::uint32_t material) {
  list.triangles.push_back(scene::make_triangle(a, b, c, material));
  list.triangles.push_back(scene::make_triangle(a, c, d, material));
}

/// A box whose faces look outwards.
inline void add_box(scene::TriangleList& list, const glm::vec3& low, const glm::vec3& high,
                    std::uint32_t material) {
  const auto at = [&](int x, int y, int z) {
    return glm::vec3(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z);
  };
  add_quad(list, at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1), material);
  add_quad(list, at(1, 0, 0), at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), material);
  add_quad(list, at(1, 0, 1), at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), material);
  add_quad(list, at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0), material);
  add_quad(list, at(0, 1, 1), at(1, 1, 1), at(1, 1, 0), at(0, 1, 0), material);
  add_quad(list, at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1), material);
}

/// Everything at once: a floor, a mirror with smooth normals, glass and two lights.
inline std::unique_ptr<TestScene> everything() {
  auto setup = std::make_unique<TestScene>();
  setup->scene.camera = {.eye = {0.5F, 1.0F, 4.0F}, .vertical_fov_degrees = 60.0F};
  setup->scene.background = {0.25F, 0.5F, 0.75F};
  setup->scene.lights = {{.position = {2.0F, 3.0F, 4.0F}, .color = {1.0F, 0.9F, 0.8F}},
                         {.position = {-3.0F, 4.0F, 1.0F}, .color = {0.3F, 0.2F, 0.3F}}};
  auto& materials = setup->scene.materials;
  materials.resize(3);
  materials[0].specular = glm::vec3(0.5F);
  materials[0].reflectivity = 0.5F;
  materials[1].diffuse = {0.2F, 0.6F, 0.1F};
  materials[2].opacity = 0.1F;
  materials[2].index_of_refraction = 1.5F;
  add_sphere(setup->list, 10, 0);
  add_quad(setup->list, {-4, -1.2F, 4}, {4, -1.2F, 4}, {4, -1.2F, -4}, {-4, -1.2F, -4}, 1);
  add_box(setup->list, {0.8F, -1.0F, 1.0F}, {1.5F, 0.5F, 1.6F}, 2);
  setup->list.normals.resize(setup->list.triangles.size());
  return setup;
}

inline constexpr scene::RaySettings kEverything{
    .shadows = true, .reflections = true, .refractions = true, .depth = 5};

}  // namespace encore::renderer::test
