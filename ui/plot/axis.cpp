#include "ui/plot/axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace encore::ui {

namespace {

constexpr double kLeastLog = 1e-30;
constexpr double kFollowRoom = 0.02;

bool is_log(const Axis& axis) {
  return axis.scale == Scale::log10;
}

/// The scale on which the axis is straight.
double straight(const Axis& axis, double value) {
  return is_log(axis) ? std::log10(std::max(value, kLeastLog)) : value;
}

double bent(const Axis& axis, double value) {
  return is_log(axis) ? std::pow(10.0, value) : value;
}

/// Below this width neighbours would be the same number.
double narrowest_at(const Axis& axis, double low, double high) {
  const double size = std::max({std::abs(low), std::abs(high), 1e-300});
  return std::max(axis.narrowest, size * 1e3 * std::numeric_limits<double>::epsilon());
}

/// Sets a range on the straight scale.
void set_straight(Axis& axis, double low, double high) {
  if (!std::isfinite(low) || !std::isfinite(high)) return;
  if (low > high) std::swap(low, high);
  const double floor = straight(axis, axis.least);
  const double ceiling = straight(axis, axis.most);
  const double narrow =
      narrowest_at(axis, std::clamp(low, floor, ceiling), std::clamp(high, floor, ceiling));
  const double width = std::min(std::max(high - low, narrow), ceiling - floor);
  if (high - low < width) low = 0.5 * low + 0.5 * high - 0.5 * width;
  // Moves inside the limits with its width.
  low = std::clamp(low, floor, ceiling - width);
  high = low + width;
  axis.low = bent(axis, low);
  axis.high = bent(axis, high);
}

}  // namespace

double axis_position(const Axis& axis, double value) {
  const double low = straight(axis, axis.low);
  const double high = straight(axis, axis.high);
  return (straight(axis, value) - low) / (high - low);
}

double axis_value(const Axis& axis, double position) {
  const double low = straight(axis, axis.low);
  const double high = straight(axis, axis.high);
  return bent(axis, low + position * (high - low));
}

void set_range(Axis& axis, double low, double high) {
  if (!std::isfinite(low) || !std::isfinite(high)) return;
  set_straight(axis, straight(axis, low), straight(axis, high));
}

void zoom_at(Axis& axis, double position, double factor) {
  if (!std::isfinite(position) || !std::isfinite(factor) || factor <= 0.0) return;
  const double low = straight(axis, axis.low);
  const double high = straight(axis, axis.high);
  const double fixed = low + position * (high - low);
  // At the least width the zoom stops where it is instead of wandering off to the side.
  const double width = std::max((high - low) * factor, narrowest_at(axis, low, high));
  set_straight(axis, fixed - position * width, fixed + (1.0 - position) * width);
}

void pan(Axis& axis, double share) {
  if (!std::isfinite(share)) return;
  const double low = straight(axis, axis.low);
  const double high = straight(axis, axis.high);
  const double move = share * (high - low);
  set_straight(axis, low + move, high + move);
}

void fit(Axis& axis, double low, double high, double margin) {
  if (!std::isfinite(low) || !std::isfinite(high)) return;
  double from = straight(axis, std::min(low, high));
  double to = straight(axis, std::max(low, high));
  if (from == to) {
    // One value: shown in the middle of a range of its own size.
    const double around = is_log(axis) ? 0.5 : std::max(0.1 * std::abs(from), axis.narrowest);
    from -= around;
    to += around;
  }
  const double room = (to - from) * margin;
  set_straight(axis, from - room, to + room);
}

void follow(Axis& axis, double latest, double width) {
  if (!std::isfinite(latest) || !(width > 0.0)) return;
  set_range(axis, latest - width * (1.0 - kFollowRoom), latest + width * kFollowRoom);
}

}  // namespace encore::ui
