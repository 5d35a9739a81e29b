// The testers of the intersection modes, triangle by triangle: watertight accepts what decide_hit()
// accepts, at every scale; all do the same to one triangle as to several at once.
#include "accel/triangle_tester.h"
#include "scene/triangle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace encore::accel {
namespace {

using scene::Hit;
using scene::make_triangle;
using scene::Ray;
using scene::Triangle;

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  float between(float low, float high) {
    return low + (high - low) * static_cast<float>(engine_() >> 8) * 0x1p-24F;
  }
  glm::vec3 point(float size) {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }
  std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(engine_() % count); }

 private:
  std::mt19937 engine_;
};

struct Shape {
  const char* name;
  float size;       ///< of the triangles, in scenes
  float distance;   ///< of the rays' origins
  float scale;      ///< of everything
  float direction;  ///< of the rays' directions
  float thin = 1;   ///< of the triangles' second edge
};

void PrintTo(const Shape& shape, std::ostream* out) {
  *out << shape.name;
}

class EveryShape : public testing::TestWithParam<Shape> {
 protected:
  void SetUp() override {
    const Shape& s = GetParam();
    for (int i = 0; i < 61; ++i) {
      const glm::vec3 corner = random_.point(1);
      const glm::vec3 e1 = random_.point(s.size);
      const glm::vec3 e2 = e1 * (1 - s.thin) + random_.point(s.size) * s.thin;
      triangles_.push_back(
          make_triangle(corner * s.scale, (corner + e1) * s.scale, (corner + e2) * s.scale));
    }
    references_.resize(triangles_.size());
    std::iota(references_.begin(), references_.end(), 0U);
  }
  /// Aimed at a corner, an edge, or anywhere near a triangle.
  Ray ray() {
    const Shape& s = GetParam();
    const Triangle& target = triangles_[random_.below(triangles_.size())];
    const std::uint32_t kind = random_.below(3);
    const float u = kind == 0 ? 0.0F : random_.between(-0.01F, 1.0F);
    const float v = kind < 2 ? 0.0F : random_.between(-0.01F, 1.01F - u);
    const glm::vec3 aim = target.v0 + u * (target.v1 - target.v0) + v * (target.v2 - target.v0);
    const glm::vec3 origin = random_.point(s.distance) * s.scale;
    return {origin, 0, (aim - origin) / (s.scale * s.distance) * s.direction};
  }

  Random random_{17};
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> references_;
};

TEST_P(EveryShape, IsHitInTheWatertightModeWhereItIsHit) {
  for (int i = 0; i < 3000; ++i) {
    const Ray r = ray();
    const WatertightTester tester(r);
    Hit nearest{.t = r.t_max};
    Hit found{.t = r.t_max};
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      Hit expected{.t = r.t_max};
      Hit alone{.t = r.t_max};
      const bool hit = decide_hit(r, triangles_[t], t, expected);
      ASSERT_EQ(tester.test(triangles_.data(), t, alone), hit) << i << ", triangle " << t;
      if (hit) {
        EXPECT_LE(std::fabs(double(alone.t) - expected.t),
                  1.01 * WatertightTester::kDistanceError * expected.t);
        EXPECT_GE(WatertightTester::reach(alone.t), expected.t);
        EXPECT_TRUE(alone.u >= 0 && alone.v >= 0 && alone.u + alone.v <= 1.0001F);
      }
      decide_hit(r, triangles_[t], t, nearest);
      tester.test(triangles_.data(), t, found);
    }
    ASSERT_EQ(found.triangle, nearest.triangle) << i;
  }
}

template <class Tester>
void expect_the_same_together(const std::vector<Triangle>& triangles,
                              const std::vector<std::uint32_t>& references, const Ray& ray) {
  const Tester tester(ray);
  for (std::uint32_t count = 0; count <= references.size(); count += 13) {
    Hit single{.t = ray.t_max};
    Hit listed{.t = ray.t_max};
    Hit backwards{.t = ray.t_max};
    bool changed = false;
    for (std::uint32_t r = 0; r < count; ++r) {
      changed |= tester.test(triangles.data(), r, single);
      tester.test(triangles.data(), count - 1 - r, backwards);
    }
    ASSERT_EQ(tester.test(triangles.data(), references.data(), count, listed), changed);
    ASSERT_EQ(std::memcmp(&single, &listed, sizeof(Hit)), 0);
    ASSERT_EQ(std::memcmp(&single, &backwards, sizeof(Hit)), 0) << "the order matters";
  }
}

