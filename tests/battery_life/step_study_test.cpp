#include "energy/battery_life/step_study.h"

#include "tests/support/fake_clock.h"

#include <gtest/gtest.h>

#include <cmath>

namespace encore::energy {
namespace {

const std::vector<StepTable>& study() {
  static const std::vector<StepTable> tables =
      study_steps(*battery_preset("thesis-laptop"), Watts(30.0), FakeClock(), 400'000);
  return tables;
}

const StepTable& table_of(std::string_view method) {
  for (const StepTable& table : study()) {
    if (table.method.find(method) != std::string::npos) return table;
  }
  throw std::logic_error("no table of this method");
}

TEST(StepStudy, CoversAMillisecondToTenHours) {
  ASSERT_EQ(study().size(), 5U);
  for (const StepTable& table : study()) {
    ASSERT_GE(table.rows.size(), 9U) << table.method;
    EXPECT_EQ(table.rows[0].step.value, 1e-3);
    EXPECT_EQ(table.rows[8].step.value, 36000.0);
    EXPECT_FALSE(table.measure.empty());
  }
}

TEST(StepStudy, ExactStepsAreExactAtEverySize) {
  for (const char* method : {"kinetic, exact", "constant current, exact"}) {
    for (const StepRow& row : table_of(method).rows) {
      if (row.left_out) continue;
      ASSERT_TRUE(row.error) << method;
      EXPECT_LT(*row.error, 1e-10) << method << ' ' << row.step.value;
      EXPECT_TRUE(row.stable);
    }
  }
}

TEST(StepStudy, ExplicitEulerIsOfFirstOrderAndThenFallsApart) {
  for (const StepRow& row : table_of("constant current, explicit").rows) {
    // The fastest branch has 10 ms.
    EXPECT_EQ(row.stable, row.step.value < 0.02) << row.step.value;
    if (row.left_out || row.stable) continue;
    EXPECT_TRUE(!row.error || *row.error > 1.0) << row.step.value;
  }
  const StepTable& kinetic = table_of("kinetic, explicit");
  EXPECT_NEAR(*kinetic.rows[4].error / *kinetic.rows[3].error, 10.0, 0.1);
  EXPECT_FALSE(kinetic.rows[8].stable);
}

TEST(StepStudy, ConstantPowerConvergesAndForecastsAreGood) {
  const StepTable& table = table_of("constant power");
  ASSERT_EQ(table.rows.size(), 10U);
  for (const StepRow& row : table.rows) {
    if (row.left_out) continue;
    EXPECT_LT(*row.error, 2e-3) << row.step.value;
  }
  EXPECT_LT(*table.rows[4].error, *table.rows[6].error / 20.0);
  EXPECT_TRUE(std::isinf(table.rows[9].step.value));
  EXPECT_LT(*table.rows[9].error, 1e-4) << "steps as forecasts choose them";
}

TEST(StepStudy, LoadsFromFaintToImpossibleEnd) {
  for (const double watts : {1e-9, 1e9}) {
    const auto tables = study_steps(*battery_preset("generic-3s"), Watts(watts), FakeClock(), 1000);
    ASSERT_EQ(tables.size(), 5U);
    EXPECT_FALSE(tables[4].rows[9].left_out) << watts;
  }
  EXPECT_EQ(study_steps(*battery_preset("generic-3s"), Watts(0.0), FakeClock(), 1000).size(), 4U)
      << "no load, no end to compare";
}

TEST(StepStudy, TooManyStepsAreLeftOutAndSaidSo) {
  int left_out = 0;
  for (const StepTable& table : study()) {
    for (const StepRow& row : table.rows) {
      if (!row.left_out) continue;
      ++left_out;
      EXPECT_FALSE(row.error) << "no number for what did not run";
    }
  }
  EXPECT_GT(left_out, 0);
}

}  // namespace
}  // namespace encore::energy
