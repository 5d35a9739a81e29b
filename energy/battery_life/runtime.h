#pragma once

#include "energy/battery_life/battery.h"
#include "energy/battery_life/thevenin.h"
#include "energy/units.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace encore::energy {

/// The ways to tell how long a battery lasts (docs/battery-life.md).
enum class BatteryModel { constant, peukert, kinetic, thevenin };
inline constexpr std::array<BatteryModel, 4> kBatteryModels = {
    BatteryModel::constant, BatteryModel::peukert, BatteryModel::kinetic, BatteryModel::thevenin};
std::string_view to_string(BatteryModel model);
std::optional<BatteryModel> parse_battery_model(std::string_view word);

/// What draws from the battery: mean +- half-width of its 95 % confidence interval, if known.
struct BatteryLoad {
  Watts watts;
  std::optional<Watts> half_width;
};

/// How long a battery lasts. A time without a value has no end (`reason` is then `never`).
struct BatteryForecast {
  BatteryModel model = BatteryModel::constant;
  EndReason reason = EndReason::never;
  std::optional<Seconds> time;
  /// The times at the heavy and the light end of the load's interval; empty without an interval.
  /// `latest` has no value, too, where the light end never empties the battery.
  std::optional<Seconds> earliest;
  std::optional<Seconds> latest;
  std::optional<Joules> delivered;  ///< to the load until the end
  std::string note;                 ///< what weakens the figure, one sentence; may be empty
};

/// The forecast of one model from the charge that the battery has now. Throws std::invalid_argument
/// for a load that is negative or not finite and for a battery with a fault (battery_fault).
BatteryForecast forecast(const Battery& battery, const BatteryLoad& load, BatteryModel model);

/// A figure with the interval that the load's own implies.
struct Remaining {
  double value = 0.0;
  std::optional<double> low;
  std::optional<double> high;
};

/// How many frames (or other operations) the battery has left where each takes `each` of the load's
/// energy. Frames come at load / each a second whatever the load's error, so the interval is the
/// time's. Nothing if the battery never ends or `each` is not positive.
std::optional<Remaining> frames_left(const BatteryForecast& forecast, const BatteryLoad& load,
                                     Joules each);

}  // namespace encore::energy
