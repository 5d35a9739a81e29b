// Pictures, counters and sizes.
#include "renderer/image_diff.h"
#include "tests/bvh/test_scenes.h"
#include "tests/gpu/gpu_scenes.h"
#include "tests/renderer/test_scenes.h"

#include <atomic>
#include <cmath>

namespace encore::renderer::test {
namespace {

using accel::StructureKind;

Image picture_of(Renderer& renderer, const scene::Camera& camera, int width, int height) {
  Image image;
  image.resize(width, height);
  renderer.render(camera, image);
  EXPECT_EQ(image.width, width);
  EXPECT_EQ(image.height, height);
  return image;
}

void expect_close(const Image& found, const Image& expected, const std::string& what) {
  const ImageDifference difference = compare_images(found, expected, 1e-3);
  EXPECT_LT(difference.rmse, 1e-4)
      << what << ", most at " << difference.largest_x << ", " << difference.largest_y;
}

bool has_more_than_one_color(const Image& image) {
  return std::any_of(image.pixels.begin(), image.pixels.end(),
                     [&](const glm::vec3& pixel) { return pixel != image.pixels.front(); });
}

class GpuPictures : public encore::test::GlTest,
                    public testing::WithParamInterface<StructureKind> {};

TEST_P(GpuPictures, AreThoseOfTheCpu) {
  GpuTracer tracer(context_);
  CpuTracer cpu(1);
  EXPECT_EQ(tracer.texture(), 0U);
  for (const char* name : {"cow", "toys"}) {
    const auto setup = sample_scene(name, spec_of(GetParam()));
    tracer.init(setup->input());
    cpu.init(setup->input());
    for (const auto& [width, height] : {std::pair{48, 48}, {37, 53}}) {
      const Image image = picture_of(tracer, setup->scene.camera, width, height);
      EXPECT_TRUE(has_more_than_one_color(image)) << name;
      expect_close(image, picture_of(cpu, setup->scene.camera, width, height), name);
      EXPECT_TRUE(tracer.complete());
      EXPECT_NE(tracer.texture(), 0U);
    }
  }
}

TEST_P(GpuPictures, OrthographicOnesAreThoseOfTheCpu) {
  GpuTracer tracer(context_);
  CpuTracer cpu(1);
  const auto setup = sample_scene("toys", spec_of(GetParam()));
  setup->scene.camera.orthographic_height = 30.0F;
  tracer.init(setup->input());
  cpu.init(setup->input());
  const Image image = picture_of(tracer, setup->scene.camera, 37, 53);
  EXPECT_TRUE(has_more_than_one_color(image));
  expect_close(image, picture_of(cpu, setup->scene.camera, 37, 53), "toys");
}

TEST_P(GpuPictures, CountersAreOfTheSameWork) {
  const auto setup = sample_scene("toys", spec_of(GetParam()));
  GpuTracer tracer(context_);
  CpuTracer cpu(1);
  tracer.init(setup->input());
  cpu.init(setup->input());
  std::vector<accel::TraceCounters> found;
  std::vector<accel::TraceCounters> expected;
  tracer.trace_counters(setup->scene.camera, 37, 29, found);
  cpu.trace_counters(setup->scene.camera, 37, 29, expected);
  ASSERT_EQ(found.size(), expected.size());
  accel::TraceCounters gpu_sum;
  accel::TraceCounters cpu_sum;
  std::size_t same_steps = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    gpu_sum += found[i];
    cpu_sum += expected[i];
    same_steps += found[i].steps == expected[i].steps ? 1 : 0;
  }
  // Rounding may send a ray the other way round a node now and then, never far.
  EXPECT_GE(same_steps, found.size() * 95 / 100);
  const auto expect_near = [](std::uint32_t a, std::uint32_t b, const char* what) {
    EXPECT_NEAR(static_cast<double>(a), static_cast<double>(b), 0.02 * static_cast<double>(b))
        << what;
  };
  expect_near(gpu_sum.steps, cpu_sum.steps, "steps");
  expect_near(gpu_sum.box_tests, cpu_sum.box_tests, "box tests");
  expect_near(gpu_sum.triangle_tests, cpu_sum.triangle_tests, "triangle tests");
  EXPECT_GT(gpu_sum.triangle_tests, 0U);
}

TEST_P(GpuPictures, AnEmptySceneIsAllBackground) {
  const auto setup = scene_of({}, spec_of(GetParam()));
  setup->scene.background = {0.5F, 0.25F, 0.125F};
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  for (const auto& [width, height] : {std::pair{17, 5}, {1, 1}}) {
    for (const glm::vec3& pixel : picture_of(tracer, setup->scene.camera, width, height).pixels) {
      ASSERT_EQ(pixel, setup->scene.background);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, GpuPictures, testing::ValuesIn(gpu_kinds()), kind_name);

class GpuShading : public encore::test::GlTest {
 protected:
  /// One draw of the scene with both tracers.
  void expect_cpu_picture(const GpuTestScene& setup, const std::string& what) {
    GpuTracer tracer(context_);
    CpuTracer cpu(1);
    tracer.init(setup.input());
    cpu.init(setup.input());
    const Image image = picture_of(tracer, setup.scene.camera, 40, 40);
    EXPECT_TRUE(has_more_than_one_color(image)) << what;
    expect_close(image, picture_of(cpu, setup.scene.camera, 40, 40), what);
  }

  /// A ball with normals before a square.
  static std::unique_ptr<GpuTestScene> ball() {
    auto setup = std::make_unique<GpuTestScene>();
    setup->scene.camera = {.eye = {0.0F, 0.0F, 3.0F}, .vertical_fov_degrees = 60.0F};
    setup->scene.background = {0.1F, 0.2F, 0.3F};
    add_sphere(setup->list, 8);
    setup->structure = accel::make_structure(spec_of(StructureKind::bvh_median));
    setup->structure->build(setup->list.triangles);
    return setup;
  }
};

TEST_F(GpuShading, OfEachFeatureAndOfAllIsThatOfTheCpu) {
  const std::size_t count = ball()->list.triangles.size();
  const std::vector<std::array<glm::vec3, 3>> colors(
      count, {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)});
  // None, normals, colours, lights, lights with highlights, all.
  for (const int features : {0, 1, 2, 4, 12, 15}) {
    const auto setup = ball();
    if ((features & 1) == 0) setup->list.normals.clear();
    if ((features & 2) != 0) setup->list.colors = colors;
    if ((features & 4) != 0) setup->scene.lights.push_back({{2.0F, 1.0F, 4.0F}, glm::vec3(0.8F)});
    setup->scene.materials.resize(1);
    setup->scene.materials[0].shininess = 7.5F;
    if ((features & 8) != 0) setup->scene.materials[0].specular = glm::vec3(0.5F);
    expect_cpu_picture(*setup, "features " + std::to_string(features));
  }
}

TEST_F(GpuShading, ATriangleWhoseMaterialDoesNotExistTakesTheDefaultOne) {
  const auto setup = ball();
  setup->scene.lights.resize(2);
  expect_cpu_picture(*setup, "no materials");
  setup->scene.materials.resize(3);
  for (auto& material : setup->scene.materials) material.diffuse = {0.9F, 0.1F, 0.1F};
  for (std::size_t i = 0; i < setup->list.triangles.size(); ++i) {
    setup->list.triangles[i].material = static_cast<std::uint32_t>(i % 5);
  }
  setup->list.triangles[0].material = 0xFFFFFFFFU;
  expect_cpu_picture(*setup, "some materials");
}

TEST_F(GpuShading, FewerMaterialsLaterLeaveNoOldOnesBehind) {
  const auto setup = ball();
  setup->scene.lights.resize(1);
  setup->scene.materials.resize(40);
  for (auto& material : setup->scene.materials) material.emission = {5.0F, 0.0F, 5.0F};
  for (auto& triangle : setup->list.triangles) triangle.material = 17;
  GpuTracer tracer(context_);
  CpuTracer cpu(1);
  tracer.init(setup->input());
  cpu.init(setup->input());
  setup->scene.materials.resize(2);
  setup->scene.mark_changed();
  tracer.refresh();
  cpu.refresh();
  expect_close(picture_of(tracer, setup->scene.camera, 24, 24),
               picture_of(cpu, setup->scene.camera, 24, 24), "two materials");
}

TEST_F(GpuShading, FeaturesMayComeAndGo) {
  const auto setup = ball();
  setup->scene.lights.resize(1);
  GpuTracer tracer(context_);
  CpuTracer cpu(1);
  tracer.init(setup->input());
  cpu.init(setup->input());
  const auto expect_same = [&](const char* what) {
    tracer.refresh();
    cpu.refresh();
    expect_close(picture_of(tracer, setup->scene.camera, 24, 24),
                 picture_of(cpu, setup->scene.camera, 24, 24), what);
  };
  expect_same("as made");
  setup->list.normals.clear();
  expect_same("no normals");
  setup->list.colors.assign(setup->list.triangles.size(),
                            {glm::vec3(0.5F), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)});
  expect_same("colours");
  setup->scene.lights.clear();
  setup->scene.mark_changed();
  expect_same("no lights");
  setup->scene.background = {0.0F, 1.0F, 0.0F};
  expect_same("another background");
}

using GpuFrames = encore::test::GlTest;

TEST_F(GpuFrames, CameraAndSizeMayChangeFromFrameToFrame) {
  const auto setup = sample_scene("wheel", spec_of(StructureKind::bvh_median));
  GpuTracer tracer(context_);
  CpuTracer cpu(1);
  tracer.init(setup->input());
  cpu.init(setup->input());
  scene::Camera camera = setup->scene.camera;
  for (const auto& [width, height] : {std::pair{64, 16}, {16, 64}, {1, 1}, {200, 3}, {64, 16}}) {
    camera.eye *= 0.9F;
    expect_close(picture_of(tracer, camera, width, height), picture_of(cpu, camera, width, height),
                 std::to_string(width) + " wide");
  }
}

TEST_F(GpuFrames, TheDeviceSaysHowLongAFrameTookWhereItHasAClock) {
  const auto setup = sample_scene("wheel", spec_of(StructureKind::bvh_median));
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  EXPECT_FALSE(tracer.last_draw_s().has_value());
  tracer.draw(setup->scene.camera, 64, 64);
  ASSERT_EQ(tracer.last_draw_s().has_value(), context_->capabilities().timestamp_bits > 0);
  if (tracer.last_draw_s()) {
    EXPECT_GT(*tracer.last_draw_s(), 0.0);
  }
  EXPECT_EQ(tracer.device_name(), context_->capabilities().device_name());
}

TEST_F(GpuFrames, ACancelledFrameIsNotComplete) {
  const auto setup = sample_scene("wheel", spec_of(StructureKind::bvh_median));
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  std::atomic<bool> cancel{true};
  tracer.set_cancel_flag(&cancel);
  tracer.draw(setup->scene.camera, 32, 32);
  EXPECT_FALSE(tracer.complete());
  EXPECT_FALSE(tracer.last_draw_s().has_value());
  tracer.set_cancel_flag(nullptr);
  tracer.draw(setup->scene.camera, 32, 32);
  EXPECT_TRUE(tracer.complete());
}

}  // namespace
}  // namespace encore::renderer::test
