// A kd-tree returns the same hit as brute force, bit for bit: on hostile geometry, at every scale,
// for rays through its own planes, plane crossings and node corners.
#include "accel/kdtree/kdtree.h"
#include "kd_scenes.h"
#include "tests/support/oracle_hits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace encore::accel {
namespace {

using encore::test::bounds_of_all;
using encore::test::expect_oracle_hits;
using kd_test::Random;

using kd_test::nodes_of;

class KdTreeHits : public testing::TestWithParam<StructureKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, KdTreeHits, kd_test::kKinds, kd_test::kind_name);

glm::vec3 inside(Random& random, const Bounds& b) {
  return {random.between(b.min.x, b.max.x), random.between(b.min.y, b.max.y),
          random.between(b.min.z, b.max.z)};
}

glm::vec3 vertex_of(Random& random, std::span<const Triangle> triangles) {
  const Triangle& t = triangles[random.below(static_cast<std::uint32_t>(triangles.size()))];
  const glm::vec3 vertices[3] = {t.v0, t.v1, t.v2};
  return vertices[random.below(3)];
}

/// Random rays: from inside, around and far away, at points and vertices, some limited, some with
/// zeroed components of either sign.
std::vector<Ray> mixed_rays(std::span<const Triangle> triangles, std::size_t count,
                            std::uint32_t seed) {
  Random random(seed);
  const Bounds box = bounds_of_all(triangles);
  const glm::vec3 size = box.size();
  const float radius = std::max({size.x, size.y, size.z});
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const glm::vec3 aim = random.below(2) ? inside(random, box) : vertex_of(random, triangles);
    glm::vec3 origin = random.below(3) ? inside(random, box) : vertex_of(random, triangles);
    const float reach[4] = {0.0F, 2.0F, 100.0F, 1e6F};
    origin += random.point(1.0F) * (radius * reach[random.below(4)]);
    Ray ray{origin, 0.0F, aim - origin};
    ray.direction /= std::max({std::fabs(ray.direction.x), std::fabs(ray.direction.y),
                               std::fabs(ray.direction.z), radius * 1e-6F});
    if (random.below(4) == 0) {
      const int axis = static_cast<int>(random.below(3));
      ray.direction[axis] = random.below(2) ? 0.0F : -0.0F;
      ray.origin[axis] = aim[axis];
    }
    if (random.below(4) == 0) {
      ray.t_min = radius * random.between(0.0F, 2.0F);
      ray.t_max = ray.t_min + radius * random.between(0.0F, 2.0F);
    }
    if (ray.direction != glm::vec3(0.0F)) rays.push_back(ray);
  }
  return rays;
}

/// Rays in and on the tree's own split planes: inside one plane, along the line where the faces of
/// a node meet, starting on a plane, and through the corners of nodes.
std::vector<Ray> plane_rays(const AccelerationStructure& tree, std::span<const Triangle> triangles,
                            std::size_t count, std::uint32_t seed) {
  Random random(seed);
  const Bounds box = bounds_of_all(triangles);
  const std::vector<NodeView> nodes = nodes_of(tree);
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const NodeView& node = nodes[random.below(static_cast<std::uint32_t>(nodes.size()))];
    glm::vec3 corner;
    for (int k = 0; k < 3; ++k) {
      corner[k] = random.below(2) ? node.bounds.min[k] : node.bounds.max[k];
    }
    const int axis = node.split_axis >= 0 ? node.split_axis : static_cast<int>(random.below(3));
    if (node.split_axis >= 0) corner[axis] = node.split_position;
    const glm::vec3 other = random.below(2) ? inside(random, box) : vertex_of(random, triangles);
    Ray ray{other, 0.0F, random.point(1.0F)};
    switch (random.below(5)) {
      case 0:  // inside the plane
        ray.origin[axis] = corner[axis];
        ray.direction[axis] = random.below(2) ? 0.0F : -0.0F;
        break;
      case 1:  // along an edge of the node
        ray.origin = corner;
        ray.direction = glm::vec3(random.below(2) ? 0.0F : -0.0F);
        ray.direction[(axis + 1) % 3] = random.below(2) ? 1.0F : -1.0F;
        ray.origin -= ray.direction * (box.size() + 1.0F);
        break;
      case 2:  // starting on the plane
        ray.origin[axis] = corner[axis];
        break;
      case 3:  // through a corner
        ray.direction = corner - ray.origin;
        break;
      default:  // along an axis inside the plane, through a vertex's other coordinates
        ray.origin = vertex_of(random, triangles);
        ray.origin[axis] = corner[axis];
        ray.direction = glm::vec3(-0.0F);
        ray.direction[(axis + 2) % 3] = random.below(2) ? 1.0F : -1.0F;
        ray.origin[(axis + 2) % 3] -= ray.direction[(axis + 2) % 3] * (box.size()[(axis + 2) % 3]);
        break;
    }
    if (ray.direction != glm::vec3(0.0F)) rays.push_back(ray);
  }
  return rays;
}

