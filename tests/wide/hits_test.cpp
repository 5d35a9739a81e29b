// bvh-sah finds what brute force finds, bit for bit: every intersection mode, every instruction
// set, on scenes and for rays that things go wrong with.
#include "accel/brute_force.h"
#include "accel/wide/wide_bvh.h"
#include "cases.h"

#include <gtest/gtest.h>

#include <cstring>

namespace encore::accel::test {
namespace {

struct Answers {
  std::vector<Hit> hits;
  std::vector<std::uint8_t> blocked;
};

Answers answers_of(const AccelerationStructure& structure, const std::vector<Ray>& rays) {
  Answers answers{std::vector<Hit>(rays.size()), std::vector<std::uint8_t>(rays.size())};
  structure.intersect(rays, answers.hits);
  structure.occluded(rays, answers.blocked);
  return answers;
}

std::string tell(const Ray& ray, const Hit& expected, const Hit& found) {
  std::ostringstream out;
  out << std::hexfloat << "origin " << ray.origin.x << ' ' << ray.origin.y << ' ' << ray.origin.z
      << " direction " << ray.direction.x << ' ' << ray.direction.y << ' ' << ray.direction.z
      << " in " << ray.t_min << ".." << ray.t_max << ": expected " << expected.triangle << " at "
      << expected.t << ' ' << expected.u << ' ' << expected.v << ", found " << found.triangle
      << " at " << found.t << ' ' << found.u << ' ' << found.v;
  return out.str();
}

void expect_same(const std::vector<Ray>& rays, const Answers& expected, const Answers& found,
                 const std::string& what) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool same = std::memcmp(&expected.hits[i], &found.hits[i], sizeof(Hit)) == 0;
    if (!same && ++wrong <= 3) {
      ADD_FAILURE() << what << ": " << tell(rays[i], expected.hits[i], found.hits[i]);
    }
    if ((found.blocked[i] != 0) != expected.hits[i].found() && ++wrong <= 3) {
      ADD_FAILURE() << what << ", any-hit " << int{found.blocked[i]} << ": "
                    << tell(rays[i], expected.hits[i], found.hits[i]);
    }
  }
  EXPECT_EQ(wrong, 0U) << what << ", of " << rays.size();
}

class EveryCase : public testing::TestWithParam<std::size_t> {
 protected:
  void SetUp() override {
    const std::vector<Case> cases = hard_cases();
    triangles_ = cases.at(GetParam()).triangles;
    name_ = cases.at(GetParam()).name;
  }
  std::string name_;
  std::vector<Triangle> triangles_;
};

TEST_P(EveryCase, GivesBruteForcesHitsWithEveryInstructionSet) {
  BruteForce brute;
  brute.build(triangles_);
  for (const BuildPreset preset : {BuildPreset::fast, BuildPreset::balanced, BuildPreset::best}) {
    WideBvh wide({.preset = preset}, MemoryMode::pool);
    wide.build(triangles_);
    const std::vector<Ray> rays = hard_rays(wide, triangles_, 60, 11);
    for (const IntersectionMode mode : {IntersectionMode::precise, IntersectionMode::watertight}) {
      brute.set_intersection(mode);
      wide.set_intersection(mode);
      const Answers expected = answers_of(brute, rays);
      for (const Isa isa : available_isas()) {
        wide.set_isa(isa);
        expect_same(rays, expected, answers_of(wide, rays),
                    name_ + ", " + std::string(to_string(preset)) + ", " +
                        std::string(to_string(mode)) + ", " + std::string(to_string(isa)));
      }
    }
  }
}

/// Möller and Trumbore's test finds the same in every structure only where distances are known
/// well; but whatever it finds, it finds with every instruction set.
TEST_P(EveryCase, GivesTheSameMollerTrumboreHitsWithEveryInstructionSet) {
  WideBvh wide({}, MemoryMode::pool);
  wide.build(triangles_);
  wide.set_intersection(IntersectionMode::moller_trumbore);
  const std::vector<Ray> rays = hard_rays(wide, triangles_, 200, 12);
  wide.set_isa(Isa::portable);
  const Answers expected = answers_of(wide, rays);
  for (const Isa isa : available_isas()) {
    wide.set_isa(isa);
    expect_same(rays, expected, answers_of(wide, rays), name_ + ", " + std::string(to_string(isa)));
  }
}

