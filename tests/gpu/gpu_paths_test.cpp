// Shadows, reflections, refractions, textures and several samples a pixel: the picture of the CPU,
// made of as many rays of each kind.
#include "renderer/raster_renderer.h"
#include "tests/bvh/test_scenes.h"
#include "tests/gpu/path_scenes.h"
#include "tests/gpu/small_device.h"
#include "tests/renderer/test_scenes.h"
#include "tests/support/messages.h"

#include <atomic>
#include <cstring>

namespace encore::renderer::test {
namespace {

using accel::StructureKind;
using encore::test::contains;
using scene::RayKind;
using scene::RaySettings;

constexpr RaySettings kAllRays{
    .shadows = true, .reflections = true, .refractions = true, .depth = 5, .samples = 2};

class GpuPathPictures : public encore::test::GlTest {
 protected:
  /// Both tracers' picture and ray counts of a scene; returns the device's counts.
  RayFigures expect_cpu_picture(const GpuTestScene& setup, const RaySettings& rays, int width,
                                int height, const std::string& what) {
    GpuTracer gpu(context_);
    CpuTracer cpu(2);
    for (Tracer* tracer : {static_cast<Tracer*>(&gpu), static_cast<Tracer*>(&cpu)}) {
      tracer->set_rays(rays);
      tracer->init(setup.input());
    }
    return expect_same(gpu, cpu, setup.scene.camera, width, height, what);
  }

  static RayFigures expect_same(GpuTracer& gpu, CpuTracer& cpu, const scene::Camera& camera,
                                int width, int height, const std::string& what) {
    gpu.draw(camera, width, height);
    cpu.draw(camera, width, height);
    EXPECT_TRUE(gpu.complete()) << what;
    expect_within_bound(picture_of(gpu), picture_of(cpu), what);
    expect_same_rays(gpu.last_rays(), cpu.last_rays(), what);
    return gpu.last_rays().value_or(RayFigures{});
  }

  static Image picture_of(Renderer& renderer) {
    Image image;
    renderer.read(image);
    return image;
  }

  /// One drawn on the device.
  static Image drawn(GpuTracer& gpu, const GpuTestScene& setup, int width, int height) {
    gpu.draw(setup.scene.camera, width, height);
    return picture_of(gpu);
  }

