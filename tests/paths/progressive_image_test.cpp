#include "renderer/paths/progressive_image.h"

#include "accel/make_structure.h"
#include "accel/settings.h"
#include "renderer/image_diff.h"
#include "tests/paths/paths_support.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace {

using namespace encore;
using renderer::CpuTracer;
using renderer::Image;
using renderer::ProgressiveImage;

Image grey(float value) {
  Image image;
  image.resize(2, 1);
  image.pixels.assign(2, glm::vec3(value));
  return image;
}

TEST(ProgressiveImage, IsTheMeanOfAllSamples) {
  ProgressiveImage picture;
  picture.reset(2, 1);
  EXPECT_EQ(picture.mean().pixels[0], glm::vec3(0.0F));
  picture.add(grey(1.0F), 1);
  picture.add(grey(2.0F), 3);
  EXPECT_EQ(picture.samples(), 4U);
  EXPECT_EQ(picture.mean().pixels[1], glm::vec3(1.75F));
  picture.reset(2, 1);
  EXPECT_EQ(picture.samples(), 0U);
  EXPECT_FALSE(picture.error());
}

TEST(ProgressiveImage, ErrorIsHalfTheDifferenceOfTheHalves) {
  ProgressiveImage picture;
  picture.reset(2, 1);
  picture.add(grey(1.0F), 2);
  EXPECT_FALSE(picture.error());
  picture.add(grey(4.0F), 2);
  ASSERT_TRUE(picture.error());
  EXPECT_DOUBLE_EQ(*picture.error(), 1.5);
  EXPECT_EQ(picture.error_samples(), 4U);
  picture.add(grey(9.0F), 2);
  EXPECT_DOUBLE_EQ(*picture.error(), 1.5);  // the second half is not there yet
  EXPECT_EQ(picture.error_samples(), 4U);
  picture.add(grey(1.0F), 2);
  EXPECT_DOUBLE_EQ(*picture.error(), 0.5 * (5.0 - 2.5));
  EXPECT_EQ(picture.error_samples(), 8U);
}

TEST(ProgressiveImage, WrongPartsAreReported) {
  ProgressiveImage picture;
  picture.reset(3, 1);
  EXPECT_THROW(picture.add(grey(1.0F), 1), std::invalid_argument);
  picture.reset(2, 1);
  EXPECT_THROW(picture.add(grey(1.0F), 0), std::invalid_argument);
}

TEST(ProgressiveImage, EstimatesTheErrorAgainstTheTruth) {
  const auto setup = renderer::test::everything();
  scene::RaySettings rays = renderer::test::kEverything;
  rays.samples = 1024;
  const auto structure =
      accel::make_structure(accel::default_spec(accel::StructureKind::bvh_median));
  structure->build(setup->list.triangles);
  CpuTracer tracer(2);
  tracer.set_rays(rays);
  tracer.init({&setup->scene, &setup->list, structure.get()});
  const int size = 32;
  // Other samples than those that are judged, so that none is its own judge.
  Image truth;
  tracer.draw_samples(setup->scene.camera, size, size, 512, 512);
  tracer.read(truth);

  ProgressiveImage picture;
  picture.reset(size, size);
  double last = 1e9;
  std::uint32_t judged = 0;
  for (std::uint32_t first = 0; first < 64; ++first) {
    Image part;
    tracer.draw_samples(setup->scene.camera, size, size, first, 1);
    tracer.read(part);
    picture.add(part, 1);
    if (picture.error_samples() != picture.samples()) continue;
    const double estimated = *picture.error();
    const double real = renderer::compare_images(picture.mean(), truth).rmse;
    EXPECT_GT(estimated, 0.5 * real) << picture.samples();
    EXPECT_LT(estimated, 2.0 * real) << picture.samples();
    EXPECT_LT(estimated, 0.85 * last) << picture.samples();
    last = estimated;
    ++judged;
  }
  EXPECT_EQ(judged, 6U);
}

}  // namespace
