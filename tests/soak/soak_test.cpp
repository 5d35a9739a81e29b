// A few seconds of what scripts/soak.sh does for an hour: many structures, policies and devices one
// after the other in one process leave no memory behind and find the right hits to the end.
#include "tests/soak/program/soak.h"

#include "tests/support/gl_context.h"

#include <gtest/gtest.h>

#include <set>

namespace encore::test {

namespace {

std::string all_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// A slice of the product: `of` says how thin.
SoakTally soak(const SoakPlan& plan, const std::shared_ptr<renderer::gl::Context>& context,
               int rounds) {
  Soak soak(plan, context);
  for (int i = 0; i < rounds; ++i) soak.round();
  EXPECT_EQ(all_of(verdict(soak.tally(), plan)), "");
  return soak.tally();
}

TEST(Soak, OnTheCpuFindsTheRightHitsAndKeepsItsMemory) {
  const SoakTally tally = soak({.seed = 1, .size = 32, .slices = 16, .slices_used = 1}, nullptr, 7);
  EXPECT_EQ(tally.rounds, 7U);
  EXPECT_GT(tally.checks.hits, tally.checks.rays / 5);
  EXPECT_GT(tally.checks.loose, 0U);
  EXPECT_GT(tally.pictures, 100U);
  EXPECT_GT(tally.builds, 0U);
  EXPECT_GT(tally.updates, 0U);
}

class SoakOnDevices : public GlTest {};

TEST_F(SoakOnDevices, FindsTheRightHitsAndKeepsItsMemory) {
  const SoakTally tally =
      soak({.seed = 2, .size = 32, .slices = 96, .slices_used = 1}, context_, 6);
  EXPECT_GT(tally.checks.hits, tally.checks.rays / 5);
  EXPECT_GT(tally.pictures, 10U);
}

TEST(SoakLegs, AreTheWholeProductOnceInTheSeedsOrder) {
  const std::vector<Leg> legs = all_legs(true, 1);
  std::set<std::string> different;
  std::set<std::string> scenes;
  for (const Leg& leg : legs) {
    // The memory mode is no choice of its own.
    Leg plain = leg;
    plain.memory = accel::MemoryMode::pool;
    different.insert(describe(plain));
    scenes.insert(leg.scene);
  }
  EXPECT_EQ(different.size(), legs.size());
  EXPECT_GE(scenes.size(), 4U);
  const std::size_t traced = 6U * 4U * 3U * 3U * 2U;
  EXPECT_EQ(legs.size(), scenes.size() * (traced + 3U));
  EXPECT_EQ(describe(all_legs(true, 1).front()), describe(legs.front()));
  EXPECT_NE(describe(all_legs(true, 2).front()), describe(legs.front()));
}

TEST(SoakLegs, LeaveOpenGlOutWhereThereIsNone) {
  for (const Leg& leg : all_legs(false, 1)) ASSERT_EQ(leg.device, SoakDevice::cpu);
}

TEST(SoakVerdict, NoticesMemoryThatGrows) {
  const SoakPlan plan;
  SoakTally tally;
  const std::size_t rounds = plan.warm_up() + 9;
  for (std::size_t i = 0; i < rounds; ++i) {
    tally.memory.push_back({.resident = 100'000, .in_use = 50'000});
  }
  EXPECT_TRUE(verdict(tally, plan).empty());
  // What the first round left behind is no drift.
  tally.memory.front() = {.resident = 10, .in_use = 10};
  EXPECT_TRUE(verdict(tally, plan).empty());
  SoakTally leaking = tally;
  for (std::size_t i = 0; i < rounds; ++i) leaking.memory[i].in_use += 100 * i;
  EXPECT_EQ(verdict(leaking, plan).size(), 2U);
  SoakTally swelling = tally;
  for (std::size_t i = 0; i < rounds; ++i) swelling.memory[i].resident += 1'000 * i;
  EXPECT_EQ(verdict(swelling, plan).size(), 1U);
}

TEST(SoakVerdict, NoticesWrongAnswersAndPictures) {
  SoakTally tally;
  tally.checks.rays = 1'000'000;
  tally.checks.wrong = 1;
  EXPECT_EQ(verdict(tally, {}).size(), 1U);
  tally.pictures = 100;
  tally.wrong_pictures = 1;
  EXPECT_EQ(verdict(tally, {}).size(), 2U);
  tally.checks.loose = 100;
  tally.checks.loose_differing = 3;
  EXPECT_EQ(verdict(tally, {}).size(), 3U);
}

TEST(SoakDrift, IsTheSlopeOfTheLine) {
  const std::vector<double> values{100.0, 110.0, 120.0, 130.0};
  EXPECT_DOUBLE_EQ(drift_of(values).per_round, 10.0);
  EXPECT_DOUBLE_EQ(drift_of(values).whole, 30.0 / 115.0);
}

TEST(SoakMemory, SeesWhatIsAllocated) {
  const MemoryUse before = memory_use();
  const std::vector<char> held(50'000'000, 'x');
  const MemoryUse after = memory_use();
  EXPECT_GE(after.in_use, before.in_use + held.size());
  EXPECT_GE(after.resident, before.resident + held.size() / 2);
}

/// Two triangles one behind the other, and a ray through both.
class SoakSpotCheck : public ::testing::Test {
 protected:
  SpotCheckTally check(const scene::Hit& found, const SpotCheck::Source& source) {
    SpotCheckTally tally;
    SpotCheck(triangles_).check({&ray_, 1}, {&found, 1}, source, tally);
    return tally;
  }
  scene::Hit truth() {
    accel::BruteForce brute;
    brute.build(triangles_);
    scene::Hit hit;
    brute.intersect({&ray_, 1}, {&hit, 1});
    return hit;
  }

  std::vector<scene::Triangle> triangles_{
      scene::make_triangle({-1, -1, 2}, {3, -1, 2}, {-1, 3, 2}),
      scene::make_triangle({-1, -1, 1}, {3, -1, 1}, {-1, 3, 1})};
  scene::Ray ray_{.origin = {0, 0, 0}, .direction = {0, 0, 1}};
};

TEST_F(SoakSpotCheck, CountsWhatIsWrong) {
  EXPECT_EQ(check(truth(), {}).wrong, 0U);
  EXPECT_EQ(check(truth(), {}).hits, 1U);
  EXPECT_EQ(check({}, {}).wrong, 1U);
  scene::Hit behind = truth();
  behind.triangle = 0;
  behind.t = 2.0F;
  EXPECT_EQ(check(behind, {}).wrong, 1U);
  EXPECT_EQ(check(behind, {.on_device = true}).wrong, 1U);
  scene::Hit off = truth();
  off.t *= 1.0F + 0x1p-20F;
  EXPECT_EQ(check(off, {}).wrong, 1U);
  EXPECT_EQ(check(off, {.mode = accel::IntersectionMode::watertight}).wrong, 0U);
}

TEST_F(SoakSpotCheck, LetsAnOutdatedStructureOverlookButNotInvent) {
  EXPECT_EQ(check({}, {.outdated = true}).wrong, 0U);
  scene::Hit behind = truth();
  behind.triangle = 0;
  behind.t = 2.0F;
  EXPECT_EQ(check(behind, {.outdated = true}).wrong, 0U);
  behind.t = 1.5F;
  EXPECT_EQ(check(behind, {.outdated = true}).wrong, 1U);
}

}  // namespace

}  // namespace encore::test
