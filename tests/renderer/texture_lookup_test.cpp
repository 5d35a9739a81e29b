#include "renderer/texture_lookup.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace encore;
using renderer::linear_of_srgb;
using renderer::texture_color;

/// Two columns, three rows; red tells the column, green the row, all in sRGB.
scene::Texture two_by_three() {
  scene::Texture texture;
  texture.width = 2;
  texture.height = 3;
  for (std::uint32_t row = 0; row < 3; ++row) {
    for (std::uint32_t column = 0; column < 2; ++column) {
      texture.texels.push_back(0xFF000000U | (row * 100U) << 8U | column * 200U);
    }
  }
  return texture;
}

glm::vec3 texel(std::uint32_t column, std::uint32_t row) {
  return {linear_of_srgb(column * 200U), linear_of_srgb(row * 100U), 0.0F};
}

void expect_near(const glm::vec3& a, const glm::vec3& b) {
  EXPECT_LT(glm::length(a - b), 1e-6F) << a.r << ' ' << a.g << ", not " << b.r << ' ' << b.g;
}

TEST(TextureLookup, SrgbBecomesLinear) {
  EXPECT_EQ(linear_of_srgb(0), 0.0F);
  EXPECT_EQ(linear_of_srgb(255), 1.0F);
  EXPECT_NEAR(linear_of_srgb(10), 10.0 / 255.0 / 12.92, 1e-9);
  EXPECT_NEAR(linear_of_srgb(128), 0.2158605, 1e-6);
  for (std::uint32_t i = 1; i < 256; ++i) EXPECT_GT(linear_of_srgb(i), linear_of_srgb(i - 1));
}

TEST(TextureLookup, CentresOfTexelsShowThemWithTheFirstRowOnTop) {
  const scene::Texture texture = two_by_three();
  for (std::uint32_t row = 0; row < 3; ++row) {
    for (std::uint32_t column = 0; column < 2; ++column) {
      const glm::vec2 at{(static_cast<float>(column) + 0.5F) / 2.0F,
                         1.0F - (static_cast<float>(row) + 0.5F) / 3.0F};
      expect_near(texture_color(texture, at), texel(column, row));
      expect_near(texture_color(texture, at + glm::vec2(3.0F, -2.0F)), texel(column, row));
    }
  }
}

TEST(TextureLookup, BetweenTexelsColoursAreMixedAlsoAcrossTheEdge) {
  const scene::Texture texture = two_by_three();
  const float middle = 1.0F - 1.5F / 3.0F;
  expect_near(texture_color(texture, {0.375F, middle}), 0.75F * texel(0, 1) + 0.25F * texel(1, 1));
  // u = 0 lies between the last column and the first, v = 0 between the last row and the first.
  expect_near(texture_color(texture, {0.0F, middle}), 0.5F * (texel(0, 1) + texel(1, 1)));
  expect_near(texture_color(texture, {0.25F, 0.0F}), 0.5F * (texel(0, 2) + texel(0, 0)));
  expect_near(texture_color(texture, {0.25F, 1.0F}), 0.5F * (texel(0, 2) + texel(0, 0)));
}

TEST(TextureLookup, AnyCoordinateIsInside) {
  const scene::Texture texture = two_by_three();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float odd : {infinity, -infinity, std::nanf(""), 3e38F, -1e-30F, -1e-45F, 1e-45F}) {
    const glm::vec3 color = texture_color(texture, {odd, odd});
    EXPECT_TRUE(color.r >= 0.0F && color.r <= 1.0F && color.g >= 0.0F && color.g <= 1.0F) << odd;
  }
}

}  // namespace
