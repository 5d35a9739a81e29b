#include "energy/plan.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace encore::energy {
namespace {

TEST(Plan, TheThesisProtocolIsWhatItsSection442Says) {
  const Plan plan = thesis_plan();
  EXPECT_EQ(plan.idle_before, Seconds(10));
  EXPECT_EQ(plan.run, Seconds(180));
  EXPECT_EQ(plan.idle_after, Seconds(10));
  EXPECT_EQ(plan.poll, Seconds(1));
  EXPECT_EQ(plan.cut_below, Watts(24));
  EXPECT_EQ(least_duration(plan), Seconds(200));
}

TEST(Plan, EveryNameHasAPlanOfThatName) {
  for (const std::string_view name : kPlanNames) EXPECT_EQ(plan_by_name(name)->name, name);
  EXPECT_FALSE(plan_by_name("settled"));
}

TEST(Plan, SettleTakesWhatTheSlowestSourceNeeds) {
  SourceInfo counter;
  counter.update_period = Seconds(0.001);
  SourceInfo gauge;
  gauge.update_period = Seconds(4.0);
  const Plan fast = fit_to_sources(settle_plan(), std::vector{counter});
  EXPECT_EQ(fast.idle_before, Seconds(2));
  EXPECT_EQ(fast.run, settle_plan().run);
  const Plan slow = fit_to_sources(settle_plan(), std::vector{counter, gauge});
  EXPECT_EQ(slow.run, Seconds(164)) << "41 periods: the edge error's deviation is below 1 %";
  EXPECT_EQ(slow.idle_after, Seconds(60));
  EXPECT_EQ(slow.mix, Seconds(0)) << "hundreds of seconds: only if asked for";
  gauge.update_period = Seconds(0.1);
  EXPECT_EQ(fit_to_sources(settle_plan(), std::vector{gauge}).mix, Seconds(10));
  EXPECT_EQ(fit_to_sources(thesis_plan(), std::vector{counter, gauge}), thesis_plan());
}

TEST(Plan, WithoutASourceNothingIsSpentOnOne) {
  const Plan plan = fit_to_sources(settle_plan(), {});
  EXPECT_EQ(plan.idle_before, Seconds(0));
  EXPECT_EQ(plan.idle_after, Seconds(0));
  EXPECT_EQ(plan.mix, Seconds(0));
}

TEST(Plan, OrdersRepeats) {
  Plan plan;
  plan.repeats = 3;
  EXPECT_EQ(measuring_order(plan, 3), (std::vector<std::size_t>{0, 1, 2, 0, 1, 2, 0, 1, 2}));
  plan.order = Order::abba;
  EXPECT_EQ(measuring_order(plan, 3), (std::vector<std::size_t>{0, 1, 2, 2, 1, 0, 0, 1, 2}));

  plan.order = Order::shuffled;
  const auto shuffled = measuring_order(plan, 10);
  EXPECT_EQ(shuffled, measuring_order(plan, 10)) << "an order belongs to its seed";
  for (int repeat = 0; repeat < 3; ++repeat) {
    std::vector<std::size_t> once(shuffled.begin() + 10 * repeat,
                                  shuffled.begin() + 10 * (repeat + 1));
    EXPECT_FALSE(std::is_sorted(once.begin(), once.end()));
    std::sort(once.begin(), once.end());
    for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(once[i], i);
  }
  plan.order_seed = 2;
  EXPECT_NE(shuffled, measuring_order(plan, 10));
}

}  // namespace
}  // namespace encore::energy
