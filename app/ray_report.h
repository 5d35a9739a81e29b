#pragma once

#include "energy/session.h"

#include <string>
#include <vector>

namespace encore::app {

/// Gives each kind of rays its part of the render phase's energy, in proportion to its time: the
/// kinds alternate far faster than any sensor reads, so within the phase the power is taken to be
/// the same for all. `phases` are of the total. Where the phase's energy is not known the counters
/// stay as they are (unavailable).
void add_ray_energy(const std::vector<energy::PhaseRow>& phases, energy::SummaryRow& row);

/// A table of rays, time and energy a frame by kind of ray; empty where nothing but camera rays was
/// traced.
std::string ray_table(const std::vector<energy::SummaryRow>& rows);

}  // namespace encore::app
