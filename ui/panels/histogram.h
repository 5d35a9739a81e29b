#pragma once

#include "ui/layout.h"
#include "ui/settings.h"
#include "ui/view.h"

#include <string>

namespace encore::ui {

/// Width in pixels at the cursor: how many pixels have which value, and the ends of the palette's
/// range, which can be dragged (that turns the automatic range off). Widgets are named
/// `<name>.histogram`, `<name>.low` and `<name>.high`. Draws nothing without bins.
void draw_heatmap_histogram(const std::string& name, float width, float height,
                            const HeatmapView& heatmap, HeatmapSettings& settings);
/// The palette as a bar.
void draw_palette_bar(float width, float height, int palette);
/// A value of a heatmap with its unit: "12 steps", "1.2 nJ".
std::string heatmap_text(double value, const std::string& unit);

}  // namespace encore::ui
