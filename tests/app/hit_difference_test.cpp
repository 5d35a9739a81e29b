// What rounding can explain, and what it cannot.
#include "app/hit_difference.h"

#include "accel/brute_force.h"
#include "scene/triangle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace encore::app {
namespace {

using scene::Hit;
using scene::Ray;
using scene::Triangle;

/// The unit square at this height as two triangles that share the diagonal x = y.
void add_square(std::vector<Triangle>& triangles, float z) {
  triangles.push_back(scene::make_triangle({0, 0, z}, {1, 0, z}, {1, 1, z}));
  triangles.push_back(scene::make_triangle({0, 0, z}, {1, 1, z}, {0, 1, z}));
}

std::vector<Triangle> square_before_square() {
  std::vector<Triangle> triangles;
  add_square(triangles, 1.0F);
  add_square(triangles, 0.0F);
  return triangles;
}

Ray down_at(float x, float y) {
  return {.origin = {x, y, 3.0F}, .direction = {0, 0, -1}};
}

Hit cpu(const std::vector<Triangle>& triangles, const Ray& ray) {
  accel::BruteForce brute;
  brute.build(triangles);
  Hit hit;
  brute.intersect({&ray, 1}, {&hit, 1});
  return hit;
}

/// What the CPU would say of one triangle alone, by its place in the list.
Hit cpu_of(const std::vector<Triangle>& triangles, const Ray& ray, std::uint32_t index) {
  Hit hit = cpu({triangles[index]}, ray);
  if (hit.found()) hit.triangle = index;
  return hit;
}

Explanation explained(const std::vector<Triangle>& triangles, const Ray& ray, const Hit& found) {
  return explain_difference(triangles, ray, cpu(triangles, ray), found).explanation;
}

TEST(HitDifference, TheOtherSideOfATieIsExplained) {
  const auto triangles = square_before_square();
  const Ray on_diagonal = down_at(0.5F, 0.5F);
  ASSERT_EQ(cpu(triangles, on_diagonal).triangle, 0U);
  const Hit other = cpu_of(triangles, on_diagonal, 1);
  ASSERT_TRUE(other.found());
  const HitDifference d =
      explain_difference(triangles, on_diagonal, cpu(triangles, on_diagonal), other);
  EXPECT_EQ(d.explanation, Explanation::tie);
  EXPECT_EQ(d.oracle.triangle, 0U);
  ASSERT_TRUE(d.clearance.has_value());
  EXPECT_EQ(*d.clearance, 0.0);
  // Two triangles that lie in one another tie anywhere.
  std::vector<Triangle> twice = triangles;
  add_square(twice, 1.0F);
  const Ray ray = down_at(0.75F, 0.25F);
  EXPECT_EQ(explained(twice, ray, cpu_of(twice, ray, 4)), Explanation::tie);
}

TEST(HitDifference, ATrianglesNeighbourOffTheEdgeIsWrongThoughTheDistanceIsRight) {
  const auto triangles = square_before_square();
  const Ray ray = down_at(0.75F, 0.25F);
  Hit found = cpu(triangles, ray);
  found.triangle = 1;
  EXPECT_EQ(explained(triangles, ray, found), Explanation::none);
}

TEST(HitDifference, TheTriangleBehindIsWrong) {
  const auto triangles = square_before_square();
  const Ray ray = down_at(0.75F, 0.25F);
  EXPECT_EQ(explained(triangles, ray, cpu_of(triangles, ray, 2)), Explanation::none);
  EXPECT_EQ(explained(triangles, ray, Hit{}), Explanation::none);
}

TEST(HitDifference, ABorderMayBeOverlookedForWhatLiesBehind) {
  // The front square's border x = 0 is hit exactly; the back one is larger.
  std::vector<Triangle> triangles;
  add_square(triangles, 1.0F);
  triangles.push_back(scene::make_triangle({-4, -4, 0}, {8, -4, 0}, {-4, 8, 0}));
  const Ray ray = down_at(0.0F, 0.25F);
  ASSERT_EQ(cpu(triangles, ray).triangle, 1U);
  EXPECT_EQ(explained(triangles, ray, cpu_of(triangles, ray, 2)), Explanation::edge);
  // But not for nothing, when there is something.
  EXPECT_EQ(explained(triangles, ray, Hit{}), Explanation::none);
  // And a device may see the border where the CPU does not.
  const Ray beside = down_at(std::nextafter(0.0F, -1.0F), 0.25F);
  ASSERT_EQ(cpu(triangles, beside).triangle, 2U);
  EXPECT_EQ(explained(triangles, beside, {2.0F, 1, 0.0F, 0.25F}), Explanation::edge);
  // At its distance only.
  EXPECT_EQ(explained(triangles, beside, {1.5F, 1, 0.0F, 0.25F}), Explanation::none);
}

TEST(HitDifference, SlippingThroughBetweenNeighboursIsWrong) {
  const auto triangles = square_before_square();
  const Ray on_diagonal = down_at(0.5F, 0.5F);
  EXPECT_EQ(explained(triangles, on_diagonal, Hit{}), Explanation::none);
  EXPECT_EQ(explained(triangles, on_diagonal, cpu_of(triangles, on_diagonal, 2)),
            Explanation::none);
}

TEST(HitDifference, OneRoundingOfAnyFigureIsExplained) {
  const auto triangles = square_before_square();
  const Ray ray = down_at(0.7F, 0.3F);
  const Hit right = cpu(triangles, ray);
  for (float Hit::*figure : {&Hit::t, &Hit::u, &Hit::v}) {
    Hit found = right;
    found.*figure = std::nextafter(found.*figure, 10.0F);
    EXPECT_EQ(explained(triangles, ray, found), Explanation::rounding);
    for (int i = 0; i < 3; ++i) found.*figure = std::nextafter(found.*figure, 10.0F);
    EXPECT_EQ(explained(triangles, ray, found), Explanation::none);
    found.*figure = NAN;
    EXPECT_EQ(explained(triangles, ray, found), Explanation::none);
  }
}

TEST(HitDifference, AMissWithAFalseEndAndATriangleThatIsNotThereAreWrong) {
  const auto triangles = square_before_square();
  const Ray beside = down_at(5.0F, 5.0F);
  const HitDifference d = explain_difference(triangles, beside, Hit{}, Hit{.t = 1.0F});
  EXPECT_EQ(d.explanation, Explanation::none);
  EXPECT_FALSE(d.clearance.has_value());
  EXPECT_EQ(explained(triangles, down_at(0.5F, 0.5F), {2.0F, 99, 0.5F, 0.0F}), Explanation::none);
  EXPECT_EQ(explained(triangles, beside, {2.0F, 99, 0.5F, 0.0F}), Explanation::none);
}

}  // namespace
}  // namespace encore::app
