#include "ui/panels/menu_parts.h"
#include "ui/widget_map.h"

#include <fmt/format.h>
#include <imgui.h>

namespace encore::ui {

namespace {

const char* pane_label(std::size_t pane) {
  return pane == 0 ? "Left pane" : "Right pane";
}

void draw_overlay_toggles(OverlaySettings& overlay) {
  toggle_entry({.name = "menu.structure.leaves",
                .label = "Leaves and cells",
                .tip = "Draws what holds triangles."},
               overlay.leaves);
  toggle_entry({.name = "menu.structure.inner",
                .label = "Inner nodes",
                .tip = "Draws what holds other nodes."},
               overlay.inner_nodes);
  toggle_entry({.name = "menu.structure.empty",
                .label = "Empty leaves",
                .tip = "Draws leaves of kd-trees that hold nothing."},
               overlay.empty_leaves);
  toggle_entry({.name = "menu.structure.boxes", .label = "Boxes", .tip = "Draws the nodes' boxes."},
               overlay.boxes);
  toggle_entry({.name = "menu.structure.planes",
                .label = "Split planes",
                .tip = "Draws where kd-trees divide, clipped to the node."},
               overlay.planes);
  toggle_entry({.name = "menu.structure.filled",
                .label = "Filled",
                .tip = "Fills the boxes with a thin colour."},
               overlay.filled);
  toggle_entry({.name = "menu.structure.section",
                .label = "Section",
                .tip = "Cuts away what lies above a plane; its place is in the left column."},
               overlay.section);
  toggle_entry({.name = "menu.structure.subtree",
                .label = "Selected subtree only",
                .tip = "Draws only what lies below the selected node."},
               overlay.selected_subtree);
}

void draw_recording_entries(const MenuContext& context) {
  const RecorderView& recorder = context.view.recorder;
  const bool paused = recorder.state == RecorderView::State::paused;
  const bool on = paused || recorder.state == RecorderView::State::recording;
  action_entry(context, Action::record,
               {.name = "menu.measure.record",
                .label = on ? "End the recording" : "Record",
                .tip = "Writes what is measured to a session folder while it goes on."});
  if (menu_entry({.name = "menu.measure.pause",
                  .label = paused ? "Go on recording" : "Pause the recording",
                  .tip = "A pause leaves a gap in the session.",
                  .enabled = on})) {
    context.commands.push_back(PauseRecording{!paused});
  }
  action_entry(context, Action::annotate,
               {.name = "menu.measure.annotate",
                .label = "Annotate…",
                .tip = "Puts words at this moment of the recording."});
}

}  // namespace

void draw_edit_menu(const MenuContext& context) {
  const History& history = context.state.shell.history;
  const auto with = [](const char* word, const std::string& name) {
    return name.empty() ? std::string(word) : fmt::format("{} “{}”", word, name);
  };
  action_entry(context, Action::undo,
               {.name = "menu.edit.undo",
                .label = with("Undo", history.undo_name()) + "###undo",
                .tip = "Takes back the last change of a setting. Cameras are not settings."});
  action_entry(context, Action::redo,
               {.name = "menu.edit.redo",
                .label = with("Redo", history.redo_name()) + "###redo",
                .tip = "Makes again what was taken back."});
  ImGui::Separator();
  action_entry(context, Action::copy_camera,
               {.name = "menu.edit.copy_camera",
                .label = "Copy camera",
                .tip = "As text, which scene files and encore render --camera take."});
  action_entry(context, Action::paste_camera,
               {.name = "menu.edit.paste_camera",
                .label = "Paste camera",
                .tip = "Takes the camera from such a text."});
  ImGui::Separator();
  if (menu_entry({.name = "menu.edit.defaults",
                  .label = "All settings as at first",
                  .tip = "Panes, overlay, heatmap, measuring and energy; can be undone."})) {
    const bool sources = context.state.settings.energy != default_settings().energy;
    context.state.settings = default_settings();
    if (sources) context.commands.push_back(ApplyEnergy{});
  }
}

void draw_structure_menu(const MenuContext& context) {
  UiState& state = context.state;
  OverlaySettings& overlay = state.settings.overlay;
  action_entry(context, Action::overlay,
               {.name = "menu.structure.overlay",
                .label = "Overlay",
                .tip = "Draws the structure over the pictures.",
                .selected = overlay.show});
  if (begin_menu("Overlay shows", "menu.structure.shows")) {
    draw_overlay_toggles(overlay);
    ImGui::EndMenu();
  }
  action_entry(context, Action::structure_view,
               {.name = "menu.structure.view",
                .label = "3D view",
                .tip = "The inspected structure alone, with a camera of its own.",
                .selected = state.structure_view});
  ImGui::Separator();
  for (std::size_t pane = 0; pane < kPaneCount; ++pane) {
    const bool on = state.settings.panes[pane].device != PaneDevice::off;
    if (menu_entry({.name = fmt::format("menu.structure.inspect.{}", pane),
                    .label = fmt::format("Inspect the {} pane", pane == 0 ? "left" : "right"),
                    .tip = "Whose structure the right column and the 3D view show.",
                    .enabled = on,
                    .selected = state.inspected_pane == pane})) {
      state.inspected_pane = pane;
      state.selected_node.reset();
    }
  }
  ImGui::Separator();
  for (std::size_t pane = 0; pane < kPaneCount; ++pane) {
    const bool on = state.settings.panes[pane].device != PaneDevice::off;
    if (menu_entry({.name = fmt::format("menu.structure.rebuild.{}", pane),
                    .label = fmt::format("Build again: {}", pane_label(pane)),
                    .tip = "Builds though nothing changed, or goes on after a cancel.",
                    .enabled = on && context.view.scene.scene != nullptr})) {
      context.commands.push_back(Rebuild{pane});
    }
  }
  if (menu_entry({.name = "menu.structure.clear_pick",
                  .label = "Leave the ray",
                  .tip = "Forgets the ray that was picked.",
                  .enabled = context.view.pick.has_value(),
                  .keys = shortcut_text(Action::escape)})) {
    context.commands.push_back(ClearPick{});
  }
}

void draw_measure_menu(const MenuContext& context) {
  UiState& state = context.state;
  action_entry(context, Action::measure,
               {.name = "menu.measure.mode",
                .label = "Measure mode",
                .tip = "The panes trace by turns with rests between, and figures are collected.",
                .selected = state.measuring});
  action_entry(context, Action::accuracy,
               {.name = "menu.measure.accuracy",
                .label = "Accuracy…",
                .tip = "How far pictures and hits are off, against what a frame costs.",
                .selected = state.accuracy.open});
  if (menu_entry({.name = "menu.measure.clear",
                  .label = "Forget the results",
                  .tip = "Starts the figures of measure mode afresh."})) {
    context.commands.push_back(ClearResults{});
  }
  ImGui::Separator();
  draw_recording_entries(context);
  ImGui::Separator();
  toggle_entry({.name = "menu.measure.sessions",
                .label = "Sessions",
                .tip = "The session that is open, and what it is compared with."},
               state.sessions_open);
  const bool session = !context.view.session.folder.empty();
  toggle_entry({.name = "menu.measure.show_session",
                .label = "Plots show the session",
                .tip = "Instead of the present.",
                .enabled = session},
               state.show_session);
  ImGui::Separator();
  toggle_entry({.name = "menu.measure.doctor",
                .label = "Sensors",
                .tip = "What sensors this machine has, and what is in the way of the others."},
               state.doctor_open);
  if (menu_entry({.name = "menu.measure.energy",
                  .label = "Source of watts…",
                  .tip = "Chooses a sensor, or computes joules from two numbers."})) {
    state.dialog = Dialog::energy;
  }
}

void draw_help_menu(const MenuContext& context) {
  action_entry(context, Action::manual,
               {.name = "menu.help.manual", .label = "Manual", .tip = "Opens it in the window."});
  action_entry(context, Action::shortcuts,
               {.name = "menu.help.shortcuts",
                .label = "Shortcuts",
                .tip = "All keys, and what the mouse does."});
  ImGui::Separator();
  if (menu_entry({.name = "menu.help.about",
                  .label = "About ENCORE",
                  .tip = "Versions of the program and of what it runs on."})) {
    context.state.dialog = Dialog::about;
  }
}

}  // namespace encore::ui
