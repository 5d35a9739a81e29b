// The GPU's hits are those of the structure on the CPU, bit for bit, for rays of every kind.
#include "accel/test_rays.h"
#include "tests/bvh/test_scenes.h"
#include "tests/gpu/gpu_scenes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace encore::renderer::test {
namespace {

using accel::StructureKind;

/// Each kind of structure in turn, on a tracer of its own.
class GpuHits : public encore::test::GlTest, public testing::WithParamInterface<StructureKind> {
 protected:
  /// Expects agreement for rays of all kinds.
  void expect_agreement(GpuTracer& tracer, const GpuTestScene& setup, std::size_t rays_a_kind,
                        const std::string& what) {
    tracer.init(setup.input());
    for (const accel::RayKind kind : accel::all_ray_kinds()) {
      const auto rays =
          accel::test_rays(kind, rays_a_kind, 7, setup.list.triangles, *setup.structure);
      expect_structure_hits(tracer, *setup.structure, rays,
                            what + ", " + std::string(accel::to_string(kind)));
    }
  }
};

TEST_P(GpuHits, AreThoseOfTheCpuOnHostileScenes) {
  GpuTracer tracer(context_);
  for (auto& [name, triangles] : accel::test::all_test_scenes()) {
    const auto setup = scene_of(std::move(triangles), spec_of(GetParam()));
    expect_agreement(tracer, *setup, 250, name);
  }
}

TEST_P(GpuHits, AreThoseOfTheCpuAtEveryScale) {
  GpuTracer tracer(context_);
  const auto base = accel::test::soup(200, 2.0F, 53);
  for (int exponent = -60; exponent <= 60; exponent += 30) {
    const float scale = std::ldexp(1.0F, exponent);
    const auto setup = scene_of(encore::test::scaled(base, scale), spec_of(GetParam()));
    expect_agreement(tracer, *setup, 250, "scale 2^" + std::to_string(exponent));
  }
}

TEST_P(GpuHits, AreThoseOfTheCpuFromTheCamera) {
  GpuTracer tracer(context_);
  for (const char* name : {"triangle", "scissors", "toys"}) {
    const auto setup = sample_scene(name, spec_of(GetParam()));
    tracer.init(setup->input());
    for (const auto& [width, height] : {std::pair{48, 48}, {37, 53}, {1, 1}, {3, 1}}) {
      expect_camera_hits(tracer, *setup, width, height, name);
    }
  }
}

TEST_P(GpuHits, AreThoseOfTheCpuInOrthographicViews) {
  GpuTracer tracer(context_);
  for (const char* name : {"triangle", "scissors", "toys"}) {
    const auto setup = sample_scene(name, spec_of(GetParam()));
    tracer.init(setup->input());
    const scene::Bounds box = setup->list.bounds();
    const float size = glm::length(box.size());
    // From outside along an axis, from outside askew, and from the middle, which cuts the scene.
    for (const glm::vec3 offset :
         {glm::vec3(0, 0, 2), glm::vec3(0.7F, 0.9F, -1.3F), glm::vec3(0)}) {
      setup->scene.camera.eye = box.center() + offset * size;
      setup->scene.camera.target =
          box.center() + offset * size * 0.3F - glm::vec3(0, 0, 0.1F) * size;
      setup->scene.camera.orthographic_height = 0.6F * size;
      const auto hits = expect_camera_hits(tracer, *setup, 37, 53, name);
      EXPECT_TRUE(std::any_of(hits.begin(), hits.end(), [](const auto& h) { return h.found(); }));
    }
    // Back to perspective with the same tracer.
    setup->scene.camera.orthographic_height = 0.0F;
    expect_camera_hits(tracer, *setup, 16, 16, name);
  }
}

TEST_P(GpuHits, AreThoseOfTheCpuInOrthographicViewsAtEveryScale) {
  GpuTracer tracer(context_);
  const auto base = accel::test::soup(200, 2.0F, 53);
  for (int exponent = -60; exponent <= 60; exponent += 30) {
    const float scale = std::ldexp(1.0F, exponent);
    const auto setup = scene_of(encore::test::scaled(base, scale), spec_of(GetParam()));
    tracer.init(setup->input());
    setup->scene.camera = {.eye = glm::vec3(9.0F, 4.0F, 7.0F) * scale,
                           .target = glm::vec3(0.5F) * scale,
                           .orthographic_height = 5.0F * scale};
    expect_camera_hits(tracer, *setup, 31, 29, "scale 2^" + std::to_string(exponent));
  }
}

TEST_P(GpuHits, AreThoseOfTheCpuForALongBatchOfOddLength) {
  // More than one batch of 256 Ki rays, the last one short and its last row too.
  const auto setup = scene_of(accel::test::soup(12, 6.0F, 3), spec_of(GetParam()));
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  auto rays =
      accel::test_rays(accel::RayKind::outside, 7001, 9, setup->list.triangles, *setup->structure);
  const std::vector<scene::Ray> some = rays;
  while (rays.size() < (std::size_t{256} << 10)) rays.insert(rays.end(), some.begin(), some.end());
  rays.resize((std::size_t{256} << 10) + 5003);
  std::copy(some.begin(), some.begin() + 5003, rays.end() - 5003);
  expect_structure_hits(tracer, *setup->structure, rays, "a long batch");
}

TEST_P(GpuHits, AreThoseOfTheCpuForAPictureFetchedInParts) {
  // More than 16 MiB of hits; the last part is a short one.
  const auto setup = scene_of(accel::test::soup(1, 20.0F, 3), spec_of(GetParam()));
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  expect_camera_hits(tracer, *setup, 2047, 521, "parts");
}

TEST_P(GpuHits, ARayThatMeetsSeventyThousandTrianglesIsFollowedToItsEnd) {
  // Software rasterisers end loops after 65,535 rounds without a word.
  constexpr std::uint32_t kCount = 70000;
  auto triangles = accel::test::identical(kCount);
  // In the very box of the others, before them, and the last to be looked at.
  triangles.back() = scene::make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0.5F});
  const auto setup = scene_of(std::move(triangles), spec_of(GetParam()));
  setup->scene.camera = {
      .eye = {0.25F, 0.3F, -4.0F}, .target = {0.25F, 0.3F, 0.0F}, .vertical_fov_degrees = 5.0F};
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  const std::vector<scene::Hit> found = expect_camera_hits(tracer, *setup, 5, 3, "hits");
  EXPECT_EQ(found[7].triangle, kCount - 1);

  std::vector<accel::TraceCounters> costs;
  std::vector<accel::TraceCounters> cpu_costs;
  tracer.trace_counters(setup->scene.camera, 5, 3, costs);
  CpuTracer cpu(1);
  cpu.init(setup->input());
  cpu.trace_counters(setup->scene.camera, 5, 3, cpu_costs);
  EXPECT_GE(costs[7].triangle_tests, kCount);
  EXPECT_EQ(costs[7].triangle_tests, cpu_costs[7].triangle_tests);
  EXPECT_EQ(costs[7].steps, cpu_costs[7].steps);
}