TEST_P(EveryShape, IsTheSameToOneAtATimeAndToFour) {
  for (int i = 0; i < 300; ++i) {
    const Ray r = ray();
    expect_the_same_together<TriangleFilter>(triangles_, references_, r);
    expect_the_same_together<MollerTrumboreTester>(triangles_, references_, r);
    expect_the_same_together<WatertightTester>(triangles_, references_, r);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, EveryShape,
    testing::Values(
        Shape{"ordinary", 0.5F, 3, 1, 1}, Shape{"tiny", 1e-4F, 3, 1, 1},
        Shape{"large", 100.0F, 3, 1, 1}, Shape{"far", 0.5F, 1e6F, 1, 1},
        Shape{"needles", 0.5F, 3, 1, 1, 1e-5F}, Shape{"degenerate", 0.5F, 3, 1, 1, 0.0F},
        Shape{"huge_direction", 0.5F, 3, 1, 1e30F}, Shape{"huge_both", 0.5F, 3, 1e18F, 1e18F},
        Shape{"enormous", 0.5F, 1.5F, 1e38F, 1e37F}, Shape{"tiny_direction", 0.5F, 3, 1, 1e-30F},
        Shape{"denormal_direction", 0.5F, 3, 1e6F, 1e-39F}, Shape{"tiny_scene", 0.5F, 3, 1e-18F, 1},
        Shape{"tiny_both", 0.5F, 3, 1e-18F, 1e-18F}, Shape{"huge_scene", 0.5F, 3, 1e18F, 1}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(WatertightTester, CutsHitsAtTheSamePlacesAsThePreciseMode) {
  Random random(3);
  const Triangle t = make_triangle({-1, -1, -2}, {1, -1, -2.5F}, {0, 1, -1.7F});
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    Ray ray{random.point(0.1F), 0, {random.between(-0.1F, 0.1F), random.between(-0.1F, 0.1F), -1}};
    Hit free{.t = ray.t_max};
    if (!decide_hit(ray, t, 0, free)) continue;
    // Limits at the very distance and at its neighbours.
    const float around[3] = {std::nextafter(free.t, 0.0F), free.t, std::nextafter(free.t, 9.0F)};
    for (const float limit : around) {
      for (const bool lower : {false, true}) {
        Ray cut = ray;
        (lower ? cut.t_min : cut.t_max) = limit;
        Hit expected{.t = cut.t_max};
        Hit found{.t = cut.t_max};
        const bool hit = decide_hit(cut, t, 0, expected);
        ASSERT_EQ(WatertightTester(cut).test(&t, 0, found), hit);
        hits += hit ? 1 : 0;
      }
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(WatertightTester, SeldomTakesDoublePrecision) {
  Random random(5);
  std::vector<Triangle> triangles;
  for (int i = 0; i < 50; ++i) {
    const glm::vec3 corner = random.point(1);
    triangles.push_back(
        make_triangle(corner, corner + random.point(0.2F), corner + random.point(0.2F)));
  }
  int doubts = 0;
  for (int i = 0; i < 1000; ++i) {
    const Ray ray{random.point(3), 0, random.point(1)};
    const WatertightTester tester(ray);
    for (const Triangle& t : triangles) doubts += tester.doubtful(t) ? 1 : 0;
  }
  EXPECT_LT(doubts, 50) << "of 50,000 tests";
}

TEST(MollerTrumboreTester, TakesTheLowerIndexOfTwoEqualTriangles) {
  const Triangle t = make_triangle({-1, -1, -1}, {1, -1, -1}, {0, 1, -1});
  const std::vector<Triangle> twice{t, t};
  const Ray ray{{0, 0, 1}, 0, {0, 0, -1}};
  const MollerTrumboreTester tester(ray);
  Hit hit{.t = ray.t_max};
  EXPECT_TRUE(tester.test(twice.data(), 1, hit));
  EXPECT_TRUE(tester.test(twice.data(), 0, hit));
  EXPECT_FALSE(tester.test(twice.data(), 1, hit));
  EXPECT_EQ(hit.triangle, 0U);
  EXPECT_EQ(hit.t, 2.0F);
}

}  // namespace
}  // namespace encore::accel
