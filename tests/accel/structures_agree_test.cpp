// Every structure returns the same triangle and the same distance, bit for bit, as brute force, and
// brute force the same as an exact oracle: on every sample scene, for every kind of ray.
#include "accel/brute_force.h"
#include "accel/make_structure.h"
#include "accel/test_rays.h"
#include "accel/verify.h"
#include "scene/sample_scenes.h"
#include "scene/triangles.h"
#include "shaders/shared/bindings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace encore::accel {
namespace {

// Ray-triangle tests that brute force may spend on one structure and ray kind. From far away its
// single-precision filter lets everything pass, so such rays cost ten times as much.
constexpr double kReferenceTests = 1.2e7;

std::size_t ray_count(std::size_t triangles, RayKind kind) {
  const double tests = kind == RayKind::far ? kReferenceTests / 10 : kReferenceTests;
  return static_cast<std::size_t>(
      std::clamp(tests / static_cast<double>(std::max<std::size_t>(triangles, 1)), 20.0, 2000.0));
}

std::string describe(const HitComparison& c) {
  const auto hit = [](const Hit& h) {
    return std::to_string(h.triangle) + " at " + std::to_string(h.t);
  };
  std::ostringstream out;
  out.precision(9);
  out << "missed " << c.missed << ", invented " << c.invented << ", triangle " << c.wrong_triangle
      << ", distance " << c.wrong_distance << ", any-hit " << c.wrong_occlusion
      << "; first: origin " << c.first_ray.origin.x << ' ' << c.first_ray.origin.y << ' '
      << c.first_ray.origin.z << " direction " << c.first_ray.direction.x << ' '
      << c.first_ray.direction.y << ' ' << c.first_ray.direction.z << " expected "
      << hit(c.first_expected) << " found " << hit(c.first_found);
  return out.str();
}

void expect_agreement(const AccelerationStructure& structure, std::span<const Triangle> triangles,
                      std::uint64_t seed, const std::string& what) {
  BruteForce brute;
  brute.build(triangles);
  for (const RayKind kind : all_ray_kinds()) {
    const auto rays =
        test_rays(kind, ray_count(triangles.size(), kind), seed, triangles, structure);
    const HitComparison comparison = compare_hits(structure, brute, rays);
    EXPECT_EQ(comparison.mismatches(), 0U)
        << what << ", " << to_string(kind) << " rays: " << describe(comparison);
  }
}

class EverySampleScene : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    scene_ = scene::make_sample_scene(GetParam()).value();
    scene::update_triangles(scene_, 0.0, list_);
  }
  scene::Scene scene_;
  scene::TriangleList list_;
};

TEST_P(EverySampleScene, GivesTheSameHitsWithEveryStructure) {
  for (const StructureKind kind : all_structure_kinds()) {
    const auto structure = make_structure(default_spec(kind));
    structure->build(list_.triangles);
    expect_agreement(*structure, list_.triangles, 1, std::string(to_string(kind)));
  }
}

class EveryMovingScene : public EverySampleScene {};

TEST_P(EveryMovingScene, GivesTheSameHitsAfterRefittingAndAfterRebuilding) {
  for (const StructureKind kind : all_structure_kinds()) {
    const auto structure = make_structure(default_spec(kind));
    scene::TriangleList moving = list_;
    structure->build(moving.triangles);
    for (const double share : {0.25, 0.6}) {
      if (scene::update_triangles(scene_, share * scene_.duration_s(), moving) ==
          scene::TriangleChange::moved) {
        structure->update(moving.triangles);
      } else {
        structure->build(moving.triangles);
      }
      expect_agreement(*structure, moving.triangles, 2, std::string(to_string(kind)) + " updated");
    }
  }
}

TEST_P(EverySampleScene, BruteForceAgreesWithTheExactOracle) {
  BruteForce brute;
  brute.build(list_.triangles);
  for (const RayKind kind : all_ray_kinds()) {
    const std::size_t count =
        std::max<std::size_t>(ray_count(list_.triangles.size(), kind) / 10, 10);
    const auto rays = test_rays(kind, count, 3, list_.triangles, brute);
    const OracleComparison comparison = compare_with_oracle(brute, list_.triangles, rays);
    EXPECT_EQ(comparison.hits.mismatches(), 0U)
        << to_string(kind) << " rays: " << describe(comparison.hits);
    // Ties and rounding edges are rare except for rays that are aimed at edges.
    if (kind != RayKind::edge && kind != RayKind::plane && kind != RayKind::axis) {
      EXPECT_LE(comparison.edge_cases, rays.size() / 20) << to_string(kind);
    }
  }
}

std::vector<std::string> sample_names(bool only_moving) {
  std::vector<std::string> names;
  for (const scene::SampleScene& sample : scene::sample_scenes()) {
    if (!only_moving || sample.animation != "static") names.push_back(sample.name);
  }
  return names;
}

std::string test_name(const testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Samples, EverySampleScene, testing::ValuesIn(sample_names(false)),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Samples, EveryMovingScene, testing::ValuesIn(sample_names(true)),
                         test_name);

class EveryStructure : public testing::TestWithParam<StructureKind> {};

TEST_P(EveryStructure, IsIndifferentToScale) {
  const scene::Scene scene = scene::make_sample_scene("wheel").value();
  scene::TriangleList list;
  scene::update_triangles(scene, 0.0, list);
  for (const float scale : {1e-18F, 1e-6F, 1e6F, 1e17F}) {
    std::vector<Triangle> scaled = list.triangles;
    for (Triangle& t : scaled) {
      t.v0 *= scale;
      t.v1 *= scale;
      t.v2 *= scale;
    }
    const auto structure = make_structure(default_spec(GetParam()));
    structure->build(scaled);
    expect_agreement(*structure, scaled, 4, "scale " + std::to_string(std::log10(scale)));
  }
}

