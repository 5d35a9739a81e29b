#include "ui/overlay_range.h"

#include <algorithm>

namespace encore::ui {

std::array<float, 2> overlay_range(const OverlaySettings& settings,
                                   const accel::NodeValues& values) {
  if (settings.color != OverlayColor::depth) return {values.percentile_1, values.percentile_99};
  const auto first = static_cast<float>(std::max(settings.first_depth, 0));
  const auto last = std::min(static_cast<float>(settings.last_depth), values.max);
  return {first, std::max(first, last)};
}

}  // namespace encore::ui
