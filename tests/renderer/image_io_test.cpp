#include "renderer/image_io.h"

#include "tests/renderer/png.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>

namespace {

namespace fs = std::filesystem;
using encore::renderer::Image;
using encore::renderer::to_srgb8;
using encore::renderer::write_png;
using encore::renderer::test::read_png;

class ImageIo : public testing::Test {
 protected:
  const encore::test::TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
};

Image gradient(int width, int height) {
  Image image;
  image.resize(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(image.pixels.size());
    image.pixels[i] = {t, 1.0F - t, t * t};
  }
  return image;
}

std::string message_of(const Image& image, const fs::path& path) {
  try {
    write_png(image, path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(ToSrgb8, FollowsTheStandardCurve) {
  for (int i = 0; i <= 10000; ++i) {
    const double linear = i / 10000.0;
    const double encoded =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    ASSERT_NEAR(to_srgb8(static_cast<float>(linear)), 255.0 * encoded, 0.502) << linear;
  }
}

TEST(ToSrgb8, ClampsAndNeverFails) {
  EXPECT_EQ(to_srgb8(0.0F), 0);
  EXPECT_EQ(to_srgb8(1.0F), 255);
  EXPECT_EQ(to_srgb8(-3.0F), 0);
  EXPECT_EQ(to_srgb8(1e30F), 255);
  EXPECT_EQ(to_srgb8(std::numeric_limits<float>::infinity()), 255);
  EXPECT_EQ(to_srgb8(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST_F(ImageIo, WhatIsWrittenComesBack) {
  const Image image = gradient(37, 23);
  write_png(image, folder / "picture.png");
  const auto codes = read_png(folder / "picture.png");
  ASSERT_EQ(codes.width, 37);
  ASSERT_EQ(codes.height, 23);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      ASSERT_EQ(codes.values[3 * i + static_cast<std::size_t>(c)], to_srgb8(image.pixels[i][c]));
    }
  }
}

TEST_F(ImageIo, PathsMayHaveAnyLettersAndNothingElseIsLeftBehind) {
  const fs::path path = folder / "Bücher und 図 \xF0\x9F\x90\x87.png";
  write_png(gradient(3, 2), path);
  write_png(gradient(4, 2), path);  // replaces the first
  EXPECT_EQ(read_png(path).width, 4);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

TEST_F(ImageIo, ASymbolicLinkStaysOne) {
  write_png(gradient(3, 2), folder / "target.png");
  fs::create_symlink(folder / "target.png", folder / "link.png");
  write_png(gradient(5, 2), folder / "link.png");
  EXPECT_TRUE(fs::is_symlink(folder / "link.png"));
  EXPECT_EQ(read_png(folder / "target.png").width, 5);
}

TEST_F(ImageIo, AMissingFolderIsNamed) {
  const fs::path path = folder / "nowhere" / "picture.png";
  const std::string message = message_of(gradient(2, 2), path);
  EXPECT_NE(message.find(path.string()), std::string::npos) << message;
  EXPECT_NE(message.find("No such file"), std::string::npos) << message;
}

TEST_F(ImageIo, AFolderIsNoPicture) {
  const std::string message = message_of(gradient(2, 2), folder);
  EXPECT_NE(message.find(folder.string()), std::string::npos) << message;
  EXPECT_TRUE(fs::is_directory(folder));
}

TEST_F(ImageIo, AFullDiskIsReported) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  const std::string message = message_of(gradient(64, 64), "/dev/full");
  EXPECT_NE(message.find("/dev/full"), std::string::npos) << message;
  EXPECT_NE(message.find("No space left"), std::string::npos) << message;
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(ImageIo, AnImageWithoutPixelsIsRefused) {
  EXPECT_THROW(write_png(Image{}, folder / "none.png"), std::invalid_argument);
  EXPECT_FALSE(fs::exists(folder / "none.png"));
}

}  // namespace
