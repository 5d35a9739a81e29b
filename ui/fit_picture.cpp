#include "ui/layout.h"

#include <algorithm>
#include <cmath>

namespace encore::ui {

Rect fit_picture(const Rect& area, int width, int height) {
  if (area.empty() || width <= 0 || height <= 0) return {};
  const float scale =
      std::min(area.width / static_cast<float>(width), area.height / static_cast<float>(height));
  Rect rect;
  rect.width = std::max(std::floor(static_cast<float>(width) * scale + 0.01F), 1.0F);
  rect.height = std::max(std::floor(static_cast<float>(height) * scale + 0.01F), 1.0F);
  rect.x = std::floor(area.x + (area.width - rect.width) / 2.0F);
  rect.y = std::floor(area.y + (area.height - rect.height) / 2.0F);
  return rect;
}

}  // namespace encore::ui
