// Values read well and never pretend.
#include "ui/plot/value_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

namespace {

using namespace encore::ui;

TEST(ValueText, TakesThePrefixThatFits) {
  EXPECT_EQ(value_text(1230.0, "J", 3), "1.23 kJ");
  EXPECT_EQ(value_text(0.00035, "s", 3), "350 \xC2\xB5s");
  EXPECT_EQ(value_text(0.0, "W"), "0 W");
  EXPECT_EQ(value_text(-0.012, "J", 3), "-12.0 mJ");
  EXPECT_EQ(value_text(999.96, "W", 4), "1.000 kW");
  EXPECT_EQ(value_text(1234.5, "%", 5), "1234.5 %");
  EXPECT_EQ(value_text(35.124, "W"), "35.12 W");
}

TEST(ValueText, MissingIsNeverAZero) {
  EXPECT_EQ(value_text(std::optional<double>(), "J"), "unavailable");
  EXPECT_EQ(value_text(std::nan(""), "J"), "unavailable");
  EXPECT_EQ(value_text(std::numeric_limits<double>::infinity(), "J"), "unavailable");
  EXPECT_EQ(duration_text(std::nan("")), "unavailable");
}

TEST(ValueText, AnIntervalDecidesTheDigits) {
  EXPECT_EQ(value_text(35.1234, std::optional(0.3412), "W"),
            "35.12 \xC2\xB1"
            "0.34 W");
  EXPECT_EQ(value_text(1234.0, std::optional(56.0), "J"),
            "1.234 \xC2\xB1"
            "0.056 kJ");
  EXPECT_EQ(value_text(-20.0, std::optional(2.88), "%"),
            "-20.0 \xC2\xB1"
            "2.9 %");
  EXPECT_EQ(value_text(35.1234, std::nullopt, "W"), "35.12 W");
}

TEST(ValueText, Durations) {
  EXPECT_EQ(duration_text(12.5), "12.5 s");
  EXPECT_EQ(duration_text(200.0), "3 min 20 s");
  EXPECT_EQ(duration_text(7500.0), "2 h 05 min");
  EXPECT_EQ(duration_text(3.0 * 86400 + 4 * 3600), "3 d 4 h");
  EXPECT_EQ(duration_text(3599.7), "1 h 00 min");
  EXPECT_EQ(clock_text(59.996, 2, false), "1:00.00");
  EXPECT_EQ(clock_text(3725.0, 0, true), "1:02:05");
  EXPECT_EQ(clock_text(-61.5, 1, false), "-1:01.5");
}

}  // namespace
