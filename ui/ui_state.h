#pragma once

#include "scene/camera.h"
#include "ui/accuracy_state.h"
#include "ui/inspect_state.h"
#include "ui/layout.h"
#include "ui/plot_states.h"
#include "ui/session_state.h"
#include "ui/settings.h"
#include "ui/shell_state.h"

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace encore::ui {

enum class Theme { dark, light };

/// A message that goes away by itself.
struct Notice {
  std::string text;
  bool problem = false;
  double since_s = 0.0;  ///< of ImGui::GetTime(); 0: not shown yet
};

/// Kept from run to run beside Settings.
struct Preferences {
  Theme theme = Theme::dark;
  float ui_scale = 0.0F;  ///< 0: as the monitor says
  LayoutSettings layout;
  int window_width = 1600;
  int window_height = 960;
  std::vector<std::string> recent_scenes;  ///< the latest first
  std::vector<std::string> recent_sessions;
  std::string last_folder;  ///< of the file browser
  int up_axis = 1;          ///< 0, 1, 2: x, y, z
  /// Cameras stored under 1 to 9, by scene name.
  std::map<std::string, std::array<std::optional<scene::Camera>, 9>> bookmarks;

  friend bool operator==(const Preferences&, const Preferences&) = default;
};

enum class Dialog {
  none,
  shortcuts,
  manual,
  about,
  open_scene,
  open_session,
  compare_session,
  export_session,
  annotate,
  energy
};

/// What panels edit. The application reads it between frames and does what it says.
struct UiState {
  Settings settings;
  Preferences preferences;

  scene::Camera camera;                      ///< of both panes
  std::optional<scene::Camera> free_camera;  ///< of the 3D view; nothing: not moved yet
  bool camera_moving = false;                ///< a drag or a key holds on: coarse pictures do
  double time_s = 0.0;                       ///< of the animation
  bool measuring = false;                    ///< measure mode
  bool structure_view = false;               ///< the 3D view is open
  std::size_t inspected_pane = 0;  ///< whose structure the right column and the 3D view show
  std::optional<std::uint32_t> selected_node;  ///< in the inspected pane's node table
  std::size_t ray_step = 0;                    ///< of the picked ray
  bool show_session = false;                   ///< the plots show the opened session instead of now
  bool bars_normalised = false;
  Dialog dialog = Dialog::none;
  /// The pixels that the panes and the 3D view have for a picture; the panels say so.
  struct Area {
    int width = 0;
    int height = 0;
  };
  std::array<Area, kPaneCount + 1> picture_areas{};
  Rect plots_area;  ///< of the three plots together, in the window
  bool doctor_open = false;
  bool sessions_open = false;
  std::deque<Notice> notices;
  ShellState shell;
  InspectState inspect;
  PlotStates plots;
  SessionUiState sessions;
  AccuracyUiState accuracy;
};

/// Adds a notice; of many, the oldest go.
void tell(UiState& state, std::string text, bool problem = false);

/// Puts a file first in a list of recent ones, which holds it once and at most `most` in all.
void remember(std::vector<std::string>& recent, const std::string& file, std::size_t most = 12);

}  // namespace encore::ui
