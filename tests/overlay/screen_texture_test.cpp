// Pictures on their way to the window keep every code.

#include "renderer/overlay/screen_texture.h"

#include "renderer/gl/error.h"
#include "renderer/image_io.h"
#include "tests/support/gl_context.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace {

using namespace encore;
using renderer::Image;
using renderer::picture_to_rgba8;
using renderer::ScreenTexture;
using renderer::to_srgb8;
using ScreenTextureTest = test::GlTest;

/// The codes of single values, three to a pixel.
void expect_exact(const std::vector<float>& values) {
  Image image;
  image.resize(static_cast<int>((values.size() + 2) / 3), 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    image.pixels[i / 3][static_cast<int>(i % 3)] = values[i];
  }
  std::vector<std::uint8_t> rgba(4 * image.pixels.size());
  picture_to_rgba8(image, rgba);
  for (std::size_t i = 0; i < values.size(); ++i) {
    ASSERT_EQ(rgba[4 * (i / 3) + i % 3], to_srgb8(values[i])) << values[i];
    ASSERT_EQ(rgba[4 * (i / 3) + 3], 255);
  }
}

TEST(PictureToRgba8, IsExactlyWhatPngFilesHold) {
  // Around every place where the code changes, float by float.
  std::vector<float> values;
  std::uint32_t place = std::bit_cast<std::uint32_t>(1e-5F);
  for (int code = 1; code < 256; ++code) {
    std::uint32_t last = std::bit_cast<std::uint32_t>(1.0F);
    while (last - place > 1) {
      const std::uint32_t middle = place + (last - place) / 2;
      (to_srgb8(std::bit_cast<float>(middle)) >= code ? last : place) = middle;
    }
    for (int step = -3; step <= 3; ++step) {
      values.push_back(std::bit_cast<float>(last + static_cast<std::uint32_t>(step)));
    }
  }
  ASSERT_EQ(values.size(), 255U * 7U);
  expect_exact(values);
}

TEST(PictureToRgba8, IsExactForAnyFloat) {
  std::mt19937 random(7);
  std::vector<float> values;
  for (int i = 0; i < 300000; ++i)
    values.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(random())));
  for (int i = 0; i < 300000; ++i) values.push_back(static_cast<float>(random()) * 0x1p-32F);
  const float inf = std::numeric_limits<float>::infinity();
  for (const float v : {0.0F, -0.0F, -1.0F, inf, -inf, std::nanf(""), 1e-45F, 1.0F, 1.5F}) {
    values.push_back(v);
  }
  expect_exact(values);
}

TEST(PictureToRgba8, CodesThereAndBackAreThemselves) {
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(to_srgb8(renderer::srgb8_to_linear(static_cast<std::uint8_t>(code))), code);
  }
}

TEST(PictureToRgba8, SizesMustAgree) {
  Image image;
  image.resize(2, 2);
  std::vector<std::uint8_t> rgba(12);
  EXPECT_THROW(picture_to_rgba8(image, rgba), std::invalid_argument);
  image.resize(0, 0);
  EXPECT_NO_THROW(picture_to_rgba8(image, {}));
}

TEST_F(ScreenTextureTest, HoldsWhatWasUploadedAndIsReused) {
  ScreenTexture screen(context_);
  EXPECT_EQ(screen.texture(), 0U);
  std::uint32_t first = 0;
  for (const int round : {1, 2}) {
    std::vector<std::uint8_t> rgba;
    for (int i = 0; i < 4 * 5 * 3; ++i) rgba.push_back(static_cast<std::uint8_t>(i * round));
    screen.upload(rgba, 5, 3);
    if (round == 1) first = screen.texture();
    EXPECT_EQ(screen.texture(), first);
    std::vector<std::uint8_t> found(rgba.size());
    glBindTexture(GL_TEXTURE_2D, screen.texture());
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, found.data());
    glBindTexture(GL_TEXTURE_2D, 0);
    EXPECT_EQ(found, rgba);
  }
  screen.upload(std::vector<std::uint8_t>(4), 1, 1);
  EXPECT_EQ(screen.width(), 1);
  EXPECT_THROW(screen.upload({}, 0, 0), std::invalid_argument);
  EXPECT_THROW(screen.upload(std::vector<std::uint8_t>(5), 1, 1), std::invalid_argument);
  EXPECT_THROW(screen.upload({}, context_->capabilities().texture_size + 1, 1),
               renderer::gl::GlError);
}

}  // namespace
