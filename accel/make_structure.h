#pragma once

#include "accel/acceleration_structure.h"
#include "accel/settings.h"

#include <memory>

namespace encore::accel {

/// Makes an empty structure: the only place that knows the concrete types. A further structure is
/// a new folder, its settings and name in settings.h, and one line here.
std::unique_ptr<AccelerationStructure> make_structure(const StructureSpec& spec);

}  // namespace encore::accel
