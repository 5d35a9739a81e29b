#pragma once

#include "ui/settings.h"

#include <string>

namespace encore::ui {

/// What the windows of sessions and of power sources keep between frames.
struct SessionUiState {
  std::string annotation;  ///< in the field beside the recorder
  EnergySettings energy;   ///< in the dialog, not yet applied
};

}  // namespace encore::ui
