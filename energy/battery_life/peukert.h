#pragma once

#include "energy/battery_life/battery.h"
#include "energy/units.h"

#include <optional>

namespace encore::energy {

/// Peukert's law (1897): a full battery of `coulombs`, rated for a discharge in H hours, lasts
/// t = H (C / (I H))^k at the current I. Nothing (for ever) at 0 A. The law knows no upper limit:
/// below the rated current it promises more than the label.
std::optional<Seconds> peukert_time(double coulombs, const PeukertParameters& peukert,
                                    double amperes);

/// One full discharge at a constant current.
struct MeasuredDischarge {
  double amperes = 0.0;
  Seconds time;
};

/// The exponent through two discharges; nothing if their currents are equal or a value is not
/// positive.
std::optional<double> fit_peukert(const MeasuredDischarge& a, const MeasuredDischarge& b);

}  // namespace encore::energy
