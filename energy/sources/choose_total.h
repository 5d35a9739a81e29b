#pragma once

#include "energy/sources/power_source.h"

#include <cstddef>
#include <vector>

namespace encore::energy {

/// Which of these sources may be added to one total: no two of which one holds the other, no two
/// that see the same hardware. Sums processor packages, memory and discrete GPUs where there are
/// counters for them, since those resolve short phases; else takes a meter, else the battery, else
/// the rest in the order given. Simulated sources and models only if nothing else is there.
/// Indices into `sources`, ascending.
std::vector<std::size_t> choose_total(const std::vector<SourceInfo>& sources);

}  // namespace encore::energy
