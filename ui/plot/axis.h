#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace encore::ui {

enum class Scale : std::uint8_t { linear, log10, time };

/// What an axis shows, from `low` to `high`. The functions below keep it in order: finite, low <
/// high, on a logarithmic scale above 0, neither wider nor narrower than its limits.
struct Axis {
  Scale scale = Scale::linear;
  double low = 0.0;
  double high = 1.0;
  std::string unit;         ///< "W"; times are in seconds
  double least = -1e15;     ///< nothing below is ever shown
  double most = 1e15;       ///< nor above
  double narrowest = 1e-9;  ///< the least high - low; of a logarithmic one: of log10(high / low)
};

/// Where a value lies: 0 at low, 1 at high, beyond them outside. On a logarithmic axis, what is not
/// above 0 lies at the place of the least number there is.
double axis_position(const Axis& axis, double value);
double axis_value(const Axis& axis, double position);

/// Shows [low, high], or the nearest range that may be shown; no change for what is no number.
void set_range(Axis& axis, double low, double high);
/// Shows `factor` times as much (below 1: closer); the value at `position` stays where it is unless
/// a limit is reached.
void zoom_at(Axis& axis, double position, double factor);
/// Moves by a share of the width; stops at the limits with the width unchanged.
void pan(Axis& axis, double share);
/// Shows the values with a margin of `margin` of the width on both sides.
void fit(Axis& axis, double low, double high, double margin = 0.05);
/// Shows the `width` seconds before `latest` with a little room ahead.
void follow(Axis& axis, double latest, double width);

struct Tick {
  double value = 0.0;
  std::string label;  ///< empty for a minor one
  bool major = true;
};

struct Ticks {
  std::vector<Tick> ticks;  ///< in rising order, inside the axis
  std::string unit;         ///< of the labels: "kW", "min:s", "W + 1200"
  double step = 0.0;        ///< between major ones; of a logarithmic axis: the first ratio
};

/// About `most` major ticks, at the most two more, at 1, 2, 5 x 10^n, for times at whole seconds,
/// minutes and hours; labels share one prefix, and where they would only differ far behind the
/// point, the common part is in the unit.
Ticks axis_ticks(const Axis& axis, int most);

}  // namespace encore::ui
