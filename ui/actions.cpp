#include "accel/inspect/node_table.h"
#include "scene/camera_motion.h"
#include "scene/camera_text.h"
#include "scene/diagnostics.h"
#include "ui/shortcuts.h"
#include "ui/style.h"

#include <fmt/format.h>
#include <imgui.h>

namespace encore::ui {

namespace {

const std::optional<scene::Camera>* stored_camera(const View& view, const UiState& state,
                                                  int number) {
  if (!view.scene.scene || number < 1 || number > 9) return nullptr;
  const auto found = state.preferences.bookmarks.find(view.scene.scene->name);
  if (found == state.preferences.bookmarks.end()) return nullptr;
  const auto& camera = found->second[static_cast<std::size_t>(number - 1)];
  return camera ? &camera : nullptr;
}

void recall(const View& view, UiState& state, int number) {
  if (const auto* camera = stored_camera(view, state, number)) {
    state.camera = **camera;
    return;
  }
  tell(state, fmt::format("no camera is stored under {0}; Ctrl+{0} stores this one", number));
}

void store(const View& view, UiState& state, int number) {
  if (!view.scene.scene || number < 1 || number > 9) return;
  const std::string& scene = view.scene.scene->name;
  state.preferences.bookmarks[scene][static_cast<std::size_t>(number - 1)] = state.camera;
  tell(state, fmt::format("camera stored under {}", number));
}

void paste_camera(UiState& state) {
  const char* text = ImGui::GetClipboardText();
  if (text == nullptr || *text == '\0') {
    tell(state, "nothing was copied; Ctrl+C copies the camera", true);
    return;
  }
  try {
    state.camera = scene::parse_camera_text(text, state.camera);
  } catch (const scene::InputError& error) {
    tell(state, fmt::format("no camera in what was copied: {}", error.what()), true);
  }
}

/// The selected node's box, else the scene's; empty while neither is known.
scene::Bounds focused_box(const View& view, const UiState& state) {
  const PaneView& pane = view.panes[state.inspected_pane];
  if (state.selected_node && pane.nodes && *state.selected_node < pane.nodes->size()) {
    return (*pane.nodes)[*state.selected_node].bounds;
  }
  return view.scene.info ? view.scene.info->bounds : scene::Bounds{};
}

void focus(const View& view, UiState& state) {
  const UiState::Area& area = state.picture_areas[state.inspected_pane];
  const double aspect =
      area.width > 0 && area.height > 0 ? double(area.width) / double(area.height) : 1.0;
  state.camera = scene::focus(state.camera, focused_box(view, state), aspect);
}

void step_back(bool redo, UiState& state, Commands& commands) {
  History& history = state.shell.history;
  const std::string name = redo ? history.redo_name() : std::string();
  const auto settings = redo ? history.redo(state.settings) : history.undo(state.settings);
  if (!settings) {
    tell(state, redo ? "nothing to redo" : "nothing to undo");
    return;
  }
  const bool sources = settings->energy != state.settings.energy;
  state.settings = *settings;
  if (sources) commands.push_back(ApplyEnergy{});
  tell(state, fmt::format("{}: {}", redo ? "redone" : "undone", redo ? name : history.redo_name()));
}

/// The innermost thing goes first: a dialog, the ray, the work.
void escape(const View& view, UiState& state, Commands& commands) {
  if (state.dialog != Dialog::none) {
    state.dialog = Dialog::none;
  } else if (view.pick) {
    commands.push_back(ClearPick{});
  } else if (view.scene.loading.active && view.scene.loading.cancellable) {
    commands.push_back(CancelWork{});
  } else {
    for (std::size_t pane = 0; pane < kPaneCount; ++pane) {
      const WorkView& work = view.panes[pane].work;
      if (work.active && work.cancellable) commands.push_back(CancelWork{pane});
    }
  }
}

void scale_by(const View& view, UiState& state, int direction) {
  const float now = ui_scale(state.preferences, view.window.monitor_scale);
  state.preferences.ui_scale = next_scale(now, direction);
}

void camera_action(Action action, const View& view, UiState& state, Commands& commands,
                   int number) {
  if (action == Action::focus) focus(view, state);
  if (action == Action::reset_camera && view.scene.scene) state.camera = view.scene.scene->camera;
  if (action == Action::orthographic) state.camera = scene::toggle_projection(state.camera);
  if (action == Action::recall_camera) recall(view, state, number);
  if (action == Action::store_camera) store(view, state, number);
  if (action == Action::copy_camera) {
    commands.push_back(CopyText{scene::camera_text(state.camera), "camera copied"});
  }
  if (action == Action::paste_camera) paste_camera(state);
}

void toggle_dialog(UiState& state, Dialog dialog) {
  state.dialog = state.dialog == dialog ? Dialog::none : dialog;
}

}  // namespace

bool available(Action action, const View& view, const UiState& state, int number) {
  const RecorderView::State recorder = view.recorder.state;
  switch (action) {
    case Action::reload_scene:
    case Action::reset_camera:
    case Action::store_camera:
      return view.scene.scene != nullptr;
    case Action::recall_camera:
      return stored_camera(view, state, number) != nullptr;
    case Action::focus:
      return !focused_box(view, state).empty();
    case Action::play:
      return view.scene.animated;
    case Action::undo:
      return state.shell.history.can_undo();
    case Action::redo:
      return state.shell.history.can_redo();
    case Action::annotate:
      return recorder == RecorderView::State::recording || recorder == RecorderView::State::paused;
    default:
      return true;
  }
}

void perform(Action action, const View& view, UiState& state, Commands& commands, int number) {
  switch (action) {
    case Action::manual:
      return toggle_dialog(state, Dialog::manual);
    case Action::shortcuts:
      return toggle_dialog(state, Dialog::shortcuts);
    case Action::open_scene:
      state.dialog = Dialog::open_scene;
      return;
    case Action::reload_scene:
      if (view.scene.scene) commands.push_back(ReloadScene{});
      return;
    case Action::save_window:
      commands.push_back(SavePicture{});
      return;
    case Action::quit:
      commands.push_back(Quit{});
      return;
    case Action::undo:
    case Action::redo:
      return step_back(action == Action::redo, state, commands);
    case Action::play:
      if (view.scene.animated) state.settings.animation.playing = !state.settings.animation.playing;
      return;
    case Action::structure_view:
      state.structure_view = !state.structure_view;
      return;
    case Action::overlay:
      state.settings.overlay.show = !state.settings.overlay.show;
      return;
    case Action::measure:
      state.measuring = !state.measuring;
      return;
    case Action::record:
      if (view.recorder.state == RecorderView::State::recording ||
          view.recorder.state == RecorderView::State::paused) {
        commands.push_back(StopRecording{});
      } else {
        commands.push_back(StartRecording{});
      }
      return;
    case Action::annotate:
      if (available(action, view, state)) {
        state.dialog = Dialog::annotate;
      } else {
        tell(state, "annotations belong to a recording; Ctrl+R begins one");
      }
      return;
    case Action::accuracy:
      state.accuracy.open = !state.accuracy.open;
      return;
    case Action::full_screen:
      commands.push_back(ToggleFullScreen{});
      return;
    case Action::scale_up:
      return scale_by(view, state, 1);
    case Action::scale_down:
      return scale_by(view, state, -1);
    case Action::scale_reset:
      state.preferences.ui_scale = 0.0F;
      return;
    case Action::escape:
      return escape(view, state, commands);
    default:
      return camera_action(action, view, state, commands, number);
  }
}

}  // namespace encore::ui
