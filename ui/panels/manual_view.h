#pragma once

#include "ui/ui_state.h"

namespace encore::ui {

/// The manual inside the window that is open: search, chapters, text.
void draw_manual(UiState& state);

}  // namespace encore::ui
