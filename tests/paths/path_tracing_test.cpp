#include "accel/make_structure.h"
#include "accel/settings.h"
#include "tests/paths/paths_support.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace {

using namespace encore;
using renderer::CpuTracer;
using renderer::Image;
using renderer::RayFigures;
using renderer::test::everything;
using renderer::test::kEverything;
using renderer::test::mirror;
using renderer::test::picture_with;
using renderer::test::pixel;
using renderer::test::same_bits;
using renderer::test::TestScene;
using scene::RayKind;

scene::RaySettings with_samples(scene::RaySettings rays, int samples) {
  rays.samples = samples;
  return rays;
}

TEST(PathTracing, AnyNumberOfThreadsGivesTheSameBits) {
  const auto setup = everything();
  const scene::RaySettings rays = with_samples(kEverything, 3);
  const Image one = picture_with(*setup, rays, 61, 43, 1);
  for (const int threads : {2, 5}) {
    EXPECT_TRUE(same_bits(picture_with(*setup, rays, 61, 43, threads), one)) << threads;
  }
}

TEST(PathTracing, EveryStructureGivesTheSameBits) {
  const auto setup = everything();
  const Image expected = picture_with(*setup, kEverything, 61, 43);
  for (const accel::StructureKind kind : accel::all_structure_kinds()) {
    const auto structure = accel::make_structure(accel::default_spec(kind));
    structure->build(setup->list.triangles);
    CpuTracer tracer(2);
    tracer.set_rays(kEverything);
    tracer.init({&setup->scene, &setup->list, structure.get()});
    Image image;
    image.resize(61, 43);
    tracer.render(setup->scene.camera, image);
    EXPECT_TRUE(same_bits(image, expected)) << accel::to_string(kind);
  }
}

TEST(PathTracing, APixelDoesNotDependOnTheOthers) {
  // The same 32 x 32 pixels of an orthographic view, in the middle of pictures of two sizes.
  const auto setup = everything();
  setup->scene.camera.orthographic_height = 2.0F;
  const Image small = picture_with(*setup, kEverything, 32, 32);
  setup->scene.camera.orthographic_height = 3.0F;
  const Image large = picture_with(*setup, kEverything, 48, 48);
  int differing = 0;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      differing += pixel(small, x, y) == pixel(large, x + 8, y + 8) ? 0 : 1;
    }
  }
  EXPECT_EQ(differing, 0);
}

TEST(PathTracing, WhatASceneHasNoUseForChangesNoBit) {
  const auto setup = renderer::test::sphere_before_square();
  const Image plain = picture_with(*setup, {}, 50, 40);
  EXPECT_TRUE(
      same_bits(plain, picture_with(*setup, {.reflections = true, .refractions = true}, 50, 40)));
  TestScene dark;
  dark.scene = setup->scene;
  dark.scene.lights.clear();
  dark.list = setup->list;
  const Image unlit = picture_with(dark, {}, 50, 40);
  EXPECT_TRUE(same_bits(unlit, picture_with(dark, kEverything, 50, 40)));
}

TEST(PathTracing, RaysThatMeetNothingOnTheirWayChangeNoBit) {
  // A lone square facing its lights: shadow rays are traced, but none is stopped.
  TestScene setup;
  setup.scene.camera = {.eye = {0.2F, 0.1F, 3}};
  setup.scene.background = {0.1F, 0.2F, 0.3F};
  setup.scene.materials.resize(2);
  setup.scene.materials[0].specular = glm::vec3(0.5F);
  setup.scene.materials[1].reflectivity = 1.0F;  // of no triangle in sight
  setup.scene.lights = {{.position = {1, 2, 3}}, {.position = {-2, 0, 5}, .color = {0, 1, 0}}};
  renderer::test::add_square(setup.list, 1.5F, 0.0F);
  const Image plain = picture_with(setup, {}, 40, 30);
  EXPECT_TRUE(same_bits(plain, picture_with(setup, {.shadows = true}, 40, 30)));
  EXPECT_TRUE(same_bits(plain, picture_with(setup, {.reflections = true}, 40, 30)));
  EXPECT_TRUE(same_bits(plain, picture_with(setup, kEverything, 40, 30)));
}

TEST(PathTracing, AFieldOfOneColourLooksTheSameWithAnyNumberOfSamples) {
  TestScene setup;
  setup.scene.background = {0.5F, 0.25F, 0.125F};
  for (const glm::vec3& seen : picture_with(setup, with_samples({}, 16), 20, 20).pixels) {
    EXPECT_EQ(seen, setup.scene.background);
  }
}

