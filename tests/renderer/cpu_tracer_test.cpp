#include "renderer/cpu_tracer.h"

#include "renderer/camera_rays.h"
#include "tests/renderer/allocation_count.h"
#include "tests/renderer/test_scenes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace {

using namespace encore;
using renderer::CpuTracer;
using renderer::Image;
using renderer::test::sphere_before_square;
using renderer::test::TestScene;

Image blank(int width, int height) {
  Image image;
  image.resize(width, height);
  return image;
}

Image picture(TestScene& setup, int threads, int width, int height) {
  CpuTracer tracer(threads);
  tracer.init(setup.input());
  Image image = blank(width, height);
  tracer.render(setup.scene.camera, image);
  EXPECT_TRUE(tracer.complete());
  return image;
}

bool same_bits(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

/// Counts how it is called, to hold the tracer to one call a tile.
class CallCounting final : public accel::AccelerationStructure {
 public:
  explicit CallCounting(const accel::AccelerationStructure& inner) : inner_(inner) {}
  [[nodiscard]] std::string_view name() const override { return "counting"; }
  void build(std::span<const accel::Triangle>) override {}
  void intersect(std::span<const accel::Ray> rays, std::span<accel::Hit> hits) const override {
    ++calls;
    traced += rays.size();
    if (cancel_after_first) *cancel_after_first = true;
    inner_.intersect(rays, hits);
  }
  void intersect_counted(std::span<const accel::Ray> rays, std::span<accel::Hit> hits,
                         std::span<accel::TraceCounters> counters) const override {
    ++calls;
    traced += rays.size();
    inner_.intersect_counted(rays, hits, counters);
  }
  void occluded(std::span<const accel::Ray>, std::span<std::uint8_t>) const override {}
  [[nodiscard]] accel::BuildStats stats() const override { return {}; }
  [[nodiscard]] accel::GpuBuffers gpu_buffers() const override { return {}; }
  void visit(const std::function<bool(const accel::NodeView&)>&) const override {}

  mutable std::atomic<std::uint64_t> calls{0};
  mutable std::atomic<std::uint64_t> traced{0};
  std::atomic<bool>* cancel_after_first = nullptr;

 private:
  const accel::AccelerationStructure& inner_;
};

TEST(CpuTracer, ASquareCoversExactlyThePixelsThatProjectionSays) {
  TestScene setup;
  // The view is 90 degrees from distance 2, so it spans [-2, 2]; the square [-1, 1] covers half.
  setup.scene.camera = {.eye = {0.0F, 0.0F, 2.0F}};
  setup.scene.background = {0.0F, 0.0F, 1.0F};
  setup.scene.materials.resize(1);
  setup.scene.materials[0].emission = {1.0F, 0.0F, 0.0F};
  setup.scene.materials[0].ambient = glm::vec3(0.0F);
  renderer::test::add_square(setup.list, 1.0F, 0.0F);
  const Image image = picture(setup, 2, 64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool inside = x >= 16 && x < 48 && y >= 16 && y < 48;
      ASSERT_EQ(image.pixels[static_cast<std::size_t>(y * 64 + x)],
                inside ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1))
          << x << ", " << y;
    }
  }
}

TEST(CpuTracer, ASphereCoversTheAreaOfItsSilhouette) {
  TestScene setup;
  setup.scene.camera = {.eye = {0.0F, 0.0F, 3.0F}, .vertical_fov_degrees = 60.0F};
  renderer::test::add_sphere(setup.list, 48);
  CpuTracer tracer(2);
  tracer.init(setup.input());
  std::vector<scene::Hit> hits;
  tracer.trace_hits(setup.scene.camera, 150, 100, hits);
  // The silhouette is a circle of tan(asin(1 / 3)) at distance 1, where the image is 2 tan 30 high.
  const double radius = std::tan(std::asin(1.0 / 3.0)) * 100.0 / (2.0 * std::tan(M_PI / 6.0));
  const double expected = M_PI * radius * radius;
  EXPECT_NEAR(static_cast<double>(tracer.hit_count()), expected, 0.01 * expected);
  std::uint64_t found = 0;
  for (const scene::Hit& hit : hits) found += hit.found() ? 1 : 0;
  EXPECT_EQ(found, tracer.hit_count());
}