TEST_P(EveryCase, GivesTheSameHitsCountedAndRecorded) {
  WideBvh wide({}, MemoryMode::pool);
  wide.build(triangles_);
  const std::vector<Ray> rays = hard_rays(wide, triangles_, 20, 13);
  for (const IntersectionMode mode : {IntersectionMode::precise, IntersectionMode::watertight}) {
    wide.set_intersection(mode);
    const Answers expected = answers_of(wide, rays);
    Answers counted = expected;
    Answers recorded = expected;
    std::vector<TraceCounters> counters(rays.size());
    wide.intersect_counted(rays, counted.hits, counters);
    RayPath path;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      wide.trace_path(rays[i], recorded.hits[i], path);
      EXPECT_EQ(path.counters, counters[i]);
    }
    expect_same(rays, expected, counted, name_ + ", counted");
    expect_same(rays, expected, recorded, name_ + ", recorded");
  }
}

INSTANTIATE_TEST_SUITE_P(Hard, EveryCase, testing::Range(std::size_t{0}, hard_cases().size()),
                         [](const testing::TestParamInfo<std::size_t>& test) {
                           std::string name = hard_cases().at(test.param).name;
                           for (char& c : name) {
                             if (c == ' ') c = '_';
                           }
                           return name;
                         });

/// On ordinary rays the common test's hits are brute force's.
TEST(WideHits, AreBruteForcesByMollerAndTrumbore) {
  for (const auto& triangles : {encore::test::triangle_soup(700, 0.2F, 1.0F, 21),
                                stability::ball(700, glm::vec3(0.0F), 1)}) {
    BruteForce brute;
    brute.build(triangles);
    brute.set_intersection(IntersectionMode::moller_trumbore);
    for (const BuildPreset preset : {BuildPreset::fast, BuildPreset::balanced, BuildPreset::best}) {
      WideBvh wide({.preset = preset}, MemoryMode::pool);
      wide.build(triangles);
      wide.set_intersection(IntersectionMode::moller_trumbore);
      for (const RayKind kind : {RayKind::outside, RayKind::inside, RayKind::limited}) {
        const std::vector<Ray> rays = test_rays(kind, 1000, 22, triangles, wide);
        const Answers expected = answers_of(brute, rays);
        for (const Isa isa : available_isas()) {
          wide.set_isa(isa);
          expect_same(rays, expected, answers_of(wide, rays), std::string(to_string(isa)));
        }
      }
    }
  }
}

/// What the testers leave to double precision, or do not, where distances nearly tie: sheets a few
/// roundings apart, the nearest one last in the list.
TEST(WideHits, TellNearTiesApart) {
  std::vector<Triangle> sheets;
  for (int k = 40; k-- > 0;) {
    const float z = 1.0F + static_cast<float>(k / 2) * 0x1p-23F;
    const float tilt = k % 2 == 0 ? 0.0F : 0x1p-21F;
    sheets.push_back(scene::make_triangle({-2, -1, z}, {2, -1, z + tilt}, {0, 2, z - tilt}));
  }
  BruteForce brute;
  brute.build(sheets);
  WideBvh wide({}, MemoryMode::pool);
  wide.build(sheets);
  encore::test::Random random(5);
  std::vector<Ray> rays;
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 to(random.between(-0.5F, 0.5F), random.between(-0.5F, 0.5F), 1.0F);
    const glm::vec3 from(random.between(-0.5F, 0.5F), random.between(-0.5F, 0.5F),
                         random.between(-3.0F, 3.0F));
    rays.push_back({from, 0, to - from});
  }
  for (const IntersectionMode mode : {IntersectionMode::precise, IntersectionMode::watertight}) {
    brute.set_intersection(mode);
    wide.set_intersection(mode);
    const Answers expected = answers_of(brute, rays);
    for (const Isa isa : available_isas()) {
      wide.set_isa(isa);
      expect_same(rays, expected, answers_of(wide, rays), std::string(to_string(isa)));
    }
  }
}

}  // namespace
}  // namespace encore::accel::test
