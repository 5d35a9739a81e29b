#include "ui/panels/panels.h"
#include "ui/panels/session_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/plot/value_text.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>

namespace encore::ui {

namespace {

std::string watts_text(const SensorRow& sensor) {
  return sensor.watts ? value_text(*sensor.watts, "W") : "not seen";
}

/// What the doctor found, for mails and notes.
std::string doctor_text(const View& view) {
  const DoctorView& doctor = view.doctor;
  std::string text = doctor.machine.empty() ? "" : "machine: " + doctor.machine + "\n";
  for (const SensorRow& sensor : doctor.sensors) {
    text += fmt::format("{} ({}): {}; {}", sensor.name, sensor.place,
                        sensor.usable ? "usable" : "not usable", sensor.includes);
    if (sensor.usable) {
      text += fmt::format("; period {}; {}", sensor.period.empty() ? "not seen" : sensor.period,
                          watts_text(sensor));
    }
    if (!sensor.obstacle.empty()) text += "; in the way: " + sensor.obstacle;
    if (!sensor.way_out.empty()) text += "; way out: " + sensor.way_out;
    text += "\n";
  }
  for (const std::string& line : doctor.opengl) text += "OpenGL: " + line + "\n";
  text += fmt::format("total: {}{}{}\n", energy::to_string(view.power.origin),
                      view.power.detail.empty() ? "" : ": ", view.power.detail);
  if (!doctor.conclusion.empty()) text += doctor.conclusion + "\n";
  return text;
}

void draw_run_row(const View& view, Commands& commands) {
  const WorkView& work = view.doctor.work;
  if (work.active) {
    if (ImGui::Button("Stop")) commands.push_back(ExamineSensors{true});
    note_widget("doctor.stop");
    tooltip("Ends the examination; what was found before stays.");
    ImGui::SameLine();
    progress_bar(10.0F * ImGui::GetFontSize(), work.progress ? &*work.progress : nullptr);
    note_widget("doctor.progress",
                work.progress ? fmt::format("{:.0f} %", 100.0 * *work.progress) : "unknown");
    tooltip("How much of the time of watching has passed.");
    ImGui::SameLine();
    ImGui::TextUnformatted(fitted(work.doing, ImGui::GetContentRegionAvail().x).c_str());
    tooltip(work.doing);
    return;
  }
  const bool again = !view.doctor.sensors.empty();
  if (ImGui::Button(again ? "Examine again" : "Examine sensors")) {
    commands.push_back(ExamineSensors{});
  }
  note_widget("doctor.run");
  tooltip(
      "Looks for every sensor that ENCORE knows and watches those that answer for some "
      "seconds.");
  ImGui::SameLine();
  ImGui::BeginDisabled(!again);
  if (ImGui::Button("Copy text"))
    commands.push_back(CopyText{doctor_text(view), "findings copied"});
  ImGui::EndDisabled();
  note_widget("doctor.copy", again ? "" : "disabled");
  tooltip("Copies all of this as text.");
}

void draw_total(const View& view, UiState& state, Commands& commands) {
  const ThemeColors& colors = theme_colors(state.preferences.theme);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Used now:");
  ImGui::SameLine();
  badge(view.power);
  note_widget("doctor.total", energy::to_string(view.power.origin));
  ImGui::SameLine();
  EnergySettings& energy = state.settings.energy;
  const bool automatic = energy.from == EnergySettings::From::automatic;
  ImGui::BeginDisabled(automatic);
  if (ImGui::Button("Automatic")) {
    energy.from = EnergySettings::From::automatic;
    commands.push_back(ApplyEnergy{});
  }
  ImGui::EndDisabled();
  note_widget("doctor.automatic", automatic ? "on" : "");
  tooltip("Takes every sensor that belongs to the total: each part of the machine once.");
  ImGui::SameLine();
  if (ImGui::Button("Enter idle and busy watts")) state.dialog = Dialog::energy;
  note_widget("doctor.watts");
  tooltip("Computes watts and joules from two readings of a meter, marked as modelled.");
  if (view.power_opening) wrapped_text(colors.dim_text, "opening the source…");
  if (!view.power.detail.empty()) wrapped_text(view.power.detail);
  if (!view.power_problem.empty()) {
    wrapped_text(colors.problem, view.power_problem);
    note_widget("doctor.problem", view.power_problem);
  }
}

void draw_state_cell(const SensorRow& sensor, const ThemeColors& colors) {
  ImGui::TableNextColumn();
  if (sensor.usable) {
    wrapped_text(colors.good, sensor.in_total ? "usable, in the total" : "usable");
  } else {
    wrapped_text(colors.warning, sensor.obstacle.empty() ? "not usable" : sensor.obstacle);
  }
  if (sensor.usable && !sensor.obstacle.empty()) wrapped_text(colors.dim_text, sensor.obstacle);
  if (!sensor.way_out.empty()) wrapped_text("Way out: " + sensor.way_out);
}

void draw_use_button(const SensorRow& sensor, UiState& state, Commands& commands) {
  EnergySettings& energy = state.settings.energy;
  const bool used = energy.from == EnergySettings::From::chosen && energy.source == sensor.name;
  ImGui::BeginDisabled(used);
  const char* label = used ? "chosen" : "Use this source";
  const float width = ImGui::GetContentRegionAvail().x - 2.0F * ImGui::GetStyle().FramePadding.x;
  ImGui::PushID("use");
  if (ImGui::SmallButton(fitted(label, width).c_str())) {
    energy.from = EnergySettings::From::chosen;
    energy.source = sensor.name;
    commands.push_back(ApplyEnergy{});
  }
  ImGui::PopID();
  ImGui::EndDisabled();
  if (widget_map_enabled()) {
    note_widget(fmt::format("doctor.use.{}", sensor.name), used ? "on" : "");
  }
  tooltip("Watts and joules come from this sensor alone.");
}

void draw_sensor(const SensorRow& sensor, UiState& state, Commands& commands) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  wrapped_text(sensor.name);
  if (widget_map_enabled()) {
    note_widget(fmt::format("doctor.sensor.{}", sensor.name),
                sensor.usable ? "usable" : "not usable");
  }
  tooltip(sensor.place);
  if (sensor.usable) draw_use_button(sensor, state, commands);
  ImGui::TableNextColumn();
  wrapped_text(sensor.includes);
  tooltip("What its watts include.");
  ImGui::TableNextColumn();
  wrapped_text(sensor.period.empty() ? "not seen" : sensor.period);
  tooltip("How often its value changes, as seen.");
  ImGui::TableNextColumn();
  wrapped_text(watts_text(sensor));
  tooltip("Mean power in W while it was watched.");
  draw_state_cell(sensor, theme_colors(state.preferences.theme));
}

/// The OpenGL devices in one block of letters that are equally wide.
void draw_opengl(const DoctorView& doctor) {
  if (doctor.opengl.empty()) return;
  std::string text;
  for (const std::string& line : doctor.opengl) text += (text.empty() ? "" : "\n") + line;
  ImGui::TextDisabled("OpenGL devices");
  ImGui::PushFont(mono_font());
  wrapped_text(text);
  ImGui::PopFont();
  note_widget("doctor.opengl", text);
  tooltip("What OpenGL finds here: the device that draws and traces, and what it can do.");
}

/// How high that block is at the width there is.
float opengl_height(const DoctorView& doctor) {
  if (doctor.opengl.empty()) return 0.0F;
  ImGui::PushFont(mono_font());
  float height = 0.0F;
  for (const std::string& line : doctor.opengl) {
    height += ImGui::CalcTextSize(line.c_str(), nullptr, false, ImGui::GetContentRegionAvail().x).y;
  }
  ImGui::PopFont();
  return height + 1.5F * ImGui::GetTextLineHeightWithSpacing();
}

void draw_sensors(const DoctorView& doctor, float height, UiState& state, Commands& commands) {
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg |
                                     ImGuiTableFlags_BordersInner | ImGuiTableFlags_Resizable |
                                     ImGuiTableFlags_SizingStretchProp;
  if (!ImGui::BeginTable("sensors", 5, kFlags, {0.0F, height})) return;
  ImGui::TableSetupColumn("sensor", 0, 2.2F);
  ImGui::TableSetupColumn("includes", 0, 2.4F);
  ImGui::TableSetupColumn("period", 0, 1.0F);
  ImGui::TableSetupColumn("power", 0, 1.0F);
  ImGui::TableSetupColumn("usable, or what is in the way", 0, 4.0F);
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableHeadersRow();
  for (std::size_t i = 0; i < doctor.sensors.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    draw_sensor(doctor.sensors[i], state, commands);
    ImGui::PopID();
  }
  ImGui::EndTable();
}

}  // namespace

