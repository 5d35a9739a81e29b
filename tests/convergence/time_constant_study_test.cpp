#include "energy/convergence/time_constant_study.h"

#include "tests/support/fake_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string_view>

namespace encore::energy {
namespace {

const std::vector<TimeConstantTable>& study() {
  static const auto tables = study_time_constants(FakeClock(), 100'000);
  return tables;
}

const TimeConstantTable& table_of(std::string_view method) {
  for (const TimeConstantTable& table : study()) {
    if (table.method.find(method) != std::string::npos) return table;
  }
  throw std::logic_error("no table of this method");
}

TEST(TimeConstantStudy, CoversAllStepsAndTimeConstants) {
  ASSERT_EQ(study().size(), 4U);
  for (const TimeConstantTable& table : study()) {
    ASSERT_EQ(table.rows.size(), 90U) << table.method;
    EXPECT_EQ(table.rows.front().tau.value, 1e-3);
    EXPECT_EQ(table.rows.front().step.value, 1e-3);
    EXPECT_EQ(table.rows.back().tau.value, 1e6);
    EXPECT_EQ(table.rows.back().step.value, 36000.0);
    EXPECT_FALSE(table.measure.empty());
  }
}

TEST(TimeConstantStudy, ExactFiltersAreExactEverywhere) {
  for (const char* method : {"step of load, exact", "ramp of load, exact"}) {
    for (const TimeConstantRow& row : table_of(method).rows) {
      ASSERT_TRUE(row.error) << method;
      EXPECT_LT(*row.error, 2e-10) << method << ' ' << row.tau.value << ' ' << row.step.value;
      EXPECT_TRUE(row.stable);
    }
  }
}

TEST(TimeConstantStudy, ExplicitEulerFallsApartBeyondTwiceTheTimeConstant) {
  int apart = 0;
  for (const TimeConstantRow& row : table_of("explicit Euler").rows) {
    EXPECT_EQ(row.stable, row.step.value < 2.0 * row.tau.value);
    if (row.stable) continue;
    ++apart;
    EXPECT_TRUE(!row.error || *row.error > 0.3) << row.tau.value << ' ' << row.step.value;
  }
  EXPECT_EQ(apart, 36);
}

TEST(TimeConstantStudy, FitsAreGoodOrSayWhyThereIsNone) {
  int given = 0;
  int held = 0;
  for (const TimeConstantRow& row : table_of("thermal drift").rows) {
    EXPECT_EQ(row.error.has_value(), row.refused.empty());
    if (!row.error) continue;
    ++given;
    const double per_tau = row.tau.value / row.step.value;
    held += *row.low <= row.tau && row.tau <= *row.high ? 1 : 0;
    if (per_tau >= 1.0 && per_tau <= 300.0) {
      EXPECT_LT(*row.error, 0.05) << row.tau.value << ' ' << row.step.value;
    }
    if (per_tau <= 0.1) ADD_FAILURE() << "a time constant far below the spacing cannot be told";
  }
  EXPECT_GE(given, 20);
  EXPECT_GE(held, given - 4);
}

}  // namespace
}  // namespace encore::energy
