// Polygons are cut into corners - 2 triangles that cover them exactly once.
#include "scene/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace encore::scene {
namespace {

using Polygon = std::vector<glm::vec3>;

double cross(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return (double(b.x) - a.x) * (double(c.y) - a.y) - (double(b.y) - a.y) * (double(c.x) - a.x);
}

double area_of(const Polygon& polygon) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    doubled += cross(glm::vec3(0.0F), polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return doubled;
}

// All triangles turn like the polygon and their areas add up: no overlap, no hole.
void expect_exact_cover(const Polygon& polygon) {
  std::vector<glm::uvec3> triangles;
  EXPECT_TRUE(triangulate(polygon, triangles));
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  const double whole = area_of(polygon);
  double sum = 0.0;
  for (const glm::uvec3& t : triangles) {
    const double area = cross(polygon[t.x], polygon[t.y], polygon[t.z]);
    EXPECT_GE(area * whole, 0.0);
    sum += area;
  }
  EXPECT_NEAR(sum, whole, 1e-9 * std::abs(whole));
}

Polygon reversed(Polygon polygon) {
  return {polygon.rbegin(), polygon.rend()};
}

TEST(Triangulate, ConvexPolygonsBecomeFans) {
  Polygon circle;
  for (int i = 0; i < 24; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 24.0;
    circle.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  expect_exact_cover(circle);
  expect_exact_cover(reversed(circle));
  std::vector<glm::uvec3> triangles;
  triangulate(circle, triangles);
  EXPECT_EQ(triangles[5], glm::uvec3(0U, 6U, 7U));
}

TEST(Triangulate, ConcavePolygonsAreCoveredOnceFromEveryStart) {
  Polygon comb;
  for (int i = 0; i < 20; ++i) {
    comb.emplace_back(2.0F * float(i), 0.0F, 0.0F);
    comb.emplace_back(2.0F * float(i) + 1.0F, -float(10 + i % 3), 0.0F);
  }
  comb.emplace_back(40.0F, 1.0F, 0.0F);
  comb.emplace_back(-1.0F, 1.0F, 0.0F);
  for (std::size_t start = 0; start < comb.size(); ++start) {
    Polygon turned(comb.begin() + long(start), comb.end());
    turned.insert(turned.end(), comb.begin(), comb.begin() + long(start));
    expect_exact_cover(turned);
    expect_exact_cover(reversed(turned));
  }
}

TEST(Triangulate, SpiralsAreCoveredOnce) {
  Polygon spiral;
  const auto at = [](double turns, double radius) {
    const double angle = 2.0 * std::numbers::pi * turns;
    return glm::vec3(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  };
  for (int i = 0; i <= 200; ++i) spiral.push_back(at(i / 40.0, 1.0 + i / 40.0));
  for (int i = 200; i >= 0; --i) spiral.push_back(at(i / 40.0, 0.5 + i / 40.0));
  expect_exact_cover(spiral);
  expect_exact_cover(reversed(spiral));
}

TEST(Triangulate, HolesOnADoubledEdgeStayOpen) {
  // A square with a square hole; the edge from 0 0 to 1 1 is walked in both directions.
  const Polygon ring = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                        {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  EXPECT_EQ(area_of(ring), 2.0 * 12.0);
  for (std::size_t start = 0; start < ring.size(); ++start) {
    Polygon turned(ring.begin() + long(start), ring.end());
    turned.insert(turned.end(), ring.begin(), ring.begin() + long(start));
    expect_exact_cover(turned);
  }
}

TEST(Triangulate, EveryPlaneAndScaleWorks) {
  const Polygon arrow = {{0, 0, 0}, {2, -1, 0}, {0.5F, 0, 0}, {2, 1, 0}};
  for (const float scale : {1e-18F, 1.0F, 1e18F}) {
    for (int axis = 0; axis < 3; ++axis) {
      Polygon placed;
      for (const glm::vec3& p : arrow) {
        glm::vec3 q;
        q[(axis + 1) % 3] = p.x * scale;
        q[(axis + 2) % 3] = p.y * scale;
        q[axis] = 3.0F * scale;
        placed.push_back(q);
      }
      std::vector<glm::uvec3> triangles;
      EXPECT_TRUE(triangulate(placed, triangles));
      ASSERT_EQ(triangles.size(), 2U);
      // The cut must run from the tip, corner 0, to the reflex corner 2.
      for (const glm::uvec3& t : triangles) {
        EXPECT_TRUE(t.x == 0 || t.y == 0 || t.z == 0);
        EXPECT_TRUE(t.x == 2 || t.y == 2 || t.z == 2);
      }
    }
  }
}

TEST(Triangulate, DegenerateAndCrossingOutlinesStillGiveTheirCount) {
  std::vector<glm::uvec3> triangles;
  triangulate(Polygon(7, glm::vec3(1.0F)), triangles);
  EXPECT_EQ(triangles.size(), 5U);
  triangles.clear();
  triangulate(Polygon{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2.5F, 0}, {-1, -1, 0}}, triangles);
  EXPECT_EQ(triangles.size(), 3U);
  triangles.clear();
  triangulate(Polygon{{0, 0, 0}, {1, 0, 0}}, triangles);
  EXPECT_TRUE(triangles.empty());
}

TEST(Triangulate, HugeCrookedPolygonsEndInLinearTime) {
  // Random zigzags cross themselves everywhere; the answer must admit that it is rough.
  Polygon zigzag;
  std::uint32_t state = 1;
  for (int i = 0; i < 8000; ++i) {
    state = state * 1664525U + 1013904223U;
    const auto x = static_cast<float>(state >> 8U);
    state = state * 1664525U + 1013904223U;
    zigzag.emplace_back(x, static_cast<float>(state >> 8U), 0.0F);
  }
  std::vector<glm::uvec3> triangles;
  EXPECT_FALSE(triangulate(zigzag, triangles));
  EXPECT_EQ(triangles.size(), zigzag.size() - 2);
}

}  // namespace
}  // namespace encore::scene