TEST_P(KdTreeHits, AgreesWithBruteForceOnHostileGeometry) {
  for (const kd_test::NamedScene& scene : kd_test::hostile_scenes()) {
    KdTree tree(GetParam(), {}, MemoryMode::pool);
    tree.build(scene.triangles);
    const auto rays = mixed_rays(scene.triangles, 4000, 11);
    const std::size_t hits = expect_oracle_hits(tree, scene.triangles, rays, scene.name);
    if (scene.name != "one") {
      EXPECT_GT(hits, 50U) << scene.name;
    }
  }
}

TEST_P(KdTreeHits, AgreesForRaysThroughItsOwnPlanesAndCorners) {
  for (const kd_test::NamedScene& scene : kd_test::hostile_scenes()) {
    KdTree tree(GetParam(), {}, MemoryMode::pool);
    tree.build(scene.triangles);
    const auto rays = plane_rays(tree, scene.triangles, 4000, 12);
    expect_oracle_hits(tree, scene.triangles, rays, scene.name);
  }
}

TEST_P(KdTreeHits, AgreesForABigBatchOfRays) {
  const std::vector<Triangle> triangles = kd_test::soup(300, 0.35F, 13);
  KdTree tree(GetParam(), {}, MemoryMode::fresh);
  tree.build(triangles);
  EXPECT_GT(expect_oracle_hits(tree, triangles, mixed_rays(triangles, 40000, 14), "soup"), 20000U);
}

TEST_P(KdTreeHits, AgreesAtEveryScale) {
  for (const float scale : {1e-18F, 1e-9F, 1e9F, 1e15F}) {
    for (kd_test::NamedScene& scene : kd_test::hostile_scenes()) {
      if (scene.name != "soup" && scene.name != "boxes" && scene.name != "uneven") continue;
      scene.triangles = kd_test::scaled(scene.triangles, scale);
      KdTree tree(GetParam(), {}, MemoryMode::pool);
      tree.build(scene.triangles);
      EXPECT_GT(tree.stats().nodes, 50U);
      const std::string what = scene.name + " at " + std::to_string(std::log10(scale));
      expect_oracle_hits(tree, scene.triangles, mixed_rays(scene.triangles, 3000, 15), what);
    }
  }
}

TEST_P(KdTreeHits, BuildsTheSameTreeAtEveryPowerOfTwo) {
  std::vector<Triangle> triangles = kd_test::soup(3000, 0.2F, 16);
  KdTree tree(GetParam(), {}, MemoryMode::pool);
  tree.build(triangles);
  const BuildStats plain = tree.stats();
  for (const float scale : {0x1p-60F, 0x1p60F}) {
    const std::vector<Triangle> resized = kd_test::scaled(triangles, scale);
    tree.build(resized);
    EXPECT_EQ(tree.stats().nodes, plain.nodes);
    EXPECT_EQ(tree.stats().references, plain.references);
    EXPECT_DOUBLE_EQ(tree.stats().sah_cost, plain.sah_cost);
  }
}

TEST_P(KdTreeHits, ReturnsTheLowestIndexOfDuplicates) {
  std::vector<Triangle> triangles = kd_test::soup(400, 0.3F, 17);
  const std::size_t count = triangles.size();
  for (std::size_t i = 0; i < count; ++i) triangles.push_back(triangles[i]);
  KdTree tree(GetParam(), {}, MemoryMode::pool);
  tree.build(triangles);
  const auto rays = mixed_rays(triangles, 5000, 18);
  std::vector<Hit> hits(rays.size());
  tree.intersect(rays, hits);
  for (const Hit& hit : hits) EXPECT_TRUE(!hit.found() || hit.triangle < count);
}

TEST_P(KdTreeHits, CountsStepsAndTestsThatDependOnTheRay) {
  const std::vector<Triangle> triangles = kd_test::soup(5000, 0.05F, 19);
  KdTree tree(GetParam(), {}, MemoryMode::pool);
  tree.build(triangles);
  const std::vector<Ray> rays{{{0, 0, 5}, 0, {0, 0, -1}}, {{0, 0, 5}, 0, {0, 0, 1}}};
  std::vector<Hit> hits(2);
  std::vector<TraceCounters> counters(2);
  tree.intersect_counted(rays, hits, counters);
  EXPECT_GT(counters[0].steps, 5U);
  EXPECT_LT(counters[0].triangle_tests, 2000U);
  EXPECT_EQ(counters[1].steps, 0U);
  EXPECT_EQ(counters[1].triangle_tests, 0U);
}

}  // namespace
}  // namespace encore::accel
