#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace encore::ui {

/// A power of a thousand and its letter: 1e3 "k".
struct SiPrefix {
  double factor = 1.0;
  std::string_view letter;
};

/// The prefix that brings a magnitude between 1 and 1000; none for "%" and units without one.
SiPrefix si_prefix(double magnitude, std::string_view unit);

/// "1.23 kJ", "350 µs": `digits` significant ones. Not a number: "unavailable".
std::string value_text(double value, std::string_view unit, int digits = 4);
/// Nothing: "unavailable".
std::string value_text(std::optional<double> value, std::string_view unit, int digits = 4);
/// "35.12 ±0.34 W": the value to the half-width's second digit.
std::string value_text(double value, std::optional<double> half_width, std::string_view unit);

/// A length of time: "350 µs", "12.5 s", "3 min 20 s", "2 h 05 min", "3 d 4 h".
std::string duration_text(double seconds);
/// A time of day of the run, to `decimals` of a second: "12.50", "3:20", "2:05:00".
std::string clock_text(double seconds, int decimals, bool with_hours);

}  // namespace encore::ui