  static void expect_same_bits(const Image& found, const Image& expected, const char* what) {
    ASSERT_EQ(found.pixels.size(), expected.pixels.size()) << what;
    EXPECT_EQ(std::memcmp(found.pixels.data(), expected.pixels.data(),
                          expected.pixels.size() * sizeof(glm::vec3)),
              0)
        << what;
  }
};

class GpuPathKinds : public GpuPathPictures, public testing::WithParamInterface<StructureKind> {};

TEST_P(GpuPathKinds, AllRaysTogetherAreThoseOfTheCpu) {
  for (const char* name : {"toys", "cow"}) {
    const auto setup = shiny_scene(name, GetParam());
    add_textures(*setup);
    const RayFigures rays = expect_cpu_picture(*setup, kAllRays, 61, 43, name);
    for (const auto& kind : rays.kinds) {
      EXPECT_GT(kind.rays, 100U) << name;
      EXPECT_EQ(kind.seconds.has_value(), context_->capabilities().timestamp_bits > 0);
      EXPECT_GT(kind.seconds.value_or(1.0), 0.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, GpuPathKinds,
                         testing::Values(StructureKind::bvh_median, StructureKind::bvh_sah,
                                         StructureKind::grid_box, StructureKind::kd_sah),
                         kind_name);

TEST_F(GpuPathPictures, EachKindOfRayAloneIsThatOfTheCpu) {
  const auto setup = shiny_scene("toys", StructureKind::bvh_median);
  const auto count = [&](const RaySettings& rays, RayKind kind, const char* what) {
    return expect_cpu_picture(*setup, rays, 61, 43, what)[kind].rays;
  };
  EXPECT_GT(count({.shadows = true}, RayKind::shadow, "shadows"), 0U);
  EXPECT_GT(count({.reflections = true, .depth = 3}, RayKind::reflection, "mirrors"), 0U);
  EXPECT_GT(count({.refractions = true, .depth = 1}, RayKind::refraction, "glass"), 0U);
  EXPECT_EQ(count({.samples = 4, .seed = 7}, RayKind::camera, "samples"), 4U * 61U * 43U);
  setup->scene.camera.orthographic_height = 30.0F;
  EXPECT_EQ(count({.samples = 3}, RayKind::camera, "orthographic"), 3U * 61U * 43U);
  add_textures(*setup);
  EXPECT_EQ(count({}, RayKind::camera, "textures"), 61U * 43U);
  // Where no light shines surfaces still mirror, by their shading normals.
  setup->scene.lights.clear();
  for (auto& material : setup->scene.materials) material.emission = material.diffuse;
  EXPECT_GT(count({.shadows = true, .reflections = true, .refractions = true}, RayKind::refraction,
                  "no light"),
            0U);
}

TEST_F(GpuPathPictures, AMirrorBeforeAWallShowsWhatIsComputedByHand) {
  // A mirror of half the light before a glowing wall, seen straight on: the wall's own glow comes
  // back from the mirror by halves.
  auto setup = std::make_unique<GpuTestScene>();
  setup->scene.camera = {.eye = {0.3F, 0.2F, 1.0F}, .target = {0.3F, 0.2F, 0.0F}};
  setup->scene.materials.resize(2);
  for (auto& material : setup->scene.materials) material.ambient = glm::vec3(0.0F);
  setup->scene.materials[0].reflectivity = 0.5F;
  setup->scene.materials[0].emission = {1.0F, 0.0F, 0.0F};
  setup->scene.materials[1].emission = {0.0F, 2.0F, 0.5F};
  add_square(setup->list, 5.0F, 0.0F, 0);
  add_square(setup->list, 5.0F, 3.0F, 1);
  setup->structure = accel::make_structure(spec_of(StructureKind::bvh_median));
  setup->structure->build(setup->list.triangles);
  GpuTracer gpu(context_);
  gpu.set_rays({.reflections = true});
  gpu.init(setup->input());
  const Image image = drawn(gpu, *setup, 9, 9);
  for (const glm::vec3& pixel : image.pixels) {
    EXPECT_NEAR(pixel.r, 0.5, 1e-6);
    EXPECT_NEAR(pixel.g, 1.0, 1e-6);
    EXPECT_NEAR(pixel.b, 0.25, 1e-6);
  }
  EXPECT_EQ((*gpu.last_rays())[RayKind::reflection].rays, 81U);
}

TEST_F(GpuPathPictures, TheRasteriserDrawsTexturesToo) {
  auto setup = std::make_unique<GpuTestScene>();
  setup->scene.camera = {.eye = {0.2F, 0.1F, 3.0F}, .target = {0.0F, 0.0F, 0.0F}};
  setup->scene.lights.push_back({.position = {1.0F, 2.0F, 3.0F}, .color = glm::vec3(1.0F)});
  setup->scene.materials.resize(2);
  add_square(setup->list, 4.0F, 0.0F, 1);
  add_textures(*setup);
  setup->structure = accel::make_structure(spec_of(StructureKind::bvh_median));
  setup->structure->build(setup->list.triangles);
  RasterRenderer raster(context_);
  CpuTracer cpu(1);
  for (const bool textures : {true, false}) {
    for (Renderer* renderer : {static_cast<Renderer*>(&raster), static_cast<Renderer*>(&cpu)}) {
      renderer->set_rays({.textures = textures});
      renderer->init(setup->input());
      renderer->draw(setup->scene.camera, 40, 30);
    }
    const Image expected = picture_of(cpu);
    const Image found = picture_of(raster);
    // Where a pixel lies on the square is known less exactly here than in the tracers.
    for (std::size_t i = 0; i < found.pixels.size(); ++i) {
      ASSERT_LT(glm::length(found.pixels[i] - expected.pixels[i]), 2e-3F) << i;
    }
  }
}

TEST_F(GpuPathPictures, PartsOfTheSamplesMakeUpThePicture) {
  const auto setup = shiny_scene("toys", StructureKind::bvh_median);
  GpuTracer gpu(context_);
  gpu.set_rays({.shadows = true, .reflections = true, .samples = 4});
  gpu.init(setup->input());
  const Image whole = drawn(gpu, *setup, 33, 21);
  Image sum;
  sum.resize(33, 21);
  for (const std::uint32_t first : {2U, 0U}) {
    gpu.draw_samples(setup->scene.camera, 33, 21, first, 2);
    const Image half = picture_of(gpu);
    EXPECT_NE(half.pixels, whole.pixels);
    for (std::size_t i = 0; i < half.pixels.size(); ++i) sum.pixels[i] += 0.5F * half.pixels[i];
  }
  EXPECT_EQ(compare(sum, whole).far, 0U);
  EXPECT_THROW(gpu.draw_samples(setup->scene.camera, 33, 21, 3, 2), std::invalid_argument);
}

TEST_F(GpuPathPictures, RaysTakeEffectWithTheNextRefreshAndLeaveNothingBehind) {
  const auto setup = shiny_scene("toys", StructureKind::bvh_median);
  GpuTracer gpu(context_);
  CpuTracer cpu(2);
  gpu.init(setup->input());
  cpu.init(setup->input());
  const Image plain = drawn(gpu, *setup, 40, 30);
  gpu.set_rays(kAllRays);
  cpu.set_rays(kAllRays);
  expect_same_bits(drawn(gpu, *setup, 40, 30), plain, "before the refresh");
  gpu.refresh();
  cpu.refresh();
  expect_same(gpu, cpu, setup->scene.camera, 40, 30, "after it");
  // More of the same kind of ray.
  for (Tracer* tracer : {static_cast<Tracer*>(&gpu), static_cast<Tracer*>(&cpu)}) {
    tracer->set_rays({.reflections = true, .refractions = true, .depth = 12});
    tracer->refresh();
  }
  expect_same(gpu, cpu, setup->scene.camera, 40, 30, "deeper");
  gpu.set_rays({});
  gpu.refresh();
  expect_same_bits(drawn(gpu, *setup, 40, 30), plain, "without again");
  EXPECT_EQ((*gpu.last_rays())[RayKind::camera].rays, 1200U);
  EXPECT_EQ(gpu.last_rays()->rays(), 1200U);
}

TEST_F(GpuPathPictures, BandsOfFewRowsMakeTheSamePicture) {
  const auto setup = shiny_scene("cow", StructureKind::bvh_median);
  for (auto& part : setup->scene.lights) part.color *= 0.5F;
  Image expected;
  Image found;
  for (Image* image : {&expected, &found}) {
    // The nodes of this scene take 370 KiB; a row's stacks 17 KiB.
    GpuTracer gpu(image == &expected ? context_
                                     : std::make_shared<SmallDevice>(context_, 400U << 10));
    gpu.set_rays({.shadows = true, .reflections = true, .refractions = true, .depth = 6});
    gpu.init(setup->input());
    *image = drawn(gpu, *setup, 60, 47);
  }
  expect_same_bits(found, expected, "bands");
}

TEST_F(GpuPathPictures, WhatDoesNotFitIsNamed) {
  const auto setup = scene_of(accel::test::soup(20, 5.0F, 1), spec_of(StructureKind::bvh_median));
  setup->scene.materials.resize(2);
  setup->scene.materials[0].reflectivity = 1.0F;
  const auto device = std::make_shared<SmallDevice>(context_, 8000);
  GpuTracer gpu(device);
  gpu.set_rays({.reflections = true, .depth = 16});
  gpu.init(setup->input());
  try {
    gpu.draw(setup->scene.camera, 61, 4);
    FAIL() << "nothing was thrown";
  } catch (const gl::GlError& error) {
    EXPECT_TRUE(contains(error.what(), "the rays that wait")) << error.what();
  }
  EXPECT_NO_THROW(gpu.draw(setup->scene.camera, 10, 61));

  device->allow(1U << 20);
  device->allow_blocks(10);
  setup->scene.lights.resize(1);
  add_textures(*setup);
  try {
    gpu.init(setup->input());
    FAIL() << "nothing was thrown";
  } catch (const gl::GlError& error) {
    EXPECT_TRUE(contains(error.what(), "textures take")) << error.what();
  }
  gpu.set_rays({.textures = false});
  EXPECT_NO_THROW(gpu.init(setup->input()));
}

TEST_F(GpuPathPictures, ACancelledOneIsNotComplete) {
  const auto setup = shiny_scene("toys", StructureKind::bvh_median);
  GpuTracer gpu(context_);
  gpu.set_rays(kAllRays);
  gpu.init(setup->input());
  std::atomic<bool> cancel{true};
  gpu.set_cancel_flag(&cancel);
  gpu.draw(setup->scene.camera, 32, 32);
  EXPECT_FALSE(gpu.complete());
  EXPECT_FALSE(gpu.last_draw_s().has_value());
  gpu.set_cancel_flag(nullptr);
  gpu.draw(setup->scene.camera, 32, 32);
  EXPECT_TRUE(gpu.complete());
}

TEST_F(GpuPathPictures, RaysThatMeetThousandsOfBoxesAreFollowedToTheirEnd) {
  // Software devices end loops early, and rays pause: a plate mirrors and is lit through ten
  // thousand triangles in one box, of which the rays meet some and miss others.
  for (const StructureKind kind :
       {StructureKind::bvh_median, StructureKind::grid_box, StructureKind::bvh_sah}) {
    auto setup = std::make_unique<GpuTestScene>();
    setup->list.triangles = accel::test::identical(10000);
    for (auto& triangle : setup->list.triangles) triangle.material = 1;
    add_square(setup->list, 3.0F, -5.0F);
    setup->structure = accel::make_structure(spec_of(kind));
    setup->structure->build(setup->list.triangles);
    setup->scene.camera = {.eye = {0.55F, 0.55F, -1.0F},
                           .target = {0.55F, 0.55F, -5.0F},
                           .vertical_fov_degrees = 8.0F};
    setup->scene.lights.push_back({.position = {0.5F, 0.5F, 6.0F}, .color = glm::vec3(0.8F)});
    setup->scene.materials.resize(2);
    setup->scene.materials[0].reflectivity = 0.5F;
    setup->scene.materials[1].emission = {0.1F, 0.8F, 0.0F};
    setup->scene.background = {0.0F, 0.1F, 0.9F};
    const std::size_t programs = context_->programs().compiled();
    const RayFigures rays = expect_cpu_picture(*setup, {.shadows = true, .reflections = true}, 8, 6,
                                               std::string(accel::to_string(kind)));
    EXPECT_EQ(rays[RayKind::reflection].rays, 48U);
    EXPECT_GE(rays[RayKind::shadow].rays, 48U);
    // Where rays pause both programs that trace are compiled once more.
    if (context_->capabilities().software) {
      EXPECT_GE(context_->programs().compiled() - programs, 2U);
    }
  }
}

}  // namespace
}  // namespace encore::renderer::test
