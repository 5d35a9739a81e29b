// Two boxes at once decide as one box at a time does, on every kind of machine.
#include "accel/bvh/two_boxes.h"

#include "accel/box_hit.h"
#include "test_scenes.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

namespace encore::accel::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Case {
  gpu::BvhNode children[2];
  scene::Ray ray;
};

/// Boxes on a coarse lattice, so that origins often lie on their planes; integer members that look
/// like NaN and denormal numbers.
Case random_case(Random& random) {
  const auto coarse = [&] { return std::floor(random.between(-4.0F, 5.0F)); };
  const auto coarse_point = [&] {
    const float x = coarse();
    const float y = coarse();
    return vec3(x, y, coarse());
  };
  Case c{};
  for (gpu::BvhNode& child : c.children) {
    const vec3 a = coarse_point();
    const vec3 b = coarse_point();
    child = {glm::min(a, b), 0x7FC00001U, glm::max(a, b), 3U};
  }
  c.ray.origin = random.between(0, 1) < 0.5F ? coarse_point() : random.point(4.0F);
  do {
    c.ray.direction = random.between(0, 1) < 0.5F ? coarse_point() : random.point(1.0F);
  } while (c.ray.direction == vec3(0.0F));
  c.ray.direction += 0.0F;  // no negative zeros: there box_stretch() is on the safe side
  c.ray.t_min = random.between(0, 1) < 0.8F ? 0.0F : 2.0F;
  c.ray.t_max = random.between(0, 1) < 0.5F ? kInfinity : random.between(0.0F, 8.0F);
  return c;
}

template <class F4>
void expect_as_one_box_at_a_time(std::uint32_t seed) {
  Random random(seed);
  int hits = 0;
  for (int i = 0; i < 200000; ++i) {
    const Case c = random_case(random);
    const TwoEntries both = TwoBoxRay<F4>(c.ray).test(c.children, c.ray.t_max);
    const BoxRay single(c.ray);
    for (int side = 0; side < 2; ++side) {
      const BoxStretch stretch =
          box_stretch(c.children[side].min, c.children[side].max, single, c.ray.t_min, c.ray.t_max);
      ASSERT_EQ((both.hits >> side & 1) != 0, stretch.hit()) << "case " << i << " side " << side;
      if (stretch.hit()) {
        ASSERT_EQ(side == 0 ? both.left : both.right, stretch.enter) << "case " << i;
        ++hits;
      }
    }
  }
  EXPECT_GT(hits, 10000);
}

TEST(TwoBoxes, DecideAsOneBoxAtATime) {
  expect_as_one_box_at_a_time<FourFloats>(70);
}

TEST(TwoBoxes, DecideAsOneBoxAtATimeWithoutVectorInstructions) {
  expect_as_one_box_at_a_time<FourFloatsPortable>(71);
}

TEST(TwoBoxes, VectorAndPortableCodeAgreeBitForBit) {
  Random random(72);
  for (int i = 0; i < 200000; ++i) {
    Case c = random_case(random);
    if (i % 3 == 0) c.ray.direction[i % 2] = -0.0F;
    if (i % 5 == 0) c.ray.direction[2] = 0x1p-140F;
    const TwoEntries a = TwoBoxRay<FourFloats>(c.ray).test(c.children, c.ray.t_max);
    const TwoEntries b = TwoBoxRay<FourFloatsPortable>(c.ray).test(c.children, c.ray.t_max);
    ASSERT_EQ(a.hits, b.hits);
    ASSERT_EQ(std::bit_cast<std::uint32_t>(a.left), std::bit_cast<std::uint32_t>(b.left));
    ASSERT_EQ(std::bit_cast<std::uint32_t>(a.right), std::bit_cast<std::uint32_t>(b.right));
  }
}

TEST(TwoBoxes, ARayInsideAFaceMeetsTheBox) {
  const gpu::BvhNode children[2] = {{{0, 0, 0}, 0, {1, 1, 1}, 0}, {{1, 0, 0}, 0, {2, 1, 1}, 0}};
  for (const float zero : {0.0F, -0.0F}) {
    // In the face that both share, in an outer face, just outside.
    const auto hits = [&](float x) {
      const scene::Ray ray{.origin = {x, 0.5F, 5.0F}, .direction = {zero, zero, -1.0F}};
      return TwoBoxRay<FourFloats>(ray).test(children, kInfinity).hits;
    };
    EXPECT_EQ(hits(1.0F), 3U);
    EXPECT_EQ(hits(0.0F), 1U);
    EXPECT_EQ(hits(2.0F), 2U);
    EXPECT_EQ(hits(-1e-30F), 0U);
    EXPECT_EQ(hits(std::nextafter(2.0F, 3.0F)), 0U);
  }
}

TEST(TwoBoxes, AnAxisTooFlatToInvertRejectsNothing) {
  const gpu::BvhNode children[2] = {{{-1, 0, 0}, 0, {-0.5F, 1, 1}, 0},
                                    {{0, 0, 0}, 0, {1, 1, 1}, 0}};
  const scene::Ray ray{.origin = {0, 0.5F, 5.0F}, .direction = {0x1p-140F, 0, -1.0F}};
  EXPECT_EQ(TwoBoxRay<FourFloats>(ray).test(children, kInfinity).hits, 3U);
}

}  // namespace
}  // namespace encore::accel::test