TEST(PathTracing, SamplesCountThePartOfAPixelThatIsCovered) {
  // A glowing square whose edge runs through pixels a quarter of the way: with 16 stratified
  // samples every such pixel is a quarter bright exactly.
  TestScene setup;
  setup.scene.camera = {.eye = {0, 0, 2}, .orthographic_height = 8.0F};
  setup.scene.materials = {renderer::test::glowing(glm::vec3(1.0F))};
  renderer::test::add_square(setup.list, 2.25F, 0.0F);
  const Image image = picture_with(setup, with_samples({}, 16), 8, 8);
  for (int y = 2; y < 6; ++y) {
    EXPECT_EQ(pixel(image, 0, y).r, 0.0F);
    EXPECT_EQ(pixel(image, 1, y).r, 0.25F);
    EXPECT_EQ(pixel(image, 2, y).r, 1.0F);
    EXPECT_EQ(pixel(image, 6, y).r, 0.25F);
  }
}

TEST(PathTracing, PartsOfTheSamplesMakeUpTheWhole) {
  const auto setup = everything();
  const Image whole = picture_with(*setup, with_samples(kEverything, 8), 40, 30);
  CpuTracer tracer(2);
  tracer.set_rays(with_samples(kEverything, 8));
  tracer.init(setup->input());
  std::vector<glm::dvec3> sum(whole.pixels.size(), glm::dvec3(0.0));
  Image part;
  for (const std::uint32_t first : {6U, 0U, 2U, 4U}) {  // in any order
    tracer.draw_samples(setup->scene.camera, 40, 30, first, 2);
    tracer.read(part);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += glm::dvec3(part.pixels[i]) / 4.0;
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(sum[i][c], whole.pixels[i][c], 1e-6) << i;
  }
  tracer.draw_samples(setup->scene.camera, 40, 30, 0, 8);
  tracer.read(part);
  EXPECT_TRUE(same_bits(part, whole));
  EXPECT_THROW(tracer.draw_samples(setup->scene.camera, 40, 30, 8, 1), std::invalid_argument);
  EXPECT_THROW(tracer.draw_samples(setup->scene.camera, 40, 30, 0, 0), std::invalid_argument);
  EXPECT_THROW(tracer.draw_samples(setup->scene.camera, 40, 30, 7, 2), std::invalid_argument);
}

TEST(PathTracing, SettingsTakeEffectWithTheNextRefresh) {
  const auto setup = everything();
  const Image plain = picture_with(*setup, {}, 20, 20);
  CpuTracer tracer(1);
  tracer.init(setup->input());
  tracer.set_rays(kEverything);
  Image image;
  image.resize(20, 20);
  tracer.render(setup->scene.camera, image);
  EXPECT_TRUE(same_bits(image, plain));
  tracer.refresh();
  tracer.render(setup->scene.camera, image);
  EXPECT_TRUE(same_bits(image, picture_with(*setup, kEverything, 20, 20)));
  tracer.set_rays({});
  tracer.refresh();
  tracer.render(setup->scene.camera, image);
  EXPECT_TRUE(same_bits(image, plain));
}

RayFigures figures_of(TestScene& setup, const scene::RaySettings& rays, int size) {
  CpuTracer tracer(2);
  tracer.set_rays(rays);
  tracer.init(setup.input());
  EXPECT_FALSE(tracer.last_rays());
  tracer.draw(setup.scene.camera, size, size);
  EXPECT_TRUE(tracer.last_rays());
  return tracer.last_rays().value_or(RayFigures{});
}

