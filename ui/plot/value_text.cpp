#include "ui/plot/value_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace encore::ui {

namespace {

constexpr std::array<std::string_view, 17> kLetters{
    "y", "z", "a", "f", "p", "n", "\xC2\xB5", "m", "", "k", "M", "G", "T", "P", "E", "Z", "Y"};
constexpr int kNoPrefix = 8;

bool takes_prefix(std::string_view unit) {
  return !unit.empty() && unit != "%" && unit != "min" && unit != "h";
}

int exponent10(double magnitude) {
  return magnitude > 0.0 ? static_cast<int>(std::floor(std::log10(magnitude))) : 0;
}

std::string join(std::string number, SiPrefix prefix, std::string_view unit) {
  if (unit.empty() && prefix.letter.empty()) return number;
  return fmt::format("{} {}{}", number, prefix.letter, unit);
}

}  // namespace

SiPrefix si_prefix(double magnitude, std::string_view unit) {
  if (!takes_prefix(unit) || !std::isfinite(magnitude) || magnitude == 0.0) return {};
  const int exponent = exponent10(std::abs(magnitude) * (1.0 + 1e-12));
  const int group = static_cast<int>(std::floor(exponent / 3.0));
  const int index = std::clamp(group + kNoPrefix, 0, static_cast<int>(kLetters.size()) - 1);
  return {std::pow(10.0, 3.0 * (index - kNoPrefix)), kLetters.at(static_cast<std::size_t>(index))};
}

std::string value_text(double value, std::string_view unit, int digits) {
  if (!std::isfinite(value)) return "unavailable";
  // 999.96 would be written as 1000: rounding decides about the prefix, too.
  const double rounding = 1.0 + 0.5 * std::pow(10.0, -digits);
  const SiPrefix prefix = si_prefix(value * rounding, unit);
  const double scaled = value / prefix.factor;
  const double magnitude = std::abs(scaled);
  // Neither 0.0000012 % nor 120000000000 without a prefix can be read.
  if (scaled != 0.0 && (magnitude < 1e-4 || magnitude >= 1e7)) {
    return join(fmt::format("{:.{}g}", scaled, digits), prefix, unit);
  }
  const int before = exponent10(magnitude * rounding) + 1;
  const int decimals = scaled == 0.0 ? 0 : std::clamp(digits - before, 0, 9);
  return join(fmt::format("{:.{}f}", scaled, decimals), prefix, unit);
}

std::string value_text(std::optional<double> value, std::string_view unit, int digits) {
  return value ? value_text(*value, unit, digits) : "unavailable";
}

std::string value_text(double value, std::optional<double> half_width, std::string_view unit) {
  if (!half_width || !std::isfinite(*half_width) || !std::isfinite(value)) {
    return value_text(value, unit);
  }
  const SiPrefix prefix = si_prefix(std::max(std::abs(value), *half_width), unit);
  const double scaled = value / prefix.factor;
  const double band = *half_width / prefix.factor;
  if (band <= 0.0) return value_text(value, unit) + " (exact)";
  const int decimals = std::clamp(1 - exponent10(band), 0, 9);
  return join(fmt::format("{:.{}f} \xC2\xB1{:.{}f}", scaled, decimals, band, decimals), prefix,
              unit);
}

std::string clock_text(double seconds, int decimals, bool with_hours) {
  // Rounded first, so that 59.99 to no decimals is 1:00 and not 0:60.
  const double scale = std::pow(10.0, decimals);
  const double rounded = std::round(std::abs(seconds) * scale) / scale;
  const auto minutes = static_cast<std::int64_t>(rounded / 60.0);
  const double rest = std::max(0.0, rounded - 60.0 * static_cast<double>(minutes));
  const std::string_view sign = seconds < 0.0 && rounded > 0.0 ? "-" : "";
  const int width = decimals > 0 ? 3 + decimals : 2;
  if (!with_hours) return fmt::format("{}{}:{:0{}.{}f}", sign, minutes, rest, width, decimals);
  return fmt::format("{}{}:{:02}:{:0{}.{}f}", sign, minutes / 60, minutes % 60, rest, width,
                     decimals);
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "unavailable";
  const double size = std::abs(seconds);
  if (size < 99.95) return value_text(seconds, "s", 3);
  const std::string_view sign = seconds < 0.0 ? "-" : "";
  const double whole = std::round(size);
  if (whole >= 1e15) return value_text(seconds, "s", 3);
  const auto s = static_cast<std::int64_t>(whole);
  if (s < 3600) return fmt::format("{}{} min {:02} s", sign, s / 60, s % 60);
  if (s < 86400) return fmt::format("{}{} h {:02} min", sign, s / 3600, s % 3600 / 60);
  return fmt::format("{}{} d {} h", sign, s / 86400, s % 86400 / 3600);
}

}  // namespace encore::ui
