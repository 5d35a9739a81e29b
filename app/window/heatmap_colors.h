#pragma once

#include "accel/counters.h"
#include "app/window/pane_output.h"
#include "energy/provenance.h"
#include "ui/settings.h"

#include <optional>
#include <span>

namespace encore::app {

/// Draws what each ray cost into `screen`, whose size is that of the counters, as the settings say.
/// Energy needs the frame's joules, which are shared among the pixels by the settings' weights;
/// without them the picture stays black and the view says why there are none.
ui::HeatmapView heatmap_colors(std::span<const accel::TraceCounters> counters,
                               const ui::HeatmapSettings& settings,
                               std::optional<double> frame_joules,
                               const energy::Provenance& frame_energy, ScreenPicture& screen);

}  // namespace encore::app
