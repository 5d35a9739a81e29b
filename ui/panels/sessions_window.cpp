#include "ui/panels/panels.h"
#include "ui/panels/session_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/plot/value_text.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <string>

namespace encore::ui {

namespace {

using Recorder = RecorderView::State;

/// A button with its name and tooltip; true when pressed.
bool button(const char* label, const char* name, const char* help, bool enabled = true) {
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::Button(label);
  ImGui::EndDisabled();
  note_widget(name, enabled ? "" : "disabled");
  tooltip(help);
  return pressed;
}

void heading(const char* text) {
  ImGui::Spacing();
  ImGui::PushFont(heading_font());
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
  ImGui::Separator();
}

const char* recorder_word(Recorder state) {
  switch (state) {
    case Recorder::off:
      return "off";
    case Recorder::recording:
      return "recording";
    case Recorder::paused:
      return "paused";
    case Recorder::failed:
      return "failed";
  }
  return "";
}

void draw_recorder_buttons(const RecorderView& recorder, Commands& commands) {
  const bool on = recorder.state == Recorder::recording || recorder.state == Recorder::paused;
  if (!on) {
    if (button("Record", "sessions.record",
               "Writes what is measured to a new session folder while it goes on.")) {
      commands.push_back(StartRecording{});
    }
    return;
  }
  const bool paused = recorder.state == Recorder::paused;
  if (button(paused ? "Go on" : "Pause", paused ? "sessions.resume" : "sessions.pause",
             "A pause leaves a gap in the session's times.")) {
    commands.push_back(PauseRecording{!paused});
  }
  ImGui::SameLine();
  if (button("Stop", "sessions.stop", "Ends the session; its folder is then complete.")) {
    commands.push_back(StopRecording{});
  }
}

void draw_annotation(UiState& state, Commands& commands) {
  std::string& text = state.sessions.annotation;
  ImGui::SetNextItemWidth(std::max(8.0F * ImGui::GetFontSize(),
                                   ImGui::GetContentRegionAvail().x - 7.0F * ImGui::GetFontSize()));
  bool done = ImGui::InputTextWithHint("##annotation", "what happens now", &text,
                                       ImGuiInputTextFlags_EnterReturnsTrue);
  note_widget("sessions.annotation", text);
  tooltip("One line that stands in the plots and, while recording, in the session.");
  ImGui::SameLine();
  done =
      button("Annotate", "sessions.annotate", "Puts these words at this moment.", !text.empty()) ||
      done;
  if (!done || text.empty()) return;
  commands.push_back(Annotate{text});
  text.clear();
}

void draw_recorder(const View& view, UiState& state, Commands& commands) {
  const RecorderView& recorder = view.recorder;
  const ThemeColors& colors = theme_colors(state.preferences.theme);
  heading("Recorder");
  draw_recorder_buttons(recorder, commands);
  ImGui::SameLine();
  std::string line = recorder_word(recorder.state);
  if (!recorder.folder.empty()) {
    line += fmt::format(": {}, {} rows, {}", duration_text(recorder.seconds),
                        count_text(recorder.rows), bytes_text(recorder.bytes));
  }
  ImGui::AlignTextToFramePadding();
  colored_text(recorder.state == Recorder::recording ? colors.good : colors.text,
               fitted(line, ImGui::GetContentRegionAvail().x));
  note_widget("sessions.recorder", recorder_word(recorder.state));
  tooltip(line + "\nTime that was recorded, rows of samples and frames, size of the files.");
  if (!recorder.folder.empty()) {
    wrapped_text(colors.dim_text, recorder.folder);
    note_widget("sessions.recorder_folder", recorder.folder);
    tooltip("The folder of the recording, or of the last one.");
  }
  if (!recorder.problem.empty()) {
    wrapped_text(colors.problem, recorder.problem);
    note_widget("sessions.recorder_problem", recorder.problem);
  }
  draw_annotation(state, commands);
}

void draw_reading(const SessionView& session, const ThemeColors& colors, Commands& commands) {
  if (session.reading.active) {
    const WorkView& work = session.reading;
    progress_bar(10.0F * ImGui::GetFontSize(), work.progress ? &*work.progress : nullptr);
    note_widget("sessions.progress",
                work.progress ? fmt::format("{:.0f} %", 100.0 * *work.progress) : "unknown");
    tooltip("How much of it is done, where that can be told.");
    ImGui::SameLine();
    ImGui::TextUnformatted(work.doing.c_str());
    if (work.cancellable) {
      ImGui::SameLine();
      if (button("Cancel", "sessions.cancel", "Ends this work; nothing half-done stays.")) {
        commands.push_back(CancelSession{});
      }
    }
  }
  if (!session.problem.empty()) {
    wrapped_text(colors.problem, session.problem);
    note_widget("sessions.problem", session.problem);
  }
}

void draw_open_buttons(const SessionView& session, UiState& state, Commands& commands) {
  const bool open = !session.folder.empty();
  if (button("Open…", "sessions.open", "Looks for a session's folder and shows it in the plots.")) {
    state.dialog = Dialog::open_session;
  }
  ImGui::SameLine();
  if (button("Compare with…", "sessions.compare",
             "Looks for a second session and says how far it differs from the open one.", open)) {
    state.dialog = Dialog::compare_session;
  }
  ImGui::SameLine();
  if (button("Export…", "sessions.export", "Copies the session's files to a new folder.", open)) {
    state.dialog = Dialog::export_session;
  }
  ImGui::SameLine();
  if (button("Close", "sessions.close", "The plots show the present again.", open)) {
    commands.push_back(CloseSession{});
  }
}

void draw_session(const SessionView& session, UiState& state) {
  const ThemeColors& colors = theme_colors(state.preferences.theme);
  if (session.folder.empty()) {
    wrapped_text(colors.dim_text, "No session is open.");
    note_widget("sessions.folder");
    return;
  }
  ImGui::TextUnformatted(
      fitted(session_name(session.folder), 0.6F * ImGui::GetContentRegionAvail().x).c_str());
  note_widget("sessions.folder", session.folder);
  tooltip(session.folder);
  ImGui::SameLine();
  colored_text(session.state == "complete" ? colors.good : colors.warning,
               fitted(session.state, ImGui::GetContentRegionAvail().x));
  note_widget("sessions.state", session.state);
  tooltip(session.state +
          "\nComplete: the recording was ended. Otherwise what was written until then is shown.");
  ImGui::Checkbox("Plots show it", &state.show_session);
  note_widget("sessions.show", state.show_session ? "on" : "off");
  tooltip("The plots show this session instead of the present.");
  if (!session.facts.empty() && ImGui::TreeNodeEx("Machine, plan and sensor")) {
    note_widget("sessions.facts", "open");
    for (const std::string& fact : session.facts) wrapped_text(fact);
    ImGui::TreePop();
  } else if (!session.facts.empty()) {
    note_widget("sessions.facts", "closed");
  }
}

void draw_comparison(const SessionView& session, UiState& state) {
  const ThemeColors& colors = theme_colors(state.preferences.theme);
  for (const std::string& warning : session.warnings) wrapped_text(colors.warning, warning);
  if (session.other_folder.empty()) return;
  heading("Comparison");
  wrapped_text(fmt::format("A: {}", session.folder));
  wrapped_text(fmt::format("B: {}", session.other_folder));
  if (session.changes.empty()) {
    wrapped_text(colors.warning, "No configuration is in both sessions.");
    note_widget("sessions.changes", "none");
    return;
  }
  const float rows = static_cast<float>(session.changes.size()) + 2.0F;
  const float height =
      std::min(rows * ImGui::GetTextLineHeightWithSpacing() * 1.15F, 16.0F * ImGui::GetFontSize());
  draw_changes("sessions.changes", session.changes, state.preferences.theme, height);
}

void draw_recent(UiState& state, Commands& commands) {
  const auto& recent = state.preferences.recent_sessions;
  if (recent.empty()) return;
  heading("Recent sessions");
  for (std::size_t i = 0; i < recent.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(fitted(recent[i], ImGui::GetContentRegionAvail().x).c_str())) {
      commands.push_back(OpenSession{recent[i]});
    }
    ImGui::PopID();
    if (widget_map_enabled()) note_widget(fmt::format("sessions.recent.{}", i), recent[i]);
    tooltip("Opens " + recent[i]);
  }
}

}  // namespace

void draw_sessions_window(const View& view, UiState& state, Commands& commands) {
  if (!state.sessions_open) return;
  if (begin_dialog("Sessions", 48.0F, 34.0F, state.sessions_open)) {
    const ImVec2 at = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    note_area("sessions.window", at.x, at.y, size.x, size.y);
    draw_recorder(view, state, commands);
    heading("Session");
    draw_open_buttons(view.session, state, commands);
    draw_reading(view.session, theme_colors(state.preferences.theme), commands);
    draw_session(view.session, state);
    draw_comparison(view.session, state);
    draw_recent(state, commands);
  }
  ImGui::End();
}

}  // namespace encore::ui
