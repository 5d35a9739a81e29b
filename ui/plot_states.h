#pragma once

#include "ui/plot/error_chart.h"
#include "ui/plot/stacked_bars.h"
#include "ui/plot/strip_chart.h"

#include <optional>
#include <string>

namespace encore::ui {

/// What the user chose in the plots below the panes.
struct PlotStates {
  struct Charts {
    StripState power;
    BarState bars;
    ErrorState errors;
    std::optional<std::string> configuration;  ///< whose error is shown; nothing: the newest ones
  };
  Charts now;
  Charts session;
  BarState comparison;
  bool comparison_table = false;  ///< where chart and table do not both have room
  std::string session_folder;     ///< whose charts `session` and `comparison` are
  std::string csv_file;           ///< as it is typed to save the bars
};

}  // namespace encore::ui
