#pragma once

#include "app/profile_report.h"

#include <optional>
#include <string>

namespace encore::app {

/// The energies of a profile for people: a table of the configurations, one of their phases, and
/// what is to be said about them; empty if there was no power source.
std::string energy_text(const ProfileReport& report);

/// "12.34 ± 0.56 mJ": in the unit (nJ, µJ, mJ, J, kJ) that fits the value. Without a half-width
/// "12.34 mJ".
std::string joules_text(double joules, std::optional<double> half_width);

}  // namespace encore::app