TEST_P(EveryStructure, WorksFarFromTheOrigin) {
  const scene::Scene scene = scene::make_sample_scene("wheel").value();
  scene::TriangleList list;
  scene::update_triangles(scene, 0.0, list);
  for (const float offset : {1e3F, 1e6F}) {
    std::vector<Triangle> moved = list.triangles;
    for (Triangle& t : moved) {
      t.v0 += offset;
      t.v1 += offset;
      t.v2 += offset;
    }
    const auto structure = make_structure(default_spec(GetParam()));
    structure->build(moved);
    expect_agreement(*structure, moved, 5, "offset " + std::to_string(offset));
  }
}

TEST_P(EveryStructure, HitsNothingInAnEmptyScene) {
  const auto structure = make_structure(default_spec(GetParam()));
  for (int round = 0; round < 2; ++round) {
    structure->build({});
    const std::vector<Ray> rays{{{0, 0, 5}, 0, {0, 0, -1}}, {{0, 0, 0}, 0, {1, 0, 0}}};
    std::vector<Hit> hits(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    structure->intersect(rays, hits);
    structure->occluded(rays, blocked);
    EXPECT_FALSE(hits[0].found() || hits[1].found() || blocked[0] || blocked[1]);
    EXPECT_EQ(structure->stats().triangles, 0U);
    structure->visit([](const NodeView&) { return true; });
    structure->update({});
  }
}

TEST_P(EveryStructure, AllocatesNothingInASecondPooledBuild) {
  const scene::Scene scene = scene::make_sample_scene("mug").value();
  scene::TriangleList list;
  scene::update_triangles(scene, 0.0, list);
  StructureSpec spec = default_spec(GetParam());
  spec.memory = MemoryMode::pool;
  const auto pooled = make_structure(spec);
  pooled->build(list.triangles);
  pooled->build(list.triangles);
  EXPECT_EQ(pooled->stats().allocations, 0U);
  EXPECT_EQ(pooled->stats().allocated_bytes, 0U);
  if (GetParam() == StructureKind::brute) return;
  spec.memory = MemoryMode::fresh;
  const auto fresh = make_structure(spec);
  fresh->build(list.triangles);
  const BuildStats first = fresh->stats();
  EXPECT_GT(first.allocations, 0U);
  fresh->build(list.triangles);
  EXPECT_EQ(fresh->stats().allocations, first.allocations);
  EXPECT_EQ(fresh->stats().allocated_bytes, first.allocated_bytes);
}

TEST_P(EveryStructure, BuildsTheSameThingTwice) {
  const scene::Scene scene = scene::make_sample_scene("cow").value();
  scene::TriangleList list;
  scene::update_triangles(scene, 0.0, list);
  const auto first = make_structure(default_spec(GetParam()));
  const auto second = make_structure(default_spec(GetParam()));
  first->build(list.triangles);
  second->build(list.triangles);
  second->build(list.triangles);
  const GpuBuffers a = first->gpu_buffers();
  const GpuBuffers b = second->gpu_buffers();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].binding, b[i].binding);
    ASSERT_EQ(a[i].bytes.size(), b[i].bytes.size());
    EXPECT_TRUE(std::equal(a[i].bytes.begin(), a[i].bytes.end(), b[i].bytes.begin()));
  }
}

TEST_P(EveryStructure, CountsItsVersions) {
  const scene::Scene scene = scene::make_sample_scene("mug").value();
  scene::TriangleList list;
  scene::update_triangles(scene, 0.0, list);
  const auto structure = make_structure(default_spec(GetParam()));
  EXPECT_EQ(structure->version(), 0U);
  structure->build(list.triangles);
  const std::uint64_t built = structure->version();
  EXPECT_GT(built, 0U);
  structure->update(list.triangles);
  EXPECT_GT(structure->version(), built);
}

TEST_P(EveryStructure, TellsTheGpuWhatItsBuffersDoNot) {
  const scene::Scene scene = scene::make_sample_scene("cow").value();
  scene::TriangleList list;
  scene::update_triangles(scene, 0.0, list);
  const auto structure = make_structure(default_spec(GetParam()));
  EXPECT_EQ(structure->gpu_parameters().references, 0U);
  structure->build(list.triangles);
  const gpu::StructureParameters parameters = structure->gpu_parameters();
  const BuildStats stats = structure->stats();
  if (GetParam() == StructureKind::brute) {
    EXPECT_EQ(parameters.references, 0U) << "it has no traversal there";
    return;
  }
  // The array's length, which may count lanes that a leaf fills up.
  std::uint64_t references = stats.references;
  for (const GpuBuffer& buffer : structure->gpu_buffers()) {
    if (buffer.binding == ENCORE_BINDING_REFERENCES) references = buffer.bytes.size() / 4;
  }
  EXPECT_EQ(parameters.references, references);
  EXPECT_GE(parameters.references, stats.references);
  EXPECT_EQ(parameters.depth, stats.max_depth);
  const Bounds bounds = list.bounds();
  EXPECT_EQ(parameters.min, bounds.min);
  EXPECT_EQ(parameters.max, bounds.max);
  EXPECT_EQ(parameters.cells.x, stats.grid_size[0]);
  EXPECT_EQ(parameters.cells.y, stats.grid_size[1]);
  EXPECT_EQ(parameters.cells.z, stats.grid_size[2]);
}

INSTANTIATE_TEST_SUITE_P(Structures, EveryStructure, testing::ValuesIn(all_structure_kinds()),
                         [](const auto& test) {
                           std::string name(to_string(test.param));
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace encore::accel
