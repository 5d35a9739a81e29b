#pragma once

#include "ui/layout.h"

namespace encore::ui {

// What dragging a splitter does to the settings. `grabbed` are the settings when the mouse took
// hold, `delta` is how many pixels it has moved since (to the right or down), so that a mouse that
// went too far and comes back does not leave the splitter behind. What is set is what make_layout()
// then shows: never more than there is room for. Without that splitter nothing changes.

LayoutSettings drag_left(const LayoutSettings& grabbed, const LayoutInput& input, float delta);
LayoutSettings drag_right(const LayoutSettings& grabbed, const LayoutInput& input, float delta);
LayoutSettings drag_plots(const LayoutSettings& grabbed, const LayoutInput& input, float delta);
LayoutSettings drag_plot_split(const LayoutSettings& grabbed, const LayoutInput& input,
                               float delta);
LayoutSettings drag_pane_split(const LayoutSettings& grabbed, const LayoutInput& input,
                               float delta);

/// Whether the panes lie one above the other: then their splitter is dragged up and down.
bool panes_stacked(const Layout& layout);

}  // namespace encore::ui