TEST_P(GpuHits, AnEmptySceneHasNone) {
  const auto setup = scene_of({}, spec_of(GetParam()));
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<scene::Ray> rays{{{0, 0, 5}, 0, {0, 0, -1}}, {{0, 0, 0}, 0, {1, 0, 0}, 2.5F}};
  std::vector<scene::Hit> hits(2, {nan, 7, nan, nan});
  tracer.trace_rays(rays, hits);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_FALSE(hits[i].found());
    EXPECT_EQ(hits[i].t, rays[i].t_max);
  }
  tracer.trace_rays({}, {});
}

INSTANTIATE_TEST_SUITE_P(Kinds, GpuHits, testing::ValuesIn(gpu_kinds()), kind_name);

using GpuDeepTrees = encore::test::GlTest;

TEST_F(GpuDeepTrees, ABvhOfHundredsOfLevelsIsWalkedToItsEnd) {
  const auto setup = scene_of(accel::test::one_a_level(500), spec_of(StructureKind::bvh_median));
  ASSERT_GT(setup->structure->gpu_parameters().depth, 200U);
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  for (const accel::RayKind kind : accel::all_ray_kinds()) {
    const auto rays = accel::test_rays(kind, 800, 8, setup->list.triangles, *setup->structure);
    expect_structure_hits(tracer, *setup->structure, rays, std::string(accel::to_string(kind)));
  }
}

TEST_F(GpuDeepTrees, AWideTreeOfManyLevelsIsWalkedToItsEndInEveryPreset) {
  for (const auto preset :
       {accel::BuildPreset::fast, accel::BuildPreset::balanced, accel::BuildPreset::best}) {
    const auto setup = scene_of(
        accel::test::one_a_level(500),
        {.kind = StructureKind::bvh_sah, .settings = accel::BvhSettings{.preset = preset}});
    GpuTracer tracer(context_);
    tracer.init(setup->input());
    for (const accel::RayKind kind : accel::all_ray_kinds()) {
      const auto rays = accel::test_rays(kind, 300, 8, setup->list.triangles, *setup->structure);
      expect_structure_hits(tracer, *setup->structure, rays, std::string(accel::to_string(kind)));
    }
  }
}

TEST_F(GpuDeepTrees, AKdTreeDeeperThanThirtyTwoIsWalkedToItsEnd) {
  for (const StructureKind kind : {StructureKind::kd_median, StructureKind::kd_sah}) {
    accel::KdTreeSettings settings;
    settings.depth_offset = 60.0F;
    settings.leaf_triangles = 1;
    settings.bad_split_retries = 100;
    settings.empty_bonus = 0.9F;
    // Each triangle a quarter nearer to the origin than the last: one or two levels for each.
    std::vector<scene::Triangle> triangles;
    for (int k = 0; k < 60; ++k) {
      const float s = std::ldexp(1.0F, -2 * k / 3);
      triangles.push_back(scene::make_triangle({s, 0.1F * s, 0.2F * s}, {0.8F * s, s, 0.1F * s},
                                               {0.9F * s, 0.3F * s, s}));
    }
    const auto setup = scene_of(std::move(triangles), {.kind = kind, .settings = settings});
    ASSERT_GT(setup->structure->gpu_parameters().depth, 32U) << accel::to_string(kind);
    GpuTracer tracer(context_);
    tracer.init(setup->input());
    for (const accel::RayKind rays_of : accel::all_ray_kinds()) {
      const auto rays = accel::test_rays(rays_of, 150, 8, setup->list.triangles, *setup->structure);
      expect_structure_hits(tracer, *setup->structure, rays,
                            std::string(accel::to_string(rays_of)));
    }
  }
}

TEST_F(GpuDeepTrees, ATreeThatGrowsOutOfItsStackGetsALargerOne) {
  const auto setup = scene_of(accel::test::soup(40, 1.0F, 5), spec_of(StructureKind::bvh_median));
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  setup->move_to(accel::test::one_a_level(500));
  ++setup->list.topology_version;
  setup->structure->build(setup->list.triangles);
  tracer.refresh();
  const auto rays =
      accel::test_rays(accel::RayKind::inside, 2000, 4, setup->list.triangles, *setup->structure);
  expect_structure_hits(tracer, *setup->structure, rays, "after growing");
}

}  // namespace
}  // namespace encore::renderer::test
