#pragma once

#include "energy/attribution/attribution.h"
#include "energy/session.h"

#include <string>
#include <vector>

namespace encore::app {

/// Puts what was attributed to a configuration into its summary, its counters of energy (joules a
/// Mray, a pixel, energy-delay product) included.
void add_energy(const energy::Attribution& total, energy::SummaryRow& row);

/// The rows of phases.csv of one source: each phase that ran, then "idle", "remainder" and "all".
std::vector<energy::PhaseRow> phase_rows(const energy::Attribution& attribution,
                                         const std::string& source, energy::Origin origin,
                                         const std::vector<energy::KeyValue>& configuration);

}  // namespace encore::app
