#include "renderer/image_diff.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

using encore::renderer::compare_images;
using encore::renderer::Image;

Image grey(int width, int height, float value) {
  Image image;
  image.resize(width, height);
  for (glm::vec3& pixel : image.pixels) pixel = glm::vec3(value);
  return image;
}

TEST(ImageDiff, AnImageDoesNotDifferFromItself) {
  const Image image = grey(5, 4, 0.3F);
  const auto d = compare_images(image, image);
  EXPECT_EQ(d.rmse, 0.0);
  EXPECT_EQ(d.largest, 0.0);
  EXPECT_EQ(d.differing, 0U);
}

TEST(ImageDiff, FiguresAreThoseOfTheDefinition) {
  const Image a = grey(4, 3, 0.25F);
  Image b = a;
  b.pixels[6].g = 1.0F;     // x 2, y 1: 0.75 away
  b.pixels[11].r = 0.125F;  // 0.125 away
  const auto d = compare_images(a, b);
  EXPECT_DOUBLE_EQ(d.rmse, std::sqrt((0.75 * 0.75 + 0.125 * 0.125) / 36.0));
  EXPECT_EQ(d.largest, 0.75);
  EXPECT_EQ(d.largest_x, 2);
  EXPECT_EQ(d.largest_y, 1);
  EXPECT_EQ(d.differing, 2U);
  EXPECT_EQ(compare_images(a, b, 0.125).differing, 1U);
  EXPECT_EQ(compare_images(b, a).rmse, d.rmse);
}

TEST(ImageDiff, NonFiniteValuesAreNotHidden) {
  const Image a = grey(2, 2, 0.5F);
  Image b = a;
  b.pixels[3].b = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isinf(compare_images(a, b).largest));
  EXPECT_EQ(compare_images(a, b).differing, 1U);
  EXPECT_EQ(compare_images(b, b).differing, 0U);
}

TEST(ImageDiff, OnlyImagesOfOneSizeCompare) {
  EXPECT_THROW(compare_images(grey(4, 3, 0), grey(3, 4, 0)), std::invalid_argument);
  EXPECT_EQ(compare_images(Image{}, Image{}).rmse, 0.0);
}

}  // namespace