TEST(RayFigures, CountEveryKind) {
  // A window fills the view, behind it a mirror, behind the eye a lit wall: each pixel's ray goes
  // through the window, is mirrored, comes back through the window and ends on the wall, which asks
  // for two lights; the window and the mirror show nothing of themselves and ask for none.
  TestScene setup;
  setup.scene.camera = {.eye = {0, 0, 1}, .target = {0, 0, 0}};
  setup.scene.materials = {renderer::test::glass(1.0F), mirror(), scene::Material{}};
  setup.scene.lights = {{.position = {0, 0, 3}}, {.position = {1, 0, 3}}};
  renderer::test::add_square(setup.list, 50.0F, -1.0F, 0);
  renderer::test::add_square(setup.list, 50.0F, -2.0F, 1);
  renderer::test::add_square(setup.list, 50.0F, 5.0F, 2);
  const RayFigures all =
      figures_of(setup, {.shadows = true, .reflections = true, .refractions = true}, 24);
  const std::uint64_t pixels = 24 * 24;
  EXPECT_EQ(all[RayKind::camera].rays, pixels);
  EXPECT_EQ(all[RayKind::refraction].rays, 2 * pixels);
  EXPECT_EQ(all[RayKind::reflection].rays, pixels);
  EXPECT_EQ(all[RayKind::shadow].rays, 2 * pixels);
  EXPECT_EQ(all.rays(), 6 * pixels);
  double sum = 0.0;
  for (const RayKind kind :
       {RayKind::camera, RayKind::shadow, RayKind::reflection, RayKind::refraction}) {
    ASSERT_TRUE(all[kind].seconds);
    EXPECT_GT(*all[kind].seconds, 0.0);
    sum += all.share(kind).value_or(0.0);
  }
  EXPECT_NEAR(sum, 1.0, 1e-9);

  // Only what is asked for is traced: without mirrors the window shows the mirror's own black.
  const RayFigures fewer = figures_of(setup, {.refractions = true, .samples = 3}, 24);
  EXPECT_EQ(fewer[RayKind::camera].rays, 3 * pixels);
  EXPECT_EQ(fewer[RayKind::refraction].rays, 3 * pixels);
  EXPECT_EQ(fewer[RayKind::reflection].rays, 0U);
  EXPECT_FALSE(fewer[RayKind::reflection].seconds);
  EXPECT_EQ(fewer[RayKind::shadow].rays, 0U);
}

TEST(RayFigures, OfPlainPicturesAreTheirPixels) {
  const auto setup = renderer::test::sphere_before_square();
  const RayFigures figures = figures_of(*setup, {}, 20);
  EXPECT_EQ(figures[RayKind::camera].rays, 400U);
  EXPECT_EQ(figures.rays(), 400U);
  EXPECT_FALSE(figures[RayKind::camera].seconds);
  EXPECT_FALSE(figures.share(RayKind::camera));
}

TEST(RayFigures, HitsAreThoseOfCameraRays) {
  const auto setup = everything();
  CpuTracer tracer(2);
  tracer.init(setup->input());
  tracer.draw(setup->scene.camera, 40, 40);
  const auto plain = tracer.last_hits();
  tracer.set_rays(kEverything);
  tracer.refresh();
  tracer.draw(setup->scene.camera, 40, 40);
  EXPECT_EQ(tracer.last_hits(), plain);
}

/// Turns a flag on after so many batches.
class Cancelling final : public accel::AccelerationStructure {
 public:
  Cancelling(const accel::AccelerationStructure& inner, std::atomic<bool>& flag, int batches)
      : inner_(inner), flag_(flag), left_(batches) {}
  [[nodiscard]] std::string_view name() const override { return "cancelling"; }
  void build(std::span<const accel::Triangle>) override {}
  void intersect(std::span<const accel::Ray> rays, std::span<accel::Hit> hits) const override {
    if (--left_ == 0) flag_ = true;
    inner_.intersect(rays, hits);
  }
  void intersect_counted(std::span<const accel::Ray>, std::span<accel::Hit>,
                         std::span<accel::TraceCounters>) const override {}
  void occluded(std::span<const accel::Ray> rays, std::span<std::uint8_t> blocked) const override {
    inner_.occluded(rays, blocked);
  }
  [[nodiscard]] accel::BuildStats stats() const override { return {}; }
  [[nodiscard]] accel::GpuBuffers gpu_buffers() const override { return {}; }
  void visit(const std::function<bool(const accel::NodeView&)>&) const override {}

 private:
  const accel::AccelerationStructure& inner_;
  std::atomic<bool>& flag_;
  mutable std::atomic<int> left_;
};

TEST(PathTracing, CancellingEndsBetweenTwoSamples) {
  const auto setup = renderer::test::sphere_before_square();
  const renderer::RenderInput input = setup->input();
  std::atomic<bool> cancel{false};
  // The first of the tiles is done after 4096 samples, the second is stopped after 3.
  const Cancelling structure(setup->structure, cancel, 4096 + 3);
  CpuTracer tracer(1);
  tracer.set_rays({.samples = scene::kMostSamples});
  tracer.init({input.scene, input.triangles, &structure});
  tracer.set_cancel_flag(&cancel);
  const glm::vec3 untouched{-7.0F};
  Image image;
  image.resize(17, 1);
  image.pixels.assign(17, untouched);
  tracer.render(setup->scene.camera, image);
  EXPECT_FALSE(tracer.complete());
  EXPECT_NE(image.pixels[0], untouched);
  EXPECT_EQ(image.pixels[16], untouched);
  ASSERT_TRUE(tracer.last_rays());
  EXPECT_EQ((*tracer.last_rays())[RayKind::camera].rays, 4096U * 16U + 3U);
}

}  // namespace