void draw_doctor_window(const View& view, UiState& state, Commands& commands) {
  if (!state.doctor_open) return;
  const DoctorView& doctor = view.doctor;
  if (begin_dialog("Sensors", 58.0F, 34.0F, state.doctor_open)) {
    const ThemeColors& colors = theme_colors(state.preferences.theme);
    const ImVec2 at = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    note_area("doctor.window", at.x, at.y, size.x, size.y);
    draw_run_row(view, commands);
    draw_total(view, state, commands);
    ImGui::Separator();
    if (!doctor.machine.empty()) wrapped_text(doctor.machine);
    if (!doctor.conclusion.empty()) {
      wrapped_text(colors.warning, doctor.conclusion);
      note_widget("doctor.conclusion", doctor.conclusion);
    }
    if (doctor.sensors.empty() && !doctor.work.active) {
      wrapped_text(colors.dim_text,
                   "Not examined yet: the sensors of this machine, what is in the way of each and "
                   "the way out will stand here.");
    }
    const float room = ImGui::GetContentRegionAvail().y - opengl_height(doctor);
    if (!doctor.sensors.empty()) {
      draw_sensors(doctor, std::max(room, 8.0F * ImGui::GetFontSize()), state, commands);
    }
    draw_opengl(doctor);
  }
  ImGui::End();
}

}  // namespace encore::ui
