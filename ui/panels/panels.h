#pragma once

#include "ui/command.h"
#include "ui/layout.h"
#include "ui/ui_state.h"
#include "ui/view.h"

#include <cstddef>

namespace encore::ui {

// The parts of the window. Each reads `view`, edits `state` and adds to `commands` what it asks
// for; none draws outside the rectangle that it is given. All of them run between
// ImGui::NewFrame() and ImGui::Render().

/// The whole window: menu, columns, panes, plots, status line, dialogs, notices, shortcuts.
void draw_window(const View& view, UiState& state, Commands& commands);

void draw_menu(const View& view, UiState& state, Commands& commands);
void draw_status(const Rect& area, const View& view, UiState& state, Commands& commands);
void draw_dialogs(const View& view, UiState& state, Commands& commands);
void draw_notices(const Layout& layout, UiState& state);
/// Keys that mean something in the whole window.
void handle_shortcuts(const View& view, UiState& state, Commands& commands);

/// The left column: scene, animation, structure, policy, resolution, overlay, heatmap, measuring.
void draw_settings_column(const Rect& area, const View& view, UiState& state, Commands& commands);
/// The right column: statistics, tree, selection, the picked ray.
void draw_structure_column(const Rect& area, const View& view, UiState& state, Commands& commands);

/// One tracer's picture; mouse and keys move the camera.
void draw_pane(std::size_t pane, const Rect& area, const View& view, UiState& state,
               Commands& commands);
/// The structure in a free 3D view.
void draw_structure_view(const Rect& area, const View& view, UiState& state, Commands& commands);

/// The plots: of now, or of the opened session.
void draw_power_plot(const Rect& area, const View& view, UiState& state, Commands& commands);
void draw_bars_plot(const Rect& area, const View& view, UiState& state, Commands& commands);
void draw_error_plot(const Rect& area, const View& view, UiState& state, Commands& commands);

/// Windows of their own.
void draw_sessions_window(const View& view, UiState& state, Commands& commands);
void draw_doctor_window(const View& view, UiState& state, Commands& commands);
/// Error against run time: what to compare, the results as a table and as a scatter.
void draw_accuracy_window(const View& view, UiState& state, Commands& commands);
/// Where watts come from; drawn while it is the dialog.
void draw_energy_dialog(const View& view, UiState& state, Commands& commands);

}  // namespace encore::ui