TEST(CpuTracer, AnyNumberOfThreadsGivesTheSameBits) {
  const auto setup = sphere_before_square();
  const Image one = picture(*setup, 1, 101, 67);
  for (const int threads : {2, 3, 8, 0}) {
    EXPECT_TRUE(same_bits(picture(*setup, threads, 101, 67), one)) << threads << " threads";
  }
}

TEST(CpuTracer, HitsAreThoseOfTheStructureForEachPixel) {
  const auto setup = sphere_before_square();
  CpuTracer tracer(3);
  tracer.init(setup->input());
  std::vector<scene::Hit> hits;
  std::vector<accel::TraceCounters> counters;
  tracer.trace_hits(setup->scene.camera, 45, 33, hits);
  const std::uint64_t found = tracer.hit_count();
  tracer.trace_counters(setup->scene.camera, 45, 33, counters);
  EXPECT_EQ(tracer.hit_count(), found);

  const renderer::PixelRect all{0, 0, 45, 33};
  std::vector<scene::Ray> rays(all.count());
  renderer::camera_rays(renderer::make_camera_frame(setup->scene.camera, 45, 33), all, rays);
  std::vector<scene::Hit> expected(rays.size());
  setup->structure.intersect(rays, expected);
  ASSERT_EQ(hits.size(), expected.size());
  ASSERT_EQ(counters.size(), expected.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    ASSERT_EQ(std::memcmp(&hits[i], &expected[i], sizeof(scene::Hit)), 0) << i;
    ASSERT_EQ(counters[i].triangle_tests, setup->list.triangles.size());
    ASSERT_EQ(counters[i].steps, 1U);
  }
}

TEST(CpuTracer, EveryPixelIsTracedOnceInBatches) {
  const auto setup = sphere_before_square();
  const renderer::RenderInput input = setup->input();
  const CallCounting counting(setup->structure);
  CpuTracer tracer(2);
  tracer.init({input.scene, input.triangles, &counting});
  Image image = blank(100, 50);
  tracer.render(setup->scene.camera, image);
  EXPECT_EQ(counting.traced, 5000U);
  EXPECT_LE(counting.calls, 28U);
}

TEST(CpuTracer, NothingIsAllocatedAfterTheFirstFrame) {
  for (const int threads : {1, 2}) {
    const auto setup = sphere_before_square();
    CpuTracer tracer(threads);
    tracer.init(setup->input());
    Image image = blank(64, 64);
    std::vector<scene::Hit> hits;
    std::vector<accel::TraceCounters> counters;
    const auto frame = [&] {
      tracer.refresh();
      tracer.render(setup->scene.camera, image);
      tracer.trace_hits(setup->scene.camera, 64, 64, hits);
      tracer.trace_counters(setup->scene.camera, 64, 64, counters);
    };
    const std::uint64_t at_start = renderer::test::allocations_so_far();
    frame();
    EXPECT_GT(renderer::test::allocations_so_far(), at_start) << "the counter does not count";
    const std::uint64_t before = renderer::test::allocations_so_far();
    for (int i = 0; i < 5; ++i) frame();
    EXPECT_EQ(renderer::test::allocations_so_far() - before, 0U) << threads << " threads";
  }
}

