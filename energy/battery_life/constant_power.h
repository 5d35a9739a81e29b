#pragma once

#include "energy/units.h"

#include <optional>

namespace encore::energy {

/// How long `charge` lasts at a constant power; nothing (for ever) at 0 W.
std::optional<Seconds> constant_power_time(Joules charge, Watts load);

/// The current that draws `load` from a source of `emf_volts` behind `r0_ohms`: the smaller root of
/// I (E - I R0) = P, in the form that does not cancel. Nothing if no current gives that much
/// (E^2 < 4 R0 P): the voltage breaks down, a brown-out.
std::optional<double> current_for_power(double emf_volts, double r0_ohms, Watts load);

}  // namespace encore::energy
