#pragma once

#include "app/measuring_options.h"
#include "energy/attribution/busy_timeline.h"
#include "energy/provenance.h"
#include "energy/sources/power_source.h"

#include <memory>
#include <string>
#include <vector>

namespace encore::app {

/// The power sources of a run, opened, and which of them make the figures.
struct PowerSources {
  std::vector<std::unique_ptr<energy::PowerSource>> sources;
  /// Those whose energies are added, as indices; empty if there are none.
  std::vector<std::size_t> total;
  /// Of the total: which sensors, or why there is nothing and what to do about it.
  energy::Provenance provenance;
};

/// Opens what --source and --model ask for. Without either, all usable sensors of the machine;
/// none at all is no error then. `live` tells modelled and simulated sources what is busy; it must
/// outlive them. Throws energy::SensorError if a source that was named cannot be used, UsageError
/// for a wrong name.
PowerSources open_power_sources(const MeasuringOptions& options, const energy::LiveBusyTime& live);

/// phase_watts() of what --model states. Throws UsageError for a faulty model.
std::optional<energy::PerPhase<double>> phase_watts(const MeasuringOptions& options);

/// Names of the total's sources: "rapl:package-0 + nvml:0".
std::string total_name(const PowerSources& sources);

}  // namespace encore::app
