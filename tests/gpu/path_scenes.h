#pragma once

#include "tests/gpu/gpu_scenes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace encore::renderer::test {

inline std::shared_ptr<const scene::Texture> colorful_texture(int width, int height) {
  auto texture = std::make_shared<scene::Texture>();
  texture->name = "colorful";
  texture->width = width;
  texture->height = height;
  std::uint32_t value = 12345;
  for (int i = 0; i < width * height; ++i) {
    value = value * 1664525U + 1013904223U;
    texture->texels.push_back(0xFF000000U | (value >> 8U));
  }
  return texture;
}

/// A sample scene of which every third material is a mirror, every third glass.
inline std::unique_ptr<GpuTestScene> shiny_scene(std::string_view name, accel::StructureKind kind) {
  auto setup = sample_scene(name, spec_of(kind));
  if (setup->scene.materials.size() < 3) setup->scene.materials.resize(3);
  for (std::size_t i = 0; i < setup->scene.materials.size(); ++i) {
    scene::Material& material = setup->scene.materials[i];
    if (i % 3 == 0) {
      material.reflectivity = 0.6F;
      material.specular = {0.9F, 0.6F, 0.3F};
    }
    if (i % 3 == 1) {
      material.opacity = 0.2F;
      material.index_of_refraction = 1.5F;
    }
  }
  for (std::size_t i = 0; i < setup->list.triangles.size(); ++i) {
    setup->list.triangles[i].material = static_cast<std::uint32_t>(i / 7 % 4);
  }
  return setup;
}

/// Two textures, worn by all but the first material, and coordinates below, in and above [0, 1].
inline void add_textures(GpuTestScene& setup) {
  const auto first = colorful_texture(7, 5);
  const auto second = colorful_texture(1, 3);
  for (std::size_t i = 1; i < setup.scene.materials.size(); ++i) {
    setup.scene.materials[i].diffuse_texture = i % 2 == 0 ? first : second;
  }
  setup.list.texcoords.clear();
  for (std::size_t i = 0; i < setup.list.triangles.size(); ++i) {
    const float a = 0.37F * static_cast<float>(i % 17) - 3.0F;
    setup.list.texcoords.push_back(
        {glm::vec2(a, 1.0F - a), glm::vec2(a + 1.3F, a), glm::vec2(0.2F, a + 2.0F)});
  }
}

/// How far the device's picture may be from the CPU's. Rays are the same to the bit, so what
/// differs is the rounding of colours; where a pixel's colour hangs on a decision that is made in
/// single precision it may be another one.
struct Comparison {
  std::size_t pixels = 0;
  std::size_t far = 0;           ///< pixels that differ by more than 1e-4 in a channel
  double rmse = 0.0;             ///< of all others
  std::size_t unlike_first = 0;  ///< pixels of another colour than the first
};

inline Comparison compare(const Image& found, const Image& expected) {
  Comparison result{.pixels = found.pixels.size()};
  double squares = 0.0;
  for (std::size_t i = 0; i < found.pixels.size(); ++i) {
    const glm::vec3 difference = glm::abs(found.pixels[i] - expected.pixels[i]);
    const float most = std::max({difference.r, difference.g, difference.b});
    // Colours above 1 count by their share.
    const float scale = std::max(
        1.0F, std::max({expected.pixels[i].r, expected.pixels[i].g, expected.pixels[i].b}));
    if (!(most <= 1e-4F * scale)) {
      ++result.far;
    } else {
      squares += static_cast<double>(glm::dot(difference, difference));
    }
    result.unlike_first += found.pixels[i] != found.pixels[0] ? 1U : 0U;
  }
  result.rmse = std::sqrt(squares / (3.0 * static_cast<double>(result.pixels)));
  return result;
}

/// The picture's largest channel difference is 1e-4 apart from at most 0.1 % of its pixels, and the
/// root mean square of the others' is below 1e-5.
inline void expect_within_bound(const Image& found, const Image& expected,
                                const std::string& what) {
  const Comparison result = compare(found, expected);
  EXPECT_GT(result.unlike_first, 0U) << what;
  EXPECT_LE(result.far, result.pixels / 1000) << what << ", of " << result.pixels;
  EXPECT_LT(result.rmse, 1e-5) << what;
}

/// As many rays of each kind, to 0.1 %.
inline void expect_same_rays(const std::optional<RayFigures>& found,
                             const std::optional<RayFigures>& expected, const std::string& what) {
  ASSERT_TRUE(found.has_value()) << what;
  ASSERT_TRUE(expected.has_value()) << what;
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    const auto kind = static_cast<scene::RayKind>(i);
    const auto rays = static_cast<double>((*expected)[kind].rays);
    EXPECT_NEAR(static_cast<double>((*found)[kind].rays), rays, std::floor(rays / 1000.0))
        << what << ", " << scene::to_string(kind);
  }
}

}  // namespace encore::renderer::test
