#pragma once

#include "ui/command.h"
#include "ui/plot_states.h"
#include "ui/ui_state.h"
#include "ui/view.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace encore::ui {

// What the three plots share: where their data come from, and their title rows.

/// What the plots show now.
struct ShownPlots {
  const PlotData& data;
  PlotStates::Charts& charts;
  bool session = false;
};
/// Of the opened session if that is wanted and one is open, else of the present. A session's charts
/// begin afresh when another one is opened.
ShownPlots shown_plots(const View& view, UiState& state);
/// Whether the bars show what two sessions differ in.
bool comparing(const View& view, const UiState& state);

/// The title of a plot; `help` is its tooltip.
void plot_title(std::string_view plot, const char* title, const char* help);
/// Words in the title row, shortened to the room before `reserved` pixels at its right end. Nothing
/// where there is no room.
void plot_words(std::string_view name, const std::string& text, const char* help, float reserved);

/// A small button of a title row; its widget is `<plot>.<name>`.
struct PlotTool {
  const char* name = "";
  const char* label = "";
  const char* help = "";
  bool enabled = true;
  bool on = false;  ///< drawn as chosen
};
float tools_width(std::span<const PlotTool> tools);
/// Buttons in a row from the cursor on; the place of the one that was pressed.
std::optional<std::size_t> draw_tools(std::string_view plot, std::span<const PlotTool> tools);
/// The same at the right end of the row, or in a row of their own where they do not fit.
std::optional<std::size_t> draw_end_tools(std::string_view plot, std::span<const PlotTool> tools);

/// The colour of a phase's name; that of the remainder for others.
PlotColor phase_color(std::string_view phase);
/// That of a part of rendering.
PlotColor ray_color(scene::RayKind kind);

}  // namespace encore::ui
