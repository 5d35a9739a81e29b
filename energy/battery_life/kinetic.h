#pragma once

#include "energy/battery_life/battery.h"
#include "energy/units.h"

#include <optional>

namespace encore::energy {

/// The kinetic battery model of Manwell and McGowan (1993): two wells of charge. The load empties
/// the one at hand (width c); the other one (width 1 - c) refills it at a rate proportional to the
/// difference of their heights.
struct KineticBattery {
  double coulombs = 0.0;
  double c = 1.0;
  double rate_per_s = 0.0;  ///< k' = k / (c (1 - c))
};

struct KineticState {
  double available = 0.0;  ///< coulombs at hand
  double bound = 0.0;      ///< coulombs in the other well
};

/// The wells of a pack. Where its description states no charge of its own for this model, the
/// charge is such that the label's capacity comes out in `rated_hours`.
KineticBattery kinetic_battery(const Battery& battery);

/// Both wells at the same height, filled to `soc`.
KineticState kinetic_rest(const KineticBattery& battery, double soc);

/// The state after `dt` at a constant current, negative to charge: exact for any dt >= 0, without
/// cancellation for short ones. It does not stop at empty wells.
KineticState kinetic_step(const KineticBattery& battery, const KineticState& state, double amperes,
                          Seconds dt);

/// When the charge at hand ends at a constant current: 0 if it has, nothing if it never does. The
/// root lies inside one exact step, bracketed by the time that takes all charge, and is bisected to
/// the last digit.
std::optional<Seconds> kinetic_time_to_empty(const KineticBattery& battery,
                                             const KineticState& state, double amperes);

}  // namespace encore::energy
