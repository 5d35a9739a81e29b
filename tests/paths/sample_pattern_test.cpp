#include "renderer/paths/sample_pattern.h"

#include "renderer/camera_rays.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <vector>

namespace {

using namespace encore;
using renderer::sample_offset;

TEST(SamplePattern, EveryElementaryBoxHoldsOneSample) {
  for (const glm::ivec2 place : {glm::ivec2{0, 0}, {17, 3}, {1919, 1079}, {-1, 5}}) {
    for (int bits = 1; bits <= 12; ++bits) {
      const auto count = 1U << bits;
      for (int across = 0; across <= bits; ++across) {
        std::vector<int> held(count, 0);
        const double columns = 1U << across;
        const double rows = 1U << (bits - across);
        for (std::uint32_t i = 0; i < count; ++i) {
          const glm::dvec2 at = sample_offset(place.x, place.y, i, 4096, 7);
          ASSERT_TRUE(at.x >= 0.0 && at.x < 1.0 && at.y >= 0.0 && at.y < 1.0);
          ++held[static_cast<std::size_t>(at.y * rows) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(at.x * columns)];
        }
        for (const int number : held) ASSERT_EQ(number, 1) << count << " samples";
      }
    }
  }
}

TEST(SamplePattern, OneSampleIsTheCentre) {
  EXPECT_EQ(sample_offset(3, 4, 0, 1, 9), glm::dvec2(0.5));
}

TEST(SamplePattern, PixelsAndSeedsDiffer) {
  std::set<std::pair<double, double>> seen;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      for (std::uint32_t seed = 0; seed < 4; ++seed) {
        const glm::dvec2 at = sample_offset(x, y, 0, 2, seed);
        seen.insert({at.x, at.y});
      }
    }
  }
  EXPECT_GT(seen.size(), 16380U);
}

TEST(SamplePattern, FirstSamplesAreEvenOverPixels) {
  // Chi-squared over 16 x 16 boxes of 65,536 pixels: 255 degrees of freedom, +- 5 sigma.
  std::vector<double> held(256, 0.0);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const glm::dvec2 at = sample_offset(x, y, 0, 2, 1);
      held[static_cast<std::size_t>(at.y * 16.0) * 16 + static_cast<std::size_t>(at.x * 16.0)] += 1;
    }
  }
  double chi = 0.0;
  for (const double number : held) chi += (number - 256.0) * (number - 256.0) / 256.0;
  EXPECT_NEAR(chi, 255.0, 5.0 * 22.6);
}

TEST(CameraSamples, OneSampleGivesThePlainRaysAndMoreGoThroughTheirPlaces) {
  for (const float height : {0.0F, 3.0F}) {
    const scene::Camera camera{.eye = {1.0F, 2.0F, 5.0F}, .orthographic_height = height};
    const renderer::CameraFrame frame = renderer::make_camera_frame(camera, 40, 30);
    const renderer::PixelRect rect{8, 3, 24, 19};
    std::vector<scene::Ray> plain(rect.count()), sampled(rect.count());
    renderer::camera_rays(frame, rect, plain);
    renderer::camera_rays(frame, rect, {.sample = 0, .samples = 1, .seed = 3}, sampled);
    EXPECT_EQ(std::memcmp(plain.data(), sampled.data(), plain.size() * sizeof(scene::Ray)), 0);

    renderer::camera_rays(frame, rect, {.sample = 5, .samples = 8, .seed = 3}, sampled);
    std::size_t i = 0;
    for (int y = rect.y0; y < rect.y1; ++y) {
      for (int x = rect.x0; x < rect.x1; ++x, ++i) {
        const glm::dvec2 offset = sample_offset(x, y, 5, 8, 3);
        const glm::dvec3 aside = (x + offset.x - frame.center_x) * frame.right +
                                 (frame.center_y - y - offset.y) * frame.up;
        const glm::dvec3 origin =
            glm::dvec3(frame.origin) + (frame.orthographic ? aside : glm::dvec3(0.0));
        const glm::dvec3 direction =
            glm::normalize(frame.forward + (frame.orthographic ? glm::dvec3(0.0) : aside));
        ASSERT_LT(glm::length(glm::dvec3(sampled[i].origin) - origin), 1e-6);
        ASSERT_LT(glm::length(glm::dvec3(sampled[i].direction) - direction), 1e-6);
      }
    }
  }
}

}  // namespace
