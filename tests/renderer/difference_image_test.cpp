#include "renderer/difference_image.h"

#include "renderer/image_io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

using encore::renderer::difference_image;
using encore::renderer::Image;

const glm::vec3 kBlack{0.0F};
const glm::vec3 kMagenta{1.0F, 0.0F, 1.0F};

Image grey(int width, int height, float value) {
  Image image;
  image.resize(width, height);
  for (glm::vec3& pixel : image.pixels) pixel = glm::vec3(value);
  return image;
}

float brightness(const glm::vec3& color) {
  return 0.2126F * color.r + 0.7152F * color.g + 0.0722F * color.b;
}

/// The colour that a pixel gets whose green differs by so much.
glm::vec3 color_for(float difference) {
  const Image a = grey(1, 1, 0.0F);
  Image b = a;
  b.pixels[0].g = difference;
  return difference_image(a, b).pixels[0];
}

TEST(DifferenceImage, OnlyEqualPixelsAreBlack) {
  const Image a = grey(4, 3, 0.25F);
  Image b = a;
  b.pixels[6].b = std::nextafter(0.25F, 1.0F);
  const Image d = difference_image(a, b);
  ASSERT_EQ(d.width, 4);
  ASSERT_EQ(d.height, 3);
  for (std::size_t i = 0; i < d.pixels.size(); ++i) {
    EXPECT_EQ(d.pixels[i] == kBlack, i != 6) << i;
  }
}

TEST(DifferenceImage, TheSmallestDifferenceIsVisibleInThePng) {
  // The darkest colour must not turn into what eyes take for black.
  const glm::vec3 color = color_for(std::numeric_limits<float>::denorm_min());
  EXPECT_GE(std::max({encore::renderer::to_srgb8(color.r), encore::renderer::to_srgb8(color.g),
                      encore::renderer::to_srgb8(color.b)}),
            48);
}

TEST(DifferenceImage, LargerDifferencesAreBrighterDecadeByDecade) {
  float last = brightness(color_for(1e-8F));
  for (float difference = 1e-6F; difference <= 2.0F; difference *= 10.0F) {
    const float now = brightness(color_for(difference));
    EXPECT_GT(now, 1.1F * last) << difference;
    last = now;
  }
  // Off the scale at either end is the colour of that end.
  EXPECT_EQ(color_for(1e-7F), color_for(1e-20F));
  EXPECT_EQ(color_for(1.0F), color_for(1e20F));
}

TEST(DifferenceImage, TheLargestChannelCountsWhicheverItIs) {
  const Image a = grey(1, 1, 0.5F);
  const glm::vec3 expected = color_for(0.25F);
  for (int channel = 0; channel < 3; ++channel) {
    Image b = a;
    b.pixels[0] += 0.0625F;
    b.pixels[0][channel] = 0.25F;
    EXPECT_EQ(difference_image(a, b).pixels[0], expected) << channel;
    EXPECT_EQ(difference_image(b, a).pixels[0], expected) << channel;
  }
}

TEST(DifferenceImage, NonFiniteAgainstFiniteIsWhite) {
  const Image a = grey(1, 1, 0.5F);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float odd : {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity}) {
    Image b = a;
    b.pixels[0].r = odd;
    EXPECT_EQ(difference_image(a, b).pixels[0], glm::vec3(1.0F)) << odd;
    EXPECT_EQ(difference_image(b, b).pixels[0], kBlack) << odd;
  }
  EXPECT_EQ(difference_image(grey(1, 1, kInfinity), grey(1, 1, -kInfinity)).pixels[0],
            glm::vec3(1.0F));
}

TEST(DifferenceImage, MarksStandOutFromEveryDifference) {
  const Image a = grey(2, 1, 0.5F);
  const std::vector<std::uint8_t> marked{0, 1};
  const Image d = difference_image(a, a, marked);
  EXPECT_EQ(d.pixels[0], kBlack);
  EXPECT_EQ(d.pixels[1], kMagenta);
  for (float difference = 1e-9F; difference < 1e3F; difference *= 1.5F) {
    const glm::vec3 away = color_for(difference) - kMagenta;
    EXPECT_GT(away.r * away.r + away.g * away.g + away.b * away.b, 0.25F) << difference;
  }
}

TEST(DifferenceImage, OnlyOneSizeIsTaken) {
  EXPECT_THROW(difference_image(grey(4, 3, 0), grey(3, 4, 0)), std::invalid_argument);
  const std::vector<std::uint8_t> three(3);
  EXPECT_THROW(difference_image(grey(2, 2, 0), grey(2, 2, 0), three), std::invalid_argument);
  EXPECT_TRUE(difference_image(Image{}, Image{}).pixels.empty());
}

}  // namespace
