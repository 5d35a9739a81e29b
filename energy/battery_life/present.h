#pragma once

#include "energy/battery_life/battery.h"
#include "energy/sources/battery.h"

namespace encore::energy {

/// The machine's own battery: capacity of today's full charge, charge now and design voltage as its
/// gauge tells them; cells, cut-off and constants are typical ones. Several packs count as one.
/// Throws BatteryError that says what the gauge does not tell and what to do instead.
Battery battery_present(const BatteryState& state);

}  // namespace encore::energy
