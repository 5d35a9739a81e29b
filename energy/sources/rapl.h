#pragma once

#include "energy/sources/discovery.h"

#include <functional>
#include <vector>

namespace encore::energy {

/// As find_rapl(root), with the pause between the readings that tell mirrored zones from true ones
/// in the caller's hands. It is called only if two packages show nearly the same value.
std::vector<Finding> find_rapl(const SensorRoot& root, const std::function<void()>& pause);

}  // namespace encore::energy
