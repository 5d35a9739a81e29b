// Every structure, by every intersection test, stays within its limits on extreme geometry.
#include "accel/make_structure.h"
#include "accel/stability_shapes.h"
#include "app/exit_code.h"
#include "app/stability.h"
#include "tests/support/gl_context.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <string>
#include <vector>

namespace encore::app {
namespace {

using accel::IntersectionMode;

StabilityPlan small_plan(const std::string& name) {
  StabilityPlan plan;
  plan.cases = {name};
  plan.size = accel::StabilitySize::small;
  plan.rays_per_kind = 60;
  plan.watertight_rays = 2000;
  return plan;
}

std::vector<StabilityRow> rows_of(const StabilityPlan& plan) {
  std::vector<StabilityRow> rows;
  run_stability(
      plan, [&](const StabilityRow& row) { rows.push_back(row); },
      [](double, const std::string&) {});
  return rows;
}

void expect_within_limits(const StabilityRow& row) {
  const std::string what = row.name + ", " + row.structure + ", " +
                           std::string(accel::to_string(row.mode)) + ", " + row.device;
  EXPECT_EQ(row.broken, "") << what;
  EXPECT_GT(row.tally.rays, 0U) << what;
}

class EveryStabilityCase : public testing::TestWithParam<std::string> {};

TEST_P(EveryStabilityCase, StaysWithinItsLimitsOnTheCpu) {
  const auto rows = rows_of(small_plan(GetParam()));
  // Seven structures, three modes.
  ASSERT_EQ(rows.size(), 21U);
  for (const StabilityRow& row : rows) expect_within_limits(row);
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Cases, EveryStabilityCase, testing::ValuesIn(stability_case_names()),
                         test_name);

using StabilityOnTheGpu = encore::test::GlTest;

TEST_F(StabilityOnTheGpu, SomeCasesStayWithinTheirLimits) {
  for (const char* name : {"scale-1e-18", "offset-1e5", "without-area", "in-planes", "empty"}) {
    StabilityPlan plan = small_plan(name);
    plan.cpu = false;
    plan.gpu = context_;
    plan.rays_per_kind = 30;
    const auto rows = rows_of(plan);
    EXPECT_EQ(rows.size(), 18U) << name;  // brute is for the CPU alone
    for (const StabilityRow& row : rows) {
      EXPECT_EQ(row.device, "gpu");
      expect_within_limits(row);
    }
  }
}

TEST(StabilityCases, AreTheSameEachTimeAndNamedApart) {
  std::set<std::string> names;
  for (const accel::StabilityCase& one : accel::stability_cases()) {
    EXPECT_TRUE(names.insert(std::string(one.name)).second) << one.name;
    const auto a = accel::stability_triangles(one, accel::StabilitySize::small, 7);
    const auto b = accel::stability_triangles(one, accel::StabilitySize::small, 7);
    ASSERT_EQ(a.size(), b.size()) << one.name;
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_TRUE(scene::is_finite(a[i])) << one.name << ", triangle " << i;
      ASSERT_TRUE(a[i].v0 == b[i].v0 && a[i].v1 == b[i].v1 && a[i].v2 == b[i].v2) << one.name;
    }
  }
}

TEST(StabilityCases, AnUnknownNameIsRefusedWithThoseThereAre) {
  try {
    rows_of(small_plan("neddles"));
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("'neddles'"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("needles"), std::string::npos);
  }
}

// The suite itself must see what it is there to see.
TEST(StabilityTally, SeesMissedFalseAndWrongAnswers) {
  const std::vector<scene::Triangle> two{scene::make_triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0}),
                                         scene::make_triangle({-1, -1, 1}, {1, -1, 1}, {0, 1, 1})};
  const scene::Ray ray{{0, 0, -2}, 0.0F, {0, 0, 1}};
  const scene::Hit first{2.0F, 0, 0.25F, 0.5F};
  const scene::Hit second{3.0F, 1, 0.25F, 0.5F};
  const scene::Hit none;
  for (const Exactness exactness : {Exactness::bits, Exactness::twice, Exactness::single}) {
    StabilityTally tally;
    tally.add(two, ray, first, first, exactness);
    EXPECT_EQ(tally.wrong(), 0U);
    tally.add(two, ray, first, none, exactness);
    EXPECT_EQ(tally.missed, 1U);
    tally.add(two, ray, none, first, exactness);
    EXPECT_EQ(tally.invented, 1U);
    tally.add(two, ray, first, second, exactness);
    EXPECT_EQ(tally.wrong_triangle, 1U);
    tally.add(two, ray, first, {2.001F, 0, 0.25F, 0.5F}, exactness);
    EXPECT_EQ(tally.wrong_distance, 1U);
    EXPECT_NEAR(tally.largest_error, 0.0005, 1e-6);
    EXPECT_EQ(tally.excused, 0U);
    EXPECT_EQ(tally.rays, 5U);
  }
}

}  // namespace
}  // namespace encore::app
