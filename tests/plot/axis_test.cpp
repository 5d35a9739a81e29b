// An axis is never empty, inverted or without numbers; what is under the cursor stays there.
#include "ui/plot/axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>

namespace {

using namespace encore::ui;

/// Seeded ranges: 1e-12 to 1e12, of both signs, also tiny ones far from 0.
class Ranges {
 public:
  explicit Ranges(unsigned seed) : random_(seed) {}

  double magnitude() {
    return std::pow(10.0, std::uniform_real_distribution<double>(-12.0, 12.0)(random_));
  }
  double part() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

  Axis axis(Scale scale) {
    Axis axis{.scale = scale, .low = 0.0, .high = 1.0, .unit = "W"};
    axis.narrowest = scale == Scale::log10 ? 0.01 : 1e-14;
    const double low =
        scale == Scale::log10 ? magnitude() : (part() < 0.5 ? -1.0 : 1.0) * magnitude();
    if (scale == Scale::log10) {
      axis.least = 1e-15;
      set_range(axis, low, low * std::pow(10.0, 0.02 + 8.0 * part()));
    } else {
      const double width = part() < 0.3 ? std::abs(low) * 1e-9 : magnitude();
      set_range(axis, low, low + width);
    }
    return axis;
  }

 private:
  std::mt19937 random_;
};

void expect_sound(const Axis& axis) {
  ASSERT_TRUE(std::isfinite(axis.low) && std::isfinite(axis.high));
  ASSERT_LT(axis.low, axis.high);
  if (axis.scale == Scale::log10) {
    ASSERT_GT(axis.low, 0.0);
  }
}

constexpr Scale kScales[] = {Scale::linear, Scale::log10, Scale::time};

TEST(Axis, ThereAndBackAgain) {
  Ranges ranges(1);
  for (const Scale scale : kScales) {
    for (int round = 0; round < 500; ++round) {
      const Axis axis = ranges.axis(scale);
      expect_sound(axis);
      const double position = 3.0 * ranges.part() - 1.0;
      const double back = axis_position(axis, axis_value(axis, position));
      // Numbers far from 0 carry only so many digits of a narrow range.
      const double size = std::max(std::abs(axis.low), std::abs(axis.high));
      const double coarse = scale == Scale::log10 ? 1e-11 : 1e-15 * size / (axis.high - axis.low);
      EXPECT_NEAR(back, position, 1e-9 + 16.0 * coarse);
      EXPECT_NEAR(axis_position(axis, axis.low), 0.0, 1e-9);
      EXPECT_NEAR(axis_position(axis, axis.high), 1.0, 1e-9);
    }
  }
}

TEST(Axis, TheValueUnderTheCursorStays) {
  Ranges ranges(2);
  for (const Scale scale : kScales) {
    for (int round = 0; round < 500; ++round) {
      Axis axis = ranges.axis(scale);
      axis.least = scale == Scale::log10 ? 1e-30 : -1e30;
      axis.most = 1e30;
      const double position = ranges.part();
      const double value = axis_value(axis, position);
      zoom_at(axis, position, 0.5 + 1.5 * ranges.part());
      expect_sound(axis);
      const double size = std::max(std::abs(axis.low), std::abs(axis.high));
      const double coarse = scale == Scale::log10 ? 1e-10 : 1e-15 * size / (axis.high - axis.low);
      EXPECT_NEAR(axis_position(axis, value), position, 1e-9 + 32.0 * coarse);
    }
  }
}

TEST(Axis, PanKeepsTheWidthAndComesBack) {
  Ranges ranges(3);
  for (int round = 0; round < 300; ++round) {
    Axis axis = ranges.axis(Scale::linear);
    axis.least = -1e30;
    axis.most = 1e30;
    const Axis before = axis;
    const double width = axis.high - axis.low;
    const double share = 4.0 * ranges.part() - 2.0;
    const double size = std::max(std::abs(axis.low), std::abs(axis.high)) + 2.0 * width;
    pan(axis, share);
    EXPECT_NEAR(axis.high - axis.low, width, 1e-14 * size + 1e-9 * width);
    EXPECT_NEAR(axis.low, before.low + share * width, 1e-14 * size + 1e-9 * width);
    pan(axis, -share);
    EXPECT_NEAR(axis.low, before.low, 1e-14 * size + 1e-9 * width);
  }
}

TEST(Axis, NoAbuseBreaksIt) {
  const double kNan = std::nan("");
  const double kInf = std::numeric_limits<double>::infinity();
  Ranges ranges(4);
  for (const Scale scale : kScales) {
    Axis axis = ranges.axis(scale);
    for (const double a : {kNan, kInf, -kInf, 0.0, -1.0, 1e300, -1e300, 1e-300}) {
      for (const double b : {kNan, kInf, 0.0, 1e300, -1e300, 1e-300}) {
        set_range(axis, a, b);
        expect_sound(axis);
        fit(axis, a, b);
        expect_sound(axis);
        zoom_at(axis, a, b);
        expect_sound(axis);
        pan(axis, a);
        expect_sound(axis);
        follow(axis, a, b);
        expect_sound(axis);
        EXPECT_FALSE(std::isnan(axis_position(axis, 0.0)));
        axis_ticks(axis, 10);
      }
    }
    for (int i = 0; i < 5000; ++i) zoom_at(axis, ranges.part(), 0.8);
    expect_sound(axis);
    for (int i = 0; i < 5000; ++i) zoom_at(axis, ranges.part(), 1.25);
    expect_sound(axis);
  }
}

TEST(Axis, LimitsHold) {
  Axis axis{.scale = Scale::linear,
            .low = 0.0,
            .high = 10.0,
            .unit = "s",
            .least = -5.0,
            .most = 100.0,
            .narrowest = 0.5};
  for (int i = 0; i < 100; ++i) zoom_at(axis, 0.3, 0.5);
  EXPECT_NEAR(axis.high - axis.low, 0.5, 1e-12);
  for (int i = 0; i < 100; ++i) zoom_at(axis, 0.3, 2.0);
  EXPECT_EQ(axis.low, -5.0);
  EXPECT_EQ(axis.high, 100.0);
  set_range(axis, 0.0, 10.0);
  pan(axis, 1000.0);
  EXPECT_EQ(axis.high, 100.0);
  EXPECT_DOUBLE_EQ(axis.low, 90.0);
}

TEST(Axis, FollowsTheLatest) {
  Axis axis{.scale = Scale::time, .low = 0.0, .high = 1.0, .unit = "s"};
  follow(axis, 1000.0, 60.0);
  EXPECT_DOUBLE_EQ(axis.high - axis.low, 60.0);
  EXPECT_GT(axis.high, 1000.0);
  EXPECT_LT(axis.high, 1003.0);
}

TEST(Axis, FitShowsASingleValue) {
  Axis axis;
  fit(axis, 35.0, 35.0);
  EXPECT_LT(axis.low, 35.0);
  EXPECT_GT(axis.high, 35.0);
  fit(axis, 0.0, 0.0);
  EXPECT_LT(axis.low, 0.0);
  EXPECT_GT(axis.high, 0.0);
}

TEST(Ticks, AreFewRoundInsideAndInOrder) {
  Ranges ranges(5);
  for (const Scale scale : kScales) {
    for (int round = 0; round < 400; ++round) {
      const Axis axis = ranges.axis(scale);
      const int most = 2 + static_cast<int>(12.0 * ranges.part());
      const Ticks ticks = axis_ticks(axis, most);
      int major = 0;
      std::set<std::string> labels;
      for (std::size_t i = 0; i < ticks.ticks.size(); ++i) {
        const Tick& tick = ticks.ticks[i];
        ASSERT_GE(tick.value, axis.low);
        ASSERT_LE(tick.value, axis.high);
        if (i > 0) {
          ASSERT_GT(tick.value, ticks.ticks[i - 1].value);
        }
        if (!tick.major) continue;
        ++major;
        EXPECT_FALSE(tick.label.empty());
        EXPECT_TRUE(labels.insert(tick.label).second)
            << "twice " << tick.label << " from " << axis.low << " to " << axis.high;
        EXPECT_LE(tick.label.size(), scale == Scale::time ? 20U : 16U)
            << axis.low << " " << axis.high;
      }
      EXPECT_LE(major, most + 2) << axis.low << " " << axis.high;
      EXPECT_LE(ticks.ticks.size(), 200U);
      if (scale == Scale::linear) {
        EXPECT_GE(major, 1);
        const double digit = ticks.step / std::pow(10.0, std::floor(std::log10(ticks.step) + 1e-9));
        EXPECT_TRUE(std::abs(digit - 1) < 1e-6 || std::abs(digit - 2) < 1e-6 ||
                    std::abs(digit - 5) < 1e-6)
            << ticks.step;
      }
    }
  }
}

std::string labels_of(const Axis& axis, int most) {
  std::string text;
  const Ticks ticks = axis_ticks(axis, most);
  for (const Tick& tick : ticks.ticks) {
    if (!tick.label.empty()) text += tick.label + " ";
  }
  return text + "| " + ticks.unit;
}

TEST(Ticks, ReadWell) {
  EXPECT_EQ(labels_of({.low = 0.0, .high = 50.0, .unit = "W"}, 5), "0 10 20 30 40 50 | W");
  EXPECT_EQ(labels_of({.low = 0.0, .high = 2500.0, .unit = "J"}, 5),
            "0.0 0.5 1.0 1.5 2.0 2.5 | kJ");
  EXPECT_EQ(labels_of({.low = 0.0, .high = 4e-4, .unit = "s"}, 4), "0 100 200 300 400 | \xC2\xB5s");
  EXPECT_EQ(labels_of({.low = -1.0, .high = 1.0, .unit = "W"}, 4), "-1.0 -0.5 0.0 0.5 1.0 | W");
  EXPECT_EQ(labels_of({.low = 1200000.0, .high = 1200000.4, .unit = "J"}, 4),
            "0 100 200 300 400 | mJ + 1200000 J");
  EXPECT_EQ(labels_of({.scale = Scale::time, .low = 0.0, .high = 60.0, .unit = "s"}, 4),
            "0 15 30 45 60 | s");
  EXPECT_EQ(labels_of({.scale = Scale::time, .low = 100.0, .high = 220.0, .unit = "s"}, 4),
            "2:00 2:30 3:00 3:30 | min:s");
  EXPECT_EQ(labels_of({.scale = Scale::time, .low = 3500.0, .high = 3700.0, .unit = "s"}, 4),
            "0:59 1:00 1:01 | h:min");
  EXPECT_EQ(labels_of({.scale = Scale::time, .low = 0.0, .high = 7200.0, .unit = "s"}, 4),
            "0:00 0:30 1:00 1:30 2:00 | h:min");
  EXPECT_EQ(labels_of({.scale = Scale::log10, .low = 0.1, .high = 100.0, .unit = "%"}, 4),
            "0.1 1 10 100 | %");
  EXPECT_EQ(labels_of({.scale = Scale::log10, .low = 0.001, .high = 10.0, .unit = "s"}, 5),
            "1 ms 10 ms 100 ms 1 s 10 s | ");
}

}  // namespace
