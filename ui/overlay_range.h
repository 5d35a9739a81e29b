#pragma once

#include "accel/inspect/node_measures.h"
#include "ui/settings.h"

#include <array>

namespace encore::ui {

/// The values that the ends of the overlay's palette stand for: of depths the first and the last
/// that are drawn, else the 1st and the 99th percentile. The second is never below the first.
std::array<float, 2> overlay_range(const OverlaySettings& settings,
                                   const accel::NodeValues& values);

}  // namespace encore::ui
