#pragma once

#include "app/window/busy_marks.h"
#include "energy/provenance.h"
#include "energy/sampling/sampler.h"
#include "energy/session.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace encore::app {

/// The power sources that are read together until the user picks others. Whoever holds one may go
/// on reading its traces after that.
struct PowerSet {
  std::uint64_t generation = 0;                ///< counts the sets that were opened, from 1
  energy::Seconds since;                       ///< the clock's time at which reading began
  std::shared_ptr<BusyMarks> busy;             ///< outlives the sources that look at it
  std::vector<energy::SessionSource> sources;  ///< in the order of the sampler's
  std::vector<std::size_t> total;              ///< those whose energies are added
  energy::Provenance provenance;               ///< of the total, or why there is nothing
  std::string total_name;                      ///< "rapl:package-0 + nvml:0"
  std::unique_ptr<energy::Sampler> sampler;    ///< null without sources
};

}  // namespace encore::app
