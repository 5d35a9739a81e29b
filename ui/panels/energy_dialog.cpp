#include "ui/panels/panels.h"
#include "ui/panels/session_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <cmath>
#include <string>

namespace encore::ui {

namespace {

using From = EnergySettings::From;

constexpr const char* kModelled =
    "Modelled means: no sensor is read; the power is taken to be the idle watts while nothing runs "
    "and the busy watts while a tracer works. Joules are these watts times the measured seconds, "
    "so they compare configurations no better than times do, and every figure says so.";

void draw_choice(const char* label, From from, const char* help, EnergySettings& energy) {
  if (ImGui::RadioButton(label, energy.from == from)) energy.from = from;
  if (widget_map_enabled()) {
    note_widget(fmt::format("energy.{}", to_string(from)), energy.from == from ? "on" : "off");
  }
  tooltip(help);
}

void draw_source(const View& view, EnergySettings& energy) {
  ImGui::Indent();
  ImGui::SetNextItemWidth(18.0F * ImGui::GetFontSize());
  ImGui::InputTextWithHint("##source", "rapl:package-0", &energy.source);
  note_widget("energy.source", energy.source);
  tooltip("The sensor's name, as the list of sensors shows it and --source takes it.");
  for (const SensorRow& sensor : view.doctor.sensors) {
    if (!sensor.usable) continue;
    if (ImGui::Selectable(sensor.name.c_str(), energy.source == sensor.name)) {
      energy.source = sensor.name;
    }
    if (widget_map_enabled()) note_widget(fmt::format("energy.sensor.{}", sensor.name));
    tooltip(sensor.includes);
  }
  ImGui::Unindent();
}

void draw_watts_field(const char* label, const char* name, const char* help, float& watts) {
  ImGui::SetNextItemWidth(9.0F * ImGui::GetFontSize());
  ImGui::InputFloat(label, &watts, 0.0F, 0.0F, "%.2f", ImGuiInputTextFlags_AutoSelectAll);
  note_widget(name, fmt::format("{:.2f}", watts));
  tooltip(help);
}

void draw_watts(EnergySettings& energy) {
  ImGui::Indent();
  draw_watts_field("idle, W", "energy.idle",
                   "Watts of the whole machine while nothing runs: read a wall plug meter, or the "
                   "laptop's battery gauge, over a minute with the desktop at rest.",
                   energy.idle_watts);
  draw_watts_field("busy, W", "energy.busy",
                   "Watts while a tracer works: read the same meter over a minute while a heavy "
                   "scene is traced.",
                   energy.busy_watts);
  ImGui::Unindent();
}

/// Why this cannot be applied; empty if it can.
std::string problem_of(const EnergySettings& energy) {
  if (energy.from == From::chosen && energy.source.empty()) {
    return "No sensor is named: type its name, or examine the sensors and pick one.";
  }
  if (energy.from != From::model) return {};
  if (!std::isfinite(energy.idle_watts) || !std::isfinite(energy.busy_watts) ||
      energy.idle_watts < 0.0F) {
    return "Idle watts must be a number of at least 0.";
  }
  if (energy.busy_watts <= 0.0F) return "Enter the busy watts: they are not known yet.";
  if (energy.busy_watts <= energy.idle_watts) {
    return "Busy watts must be above idle watts: read both on the same meter.";
  }
  return {};
}

void draw_buttons(UiState& state, Commands& commands) {
  const std::string problem = problem_of(state.sessions.energy);
  if (!problem.empty()) {
    wrapped_text(theme_colors(state.preferences.theme).problem, problem);
    note_widget("energy.problem", problem);
  }
  ImGui::Spacing();
  ImGui::BeginDisabled(!problem.empty());
  if (ImGui::Button("Apply")) {
    state.settings.energy = state.sessions.energy;
    commands.push_back(ApplyEnergy{});
    state.dialog = Dialog::none;
  }
  ImGui::EndDisabled();
  note_widget("energy.apply", problem.empty() ? "" : "disabled");
  tooltip("Opens this source; the plots and figures go on with it.");
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) state.dialog = Dialog::none;
  note_widget("energy.cancel");
  tooltip("Changes nothing.");
  ImGui::SameLine();
  if (ImGui::Button("Sensor doctor")) {
    state.doctor_open = true;
    state.dialog = Dialog::none;
  }
  note_widget("energy.doctor");
  tooltip("Lists this machine's sensors, what is in the way of each, and the way out.");
}

}  // namespace

void draw_energy_dialog(const View& view, UiState& state, Commands& commands) {
  bool open = true;
  if (begin_dialog("Source of watts", 36.0F, 24.0F, open)) {
    const ImVec2 at = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    note_area("dialog.energy", at.x, at.y, size.x, size.y);
    EnergySettings& energy = state.sessions.energy;
    if (ImGui::IsWindowAppearing()) energy = state.settings.energy;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Now:");
    ImGui::SameLine();
    badge(view.power);
    note_widget("energy.now", energy::to_string(view.power.origin));
    if (!view.power.detail.empty()) wrapped_text(view.power.detail);
    if (!view.power_problem.empty()) {
      wrapped_text(theme_colors(state.preferences.theme).problem, view.power_problem);
    }
    ImGui::Separator();
    draw_choice("Automatic", From::automatic,
                "Every sensor that belongs to the total: each part of the machine once.", energy);
    draw_choice("One sensor", From::chosen, "Only the sensor that is named here.", energy);
    if (energy.from == From::chosen) draw_source(view, energy);
    draw_choice("Modelled from idle and busy watts", From::model,
                "For machines without a sensor, with readings of a meter.", energy);
    if (energy.from == From::model) draw_watts(energy);
    ImGui::Spacing();
    if (energy.from == From::model) {
      wrapped_text(theme_colors(state.preferences.theme).dim_text, kModelled);
    }
    draw_buttons(state, commands);
  }
  ImGui::End();
  if (!open) state.dialog = Dialog::none;
}

}  // namespace encore::ui
