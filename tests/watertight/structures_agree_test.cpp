// In the watertight mode every structure returns the same hits, bit for bit, as brute force in that
// mode, and the same triangles as brute force in the precise mode; rays of all kinds, scenes of all
// kinds.
#include "accel/brute_force.h"
#include "accel/make_structure.h"
#include "accel/test_rays.h"
#include "accel/verify.h"
#include "scene/sample_scenes.h"
#include "scene/triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace encore::accel {
namespace {

std::vector<Triangle> sample(const char* name, float scale = 1.0F, float offset = 0.0F) {
  const scene::Scene scene = scene::make_sample_scene(name).value();
  scene::TriangleList list;
  scene::update_triangles(scene, 0.0, list);
  for (Triangle& t : list.triangles) {
    for (glm::vec3* p : {&t.v0, &t.v1, &t.v2}) *p = *p * scale + offset;
  }
  return list.triangles;
}

class EveryStructure : public testing::TestWithParam<StructureKind> {
 protected:
  /// All kinds of rays against brute force in both modes.
  static void expect_agreement(const std::vector<Triangle>& triangles, const std::string& what) {
    BruteForce precise;
    precise.build(triangles);
    BruteForce watertight;
    watertight.set_intersection(IntersectionMode::watertight);
    watertight.build(triangles);
    StructureSpec spec = default_spec(GetParam());
    spec.intersection = IntersectionMode::watertight;
    const auto structure = make_structure(spec);
    structure->build(triangles);
    const std::size_t count = std::clamp<std::size_t>(400'000 / triangles.size(), 20, 500);
    for (const RayKind kind : all_ray_kinds()) {
      const auto rays = test_rays(kind, count, 7, triangles, *structure);
      EXPECT_EQ(compare_hits(*structure, watertight, rays).mismatches(), 0U)
          << what << ", " << to_string(kind) << " rays, bit for bit";
      EXPECT_EQ(compare_hits(*structure, precise, rays).mismatches(), 0U)
          << what << ", " << to_string(kind) << " rays, against the precise mode";
    }
  }
};

TEST_P(EveryStructure, FindsTheSameTrianglesInTheWatertightMode) {
  for (const char* name : {"wheel", "mug", "cow"}) expect_agreement(sample(name), name);
}

TEST_P(EveryStructure, DoesSoAtEveryScaleAndFarFromTheOrigin) {
  for (const float scale : {1e-18F, 1e17F}) {
    expect_agreement(sample("wheel", scale), "scale " + std::to_string(scale));
  }
  expect_agreement(sample("wheel", 1.0F, 1e5F), "offset");
}

// Coincident triangles in all orders: which one is hit must not depend on what a structure tests
// first.
TEST_P(EveryStructure, TakesTheLowestOfCoincidentTriangles) {
  std::vector<Triangle> triangles = sample("wheel");
  const std::size_t once = triangles.size();
  for (std::size_t i = once; i-- > 0;) triangles.push_back(triangles[i]);
  for (std::size_t i = 0; i < once; ++i) {
    Triangle t = triangles[i];
    std::swap(t.v0, t.v1);
    triangles.push_back(t);
  }
  expect_agreement(triangles, "three of each");
}

TEST_P(EveryStructure, AgreesWithBruteForceOnMollerTrumboresHits) {
  const std::vector<Triangle> triangles = sample("cow");
  StructureSpec spec = default_spec(GetParam());
  spec.intersection = IntersectionMode::moller_trumbore;
  const auto structure = make_structure(spec);
  structure->build(triangles);
  BruteForce brute;
  brute.set_intersection(IntersectionMode::moller_trumbore);
  brute.build(triangles);
  const auto rays = test_rays(RayKind::outside, 500, 8, triangles, *structure);
  const HitComparison comparison = compare_hits(*structure, brute, rays);
  EXPECT_EQ(comparison.mismatches(), 0U);
  EXPECT_GT(comparison.hits, 50U);
}

// What the inspector shows of a ray is what the mode does.
TEST_P(EveryStructure, RecordsTheHitsOfItsMode) {
  const std::vector<Triangle> triangles = sample("mug");
  const auto structure = make_structure(default_spec(GetParam()));
  structure->build(triangles);
  const auto rays = test_rays(RayKind::outside, 50, 9, triangles, *structure);
  for (const IntersectionMode mode : all_intersection_modes()) {
    structure->set_intersection(mode);
    std::vector<Hit> hits(rays.size());
    structure->intersect(rays, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      Hit hit;
      RayPath path;
      structure->trace_path(rays[i], hit, path);
      EXPECT_EQ(hit.triangle, hits[i].triangle);
      EXPECT_EQ(hit.t, hits[i].t);
      const bool shown = std::any_of(path.steps.begin(), path.steps.end(), [&](const RayStep& s) {
        return s.event == RayStep::Event::triangle && s.triangle == hit.triangle &&
               s.enter == hit.t;
      });
      EXPECT_TRUE(shown || !hit.found()) << to_string(mode);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Structures, EveryStructure, testing::ValuesIn(all_structure_kinds()),
                         [](const auto& test) {
                           std::string name(to_string(test.param));
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace encore::accel
