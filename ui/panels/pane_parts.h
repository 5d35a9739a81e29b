#pragma once

#include "ui/panels/panels.h"

#include <imgui.h>

#include <cstddef>
#include <string>

namespace encore::ui {

// What a pane is made of; internal to ui/panels.

/// What every part of a pane reads and edits.
struct PaneContext {
  std::size_t pane = 0;
  const View& view;
  UiState& state;
  Commands& commands;

  [[nodiscard]] const PaneView& shown() const { return view.panes.at(pane); }
  [[nodiscard]] PaneSettings& settings() const { return state.settings.panes.at(pane); }
  /// "pane.0.<part>": a widget's name in the map.
  [[nodiscard]] std::string name(const char* part) const;
};

/// The same for all panes, whatever they show, so that pictures of the same area have the same
/// size.
float pane_header_height();
/// From one line of figures to the next.
float pane_header_line();
void draw_pane_header(const Rect& area, const PaneContext& context);
/// Time, joules, rays and frames of the last frame in two lines, the first ones where there is not
/// room for all, and at their right end what passes: whose slot it is, that a picture is refined.
void draw_pane_figures(const Rect& area, const PaneContext& context);
/// What the device is called: "CPU", "GPU", "RASTER".
const char* device_title(PaneDevice device);
ImVec4 device_color(PaneDevice device);

/// Tells, once, that the mouse has left a pane's picture.
void forget_hover(std::size_t pane, UiState& state, Commands& commands);
/// In the place of all panes, when every one is off.
void draw_no_panes(const Rect& area, UiState& state);

/// Work under way, and what stands in the place of a picture: in the middle or at the top.
void draw_pane_state(const Rect& room, const PaneContext& context);
/// What the colours of a heatmap or difference mean.
void draw_pane_legend(const Rect& room, const PaneContext& context);
/// What is known of the pixel under the mouse, in the corner that the mouse is not in.
void draw_hover_box(const Rect& room, const PixelView& pixel);

/// A small ground for text and widgets over a picture; to be ended with end_card(), whatever it
/// returns. `height` is that of what it holds.
bool begin_card(const char* id, const Rect& area);
void end_card();
/// The padding around what a card holds.
float card_padding();

/// Shows a texture, or dark ground where there is none.
void draw_picture(const Rect& picture, std::uint64_t texture);
/// The pixels of the screen that an area covers.
UiState::Area pixels_of(const Rect& area);
/// Of the scene, for speeds; 0 if it is not known.
double scene_size(const View& view);
/// Buttons for whose structure is inspected, on the line at the cursor, which stays on that line.
void draw_pane_switch(const char* where, UiState& state);
/// Writes down whether a camera of the panes moves.
void note_moving(UiState& state);

}  // namespace encore::ui
