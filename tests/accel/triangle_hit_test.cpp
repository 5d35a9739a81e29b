// One definition of a hit: exact where it matters, free of scale, and never cut by the filter.
#include "accel/triangle_hit.h"

#include "accel/exact_oracle.h"
#include "accel/triangle_filter.h"
#include "tests/support/random_triangles.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

namespace encore::accel {
namespace {

using scene::Hit;
using scene::make_triangle;
using scene::Ray;
using scene::Triangle;
using test::Random;

bool hits(const Ray& ray, const Triangle& triangle, Hit& hit) {
  hit = Hit{.t = ray.t_max};
  return decide_hit(ray, triangle, 0, hit);
}

TEST(TriangleHit, GivesDistanceAndBarycentrics) {
  const Triangle t = make_triangle({0, 0, 0}, {4, 0, 0}, {0, 2, 0});
  Hit hit;
  ASSERT_TRUE(hits({{1, 0.5F, 3}, 0, {0, 0, -2}}, t, hit));
  EXPECT_EQ(hit.t, 1.5F);
  EXPECT_EQ(hit.u, 0.25F);
  EXPECT_EQ(hit.v, 0.25F);
}

TEST(TriangleHit, CountsEdgesVerticesAndBothSides) {
  const Triangle t = make_triangle({0, 0, 0}, {4, 0, 0}, {0, 2, 0});
  Hit hit;
  for (const glm::vec2 p : {glm::vec2{0, 0}, {4, 0}, {0, 2}, {2, 0}, {0, 1}, {2, 1}}) {
    EXPECT_TRUE(hits({{p.x, p.y, 1}, 0, {0, 0, -1}}, t, hit)) << p.x << "," << p.y;
    EXPECT_TRUE(hits({{p.x, p.y, -1}, 0, {0, 0, 1}}, t, hit)) << p.x << "," << p.y;
  }
  EXPECT_FALSE(hits({{std::nextafter(4.0F, 5.0F), 0, 1}, 0, {0, 0, -1}}, t, hit));
  EXPECT_FALSE(hits({{2, std::nextafter(0.0F, -1.0F), 1}, 0, {0, 0, -1}}, t, hit));
}

TEST(TriangleHit, RespectsTheRaysEnds) {
  const Triangle t = make_triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  Hit hit;
  EXPECT_TRUE(hits({{0, 0, 2}, 0, {0, 0, -1}, 2.0F}, t, hit));   // t_max belongs to the ray
  EXPECT_FALSE(hits({{0, 0, 2}, 2, {0, 0, -1}, 5.0F}, t, hit));  // t_min does not
  EXPECT_FALSE(hits({{0, 0, 0}, 0, {0, 0, -1}}, t, hit));        // nor does a start on the surface
  EXPECT_FALSE(hits({{0, 0, -1}, 0, {0, 0, -1}}, t, hit));       // behind
}

TEST(TriangleHit, EqualDistancesGoToTheLowerIndex) {
  const Triangle t = make_triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  const Ray ray{{0, 0, 2}, 0, {0, 0, -1}};
  Hit hit{.t = ray.t_max};
  EXPECT_TRUE(decide_hit(ray, t, 7, hit));
  EXPECT_FALSE(decide_hit(ray, t, 9, hit));
  EXPECT_TRUE(decide_hit(ray, t, 3, hit));
  EXPECT_EQ(hit.triangle, 3U);
}

TEST(TriangleHit, DegenerateAndEdgeOnTrianglesAreNotHit) {
  Random random(1);
  Hit hit;
  for (int i = 0; i < 20000; ++i) {
    const glm::vec3 a = random.point(1);
    const glm::vec3 b = random.point(1);
    // Collinear exactly: the middle of two points with even mantissas, and repeated vertices.
    const glm::vec3 whole_a = glm::round(a * 1000.0F) * 2.0F;
    const glm::vec3 whole_b = glm::round(b * 1000.0F) * 2.0F;
    const glm::vec3 middle = (whole_a + whole_b) * 0.5F;
    const glm::vec3 from = random.point(3000);
    EXPECT_FALSE(hits({from, 0, middle - from}, make_triangle(whole_a, middle, whole_b), hit));
    EXPECT_FALSE(hits({from, 0, whole_a - from}, make_triangle(whole_a, whole_a, whole_b), hit));
    // Edge-on: along the first edge, from outside.
    const glm::vec3 c = glm::round(random.point(1) * 1000.0F) * 2.0F;
    const glm::vec3 along = whole_b - whole_a;
    EXPECT_FALSE(hits({whole_a - along, 0, along}, make_triangle(whole_a, whole_b, c), hit));
  }
}

TEST(TriangleHit, AgreesWithTheExactOracle) {
  Random random(2);
  std::uint64_t found = 0;
  for (int i = 0; i < 200000; ++i) {
    const Triangle t = make_triangle(random.point(1), random.point(1), random.point(1));
    const glm::vec3 origin = random.point(3);
    const Ray ray{origin, 0, random.point(1) - origin};
    Hit hit;
    hits(ray, t, hit);
    const Hit truth = exact_nearest_hit({&t, 1}, ray);
    ASSERT_EQ(hit.found(), truth.found()) << i;
    if (!hit.found()) continue;
    ++found;
    EXPECT_TRUE(hit.t == truth.t || std::nextafter(hit.t, truth.t) == truth.t) << i;
    EXPECT_NEAR(hit.u, truth.u, 1e-7) << i;
    EXPECT_NEAR(hit.v, truth.v, 1e-7) << i;
  }
  EXPECT_GT(found, 5000U);
}

TEST(TriangleHit, ScalingByPowersOfTwoScalesTheDistanceExactly) {
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const glm::vec3 a = random.point(1), b = random.point(1), c = random.point(1);
    const glm::vec3 origin = random.point(3);
    const glm::vec3 direction = random.point(1) - origin;
    Hit unit;
    hits({origin, 0, direction}, make_triangle(a, b, c), unit);
    for (const int exponent : {-60, -20, 20, 60}) {
      const float s = std::ldexp(1.0F, exponent);
      Hit scaled;
      hits({s * origin, 0, direction}, make_triangle(s * a, s * b, s * c), scaled);
      ASSERT_EQ(unit.found(), scaled.found()) << i << " at 2^" << exponent;
      if (!unit.found()) continue;
      EXPECT_EQ(unit.t * s, scaled.t);
      EXPECT_EQ(unit.u, scaled.u);
      EXPECT_EQ(unit.v, scaled.v);
    }
  }
}

TEST(TriangleHit, NoRaySlipsBetweenTwoTrianglesThatShareAnEdge) {
  Random random(4);
  for (int i = 0; i < 200000; ++i) {
    // A quad split along a-c, tilted; the ray is aimed at a point of the shared edge.
    const glm::vec3 a = random.point(1), c = random.point(1);
    const glm::vec3 across = random.point(1);
    const glm::vec3 b = (a + c) * 0.5F + across;
    const glm::vec3 d = (a + c) * 0.5F - across;
    const Triangle left = make_triangle(a, b, c);
    const Triangle right = make_triangle(a, c, d);
    const glm::vec3 origin = random.point(10);
    const float share = random.between(0.01F, 0.99F);
    const Ray ray{origin, 0, a + share * (c - a) - origin};
    Hit hit;
    // Seen from the fold's inside or outside alike, one of the two must stop the ray, unless the
    // quad is seen edge-on.
    const glm::vec3 n = glm::cross(c - a, across);
    if (std::fabs(glm::dot(n, ray.direction)) < 1e-3F) continue;
    EXPECT_TRUE(hits(ray, left, hit) || hits(ray, right, hit)) << i;
  }
}

// The filter's promise, for triangles and rays of all shapes: what it drops, the decision drops.
void expect_filter_drops_no_hit(std::uint32_t seed, float size, float distance, float scale,
                                float direction_scale = 1.0F) {
  Random random(seed);
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> references;
  for (std::uint32_t i = 0; i < 61; ++i) {
    const glm::vec3 corner = random.point(1) * scale;
    triangles.push_back(make_triangle(corner, corner + random.point(size) * scale,
                                      corner + random.point(size) * scale));
    references.push_back(i);
  }
  for (int i = 0; i < 3000; ++i) {
    const Triangle& target = triangles[random.below(static_cast<std::uint32_t>(triangles.size()))];
    const float u = random.between(-0.001F, 1.0F);
    const float v = random.between(-0.001F, 1.001F - u);
    const glm::vec3 aim = target.v0 + u * (target.v1 - target.v0) + v * (target.v2 - target.v0);
    const glm::vec3 origin = random.point(distance) * scale;
    const Ray ray{origin, 0, (aim - origin) / (scale * distance) * direction_scale};
    Hit plain{.t = ray.t_max};
    for (const std::uint32_t r : references) decide_hit(ray, triangles[r], r, plain);
    const TriangleFilter filter(ray);
    for (std::uint32_t count = 0; count <= references.size(); count += 13) {
      Hit listed{.t = ray.t_max};
      Hit single{.t = ray.t_max};
      Hit expected{.t = ray.t_max};
      filter.test(triangles.data(), references.data(), count, listed);
      for (std::uint32_t r = 0; r < count; ++r) {
        filter.test(triangles.data(), r, single);
        decide_hit(ray, triangles[r], r, expected);
      }
      ASSERT_EQ(std::memcmp(&expected, &listed, sizeof(Hit)), 0) << i;
      ASSERT_EQ(std::memcmp(&expected, &single, sizeof(Hit)), 0) << i;
    }
  }
}

TEST(TriangleFilter, DropsNoHitOfOrdinaryTriangles) {
  expect_filter_drops_no_hit(5, 0.5F, 3, 1);
}
TEST(TriangleFilter, DropsNoHitOfTinyTriangles) {
  expect_filter_drops_no_hit(6, 1e-4F, 3, 1);
}
TEST(TriangleFilter, DropsNoHitFromFarAway) {
  expect_filter_drops_no_hit(7, 0.5F, 1e6F, 1);
}
TEST(TriangleFilter, DropsNoHitAlongHugeDirections) {
  expect_filter_drops_no_hit(10, 0.5F, 3, 1, 1e30F);
  expect_filter_drops_no_hit(11, 0.5F, 3, 1e12F, 1e14F);
  expect_filter_drops_no_hit(12, 0.5F, 3, 1e18F, 1e18F);
}
TEST(TriangleFilter, DropsNoHitAlongTinyDirections) {
  expect_filter_drops_no_hit(13, 0.5F, 3, 1, 1e-30F);
  expect_filter_drops_no_hit(14, 0.5F, 3, 1e15F, 1e-36F);
  expect_filter_drops_no_hit(15, 0.5F, 3, 1e-18F, 1e-18F);
}
TEST(TriangleFilter, DropsNoHitInTinyScenes) {
  expect_filter_drops_no_hit(8, 0.5F, 3, 1e-18F);
}
TEST(TriangleFilter, DropsNoHitInHugeScenes) {
  expect_filter_drops_no_hit(9, 0.5F, 3, 1e18F);
}

}  // namespace
}  // namespace encore::accel
