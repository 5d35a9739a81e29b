#include "ui/plot/axis.h"
#include "ui/plot/value_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace encore::ui {

namespace {

/// Labels that differ only behind this many digits are written without what they share.
constexpr double kMostDigits = 1e5;
/// No axis has more ticks, whatever the range.
constexpr int kMostTicks = 1000;

/// The least of 1, 2, 5 x 10^n that is not below.
double nice_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

double time_step(double least) {
  constexpr std::array<double, 18> kSteps{1,   2,   5,    10,   15,   30,    60,    120,   300,
                                          600, 900, 1800, 3600, 7200, 10800, 21600, 43200, 86400};
  if (least <= 0.5) return nice_step(least);
  for (const double step : kSteps) {
    if (step >= least * (1.0 - 1e-9)) return step;
  }
  return 86400.0 * nice_step(least / 86400.0);
}

int decimals_of(double step) {
  return std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 15);
}

/// The multiples of `step` on the axis, labelled by `label`.
template <class Label>
void place(const Axis& axis, double step, Ticks& out, const Label& label) {
  // Counted from the first multiple, so that errors do not add up.
  const double slack = (axis.high - axis.low) * 1e-9;
  const double first = std::ceil((axis.low - slack) / step);
  for (int i = 0; i < kMostTicks; ++i) {
    const double value = (first + i) * step;
    if (value > axis.high + slack) break;
    const double inside = std::clamp(value, axis.low, axis.high);
    out.ticks.push_back({inside, label(value == 0.0 ? 0.0 : value), true});
  }
  out.step = step;
}

Ticks linear_ticks(const Axis& axis, int most) {
  Ticks out;
  const double step = nice_step((axis.high - axis.low) / most);
  const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
  // Far from 0 the labels count from a round number near the range.
  double origin = 0.0;
  if (largest / step > kMostDigits) {
    const double coarse = std::pow(10.0, std::ceil(std::log10(axis.high - axis.low)));
    origin = std::floor(axis.low / coarse) * coarse;
  }
  const SiPrefix prefix = si_prefix(origin == 0.0 ? largest : axis.high - origin, axis.unit);
  const int decimals = decimals_of(step / prefix.factor);
  place(axis, step, out, [&](double value) {
    const double shown = (value - origin) / prefix.factor;
    const bool zero = std::abs(shown) < 1e-9 * step / prefix.factor;
    const double magnitude = std::abs(shown);
    if (!zero && (magnitude >= 1e7 || step / prefix.factor < 1e-6)) {
      return fmt::format("{:.6g}", shown);
    }
    return fmt::format("{:.{}f}", zero ? 0.0 : shown, decimals);
  });
  out.unit = fmt::format("{}{}", prefix.letter, axis.unit);
  if (origin != 0.0) {
    out.unit +=
        fmt::format(" {} {:.15g} {}", origin < 0.0 ? '-' : '+', std::abs(origin), axis.unit);
  }
  return out;
}

Ticks time_ticks(const Axis& axis, int most) {
  const double step = time_step((axis.high - axis.low) / most);
  const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
  // Seconds as plain numbers up to two minutes; then as a clock shows them.
  // Below a millisecond a clock has too many digits, and the common part goes to the unit.
  if (largest < 120.0 || step < 1e-3) {
    Axis plain = axis;
    plain.unit = "s";
    if (step < 1.0) return linear_ticks(plain, most);
    Ticks out;
    place(axis, step, out, [](double value) { return fmt::format("{:.0f}", value); });
    out.unit = "s";
    return out;
  }
  Ticks out;
  const bool hours = largest >= 3600.0;
  const int decimals = step < 1.0 ? std::min(decimals_of(step), 9) : 0;
  const bool whole_minutes = hours && step >= 60.0;
  place(axis, step, out, [&](double value) {
    if (whole_minutes) return clock_text(value / 60.0, 0, false);
    return clock_text(value, decimals, hours);
  });
  out.unit = whole_minutes ? "h:min" : hours ? "h:min:s" : "min:s";
  return out;
}

std::string power_label(double value, const std::string& unit) {
  if (unit == "%" || unit.empty()) {
    const bool plain = value > 0.99e-4 && value < 1.01e6;
    return plain ? fmt::format("{:.6g}", value) : fmt::format("{:.0e}", value);
  }
  if (unit == "s" && value >= 119.0) return duration_text(value);
  return value_text(value, unit, 1);
}

/// Powers of ten, each nth where there are many; 2 and 5 in between where there is room.
Ticks log_ticks(const Axis& axis, int most) {
  Ticks out;
  const double low = std::log10(axis.low);
  const double high = std::log10(axis.high);
  const double decades = high - low;
  // Less than a decade or so holds too few round numbers: as on a straight axis.
  if (decades < 0.7) {
    Axis straight = axis;
    straight.scale = Scale::linear;
    out = linear_ticks(straight, most);
    return out;
  }
  const int every = std::max(1, static_cast<int>(std::ceil(decades / most)));
  const bool label_2_5 = every == 1 && decades * 3.0 <= most;
  const bool minor = decades <= 12.0;
  constexpr double kSlack = 1e-9;
  const int first = static_cast<int>(std::floor(low));
  const int last = std::min(static_cast<int>(std::ceil(high)), first + kMostTicks);
  for (int decade = first; decade <= last; ++decade) {
    for (int digit = 1; digit < 10; ++digit) {
      const double value = digit * std::pow(10.0, decade);
      const double place_at = std::log10(value);
      if (place_at < low - kSlack || place_at > high + kSlack) continue;
      const bool round = digit == 1 && ((decade % every) + every) % every == 0;
      const bool major = round || (label_2_5 && (digit == 2 || digit == 5));
      if (!major && !minor && digit != 1) continue;
      const double inside = std::clamp(value, axis.low, axis.high);
      out.ticks.push_back({inside, major ? power_label(value, axis.unit) : "", major});
    }
  }
  out.step = std::pow(10.0, every);
  // Other labels carry their unit, each with its own prefix.
  if (axis.unit == "%") out.unit = axis.unit;
  return out;
}

}  // namespace

Ticks axis_ticks(const Axis& axis, int most) {
  // From three on, at least one round number lies inside.
  const int wanted = std::clamp(most, 3, kMostTicks);
  if (!(axis.high > axis.low) || !std::isfinite(axis.high - axis.low)) return {};
  switch (axis.scale) {
    case Scale::log10:
      return log_ticks(axis, wanted);
    case Scale::time:
      return time_ticks(axis, wanted);
    case Scale::linear:
      break;
  }
  return linear_ticks(axis, wanted);
}

}  // namespace encore::ui
