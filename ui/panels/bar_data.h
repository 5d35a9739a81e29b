#pragma once

#include "ui/plot/bar_layout.h"
#include "ui/view.h"

#include <vector>

namespace encore::ui {

/// Time beside energy of each configuration, a part a phase (the thesis' figures 32 to 35). A
/// phase's energy that is unavailable stays so; where the total is known, what is left of it stands
/// as one part "not told apart".
BarData configuration_bars(const std::vector<ConfigurationView>& configurations);

/// Session A beside B: seconds and joules an operation.
BarData comparison_bars(const SessionView& session);

}  // namespace encore::ui