TEST(CpuTracer, NothingIsAllocatedAfterTheFirstFrameWithRaysOfAllKinds) {
  for (const int threads : {1, 2}) {
    const auto setup = sphere_before_square();
    setup->scene.materials[0].reflectivity = 0.5F;
    setup->scene.materials[1].opacity = 0.5F;
    CpuTracer tracer(threads);
    tracer.set_rays({.shadows = true, .reflections = true, .refractions = true, .samples = 2});
    tracer.init(setup->input());
    Image image = blank(64, 64);
    const auto frame = [&] {
      tracer.refresh();
      tracer.render(setup->scene.camera, image);
      tracer.draw_samples(setup->scene.camera, 64, 64, 1, 1);
    };
    frame();
    const std::uint64_t before = renderer::test::allocations_so_far();
    for (int i = 0; i < 5; ++i) frame();
    EXPECT_EQ(renderer::test::allocations_so_far() - before, 0U) << threads << " threads";
    EXPECT_GT((*tracer.last_rays())[scene::RayKind::refraction].rays, 0U);
  }
}

TEST(CpuTracer, CancellingLeavesTheRestOfTheImageAlone) {
  const auto setup = sphere_before_square();
  const renderer::RenderInput input = setup->input();
  std::atomic<bool> cancel{false};
  CallCounting counting(setup->structure);
  counting.cancel_after_first = &cancel;
  CpuTracer tracer(1);
  tracer.init({input.scene, input.triangles, &counting});
  tracer.set_cancel_flag(&cancel);
  Image image = blank(64, 64);
  const glm::vec3 untouched{-7.0F};
  for (glm::vec3& pixel : image.pixels) pixel = untouched;
  tracer.render(setup->scene.camera, image);
  EXPECT_FALSE(tracer.complete());
  EXPECT_EQ(counting.calls, 1U);
  EXPECT_NE(image.pixels.front(), untouched);
  EXPECT_EQ(image.pixels.back(), untouched);
  // Without the flag the next frame is whole again.
  tracer.set_cancel_flag(nullptr);
  tracer.render(setup->scene.camera, image);
  EXPECT_TRUE(tracer.complete());
  EXPECT_NE(image.pixels.back(), untouched);
}

TEST(CpuTracer, AnEmptySceneIsAllBackground) {
  TestScene setup;
  setup.scene.background = {0.5F, 0.25F, 0.125F};
  for (const glm::vec3& pixel : picture(setup, 2, 17, 5).pixels) {
    EXPECT_EQ(pixel, setup.scene.background);
  }
}

TEST(CpuTracer, RefreshSeesWhatTheSceneHasComeToNeed) {
  TestScene setup;
  setup.scene.camera = {.eye = {0.0F, 0.0F, 2.0F}};
  setup.scene.materials.resize(1);
  setup.scene.lights.resize(1);
  renderer::test::add_square(setup.list, 3.0F, 0.0F);
  CpuTracer tracer(1);
  tracer.init(setup.input());
  Image image = blank(4, 4);
  tracer.render(setup.scene.camera, image);
  EXPECT_NE(image.pixels[5].g, 0.2F * 0.1F);
  setup.list.colors.assign(2, {glm::vec3(0), glm::vec3(0), glm::vec3(0)});
  tracer.refresh();
  tracer.render(setup.scene.camera, image);
  EXPECT_EQ(image.pixels[5], glm::vec3(renderer::kAmbientLight * 0.1F));
}

TEST(CpuTracer, WrongUseIsReported) {
  CpuTracer tracer(1);
  Image image = blank(4, 4);
  EXPECT_THROW(tracer.render({}, image), std::logic_error);
  EXPECT_THROW(tracer.refresh(), std::logic_error);
  EXPECT_THROW(tracer.init({}), std::invalid_argument);
  TestScene setup;
  tracer.init(setup.input());
  EXPECT_THROW(tracer.render({.eye = glm::vec3(0.0F)}, image), std::invalid_argument);
  image.pixels.pop_back();
  EXPECT_THROW(tracer.render({}, image), std::invalid_argument);
  Image none;
  EXPECT_THROW(tracer.render({}, none), std::invalid_argument);
}

}  // namespace
