#include "ui/panels/accuracy_parts.h"
#include "ui/panels/panels.h"
#include "ui/panels/plot_parts.h"
#include "ui/panels/session_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

namespace encore::ui {

namespace {

constexpr std::array kSamples{1, 4, 16, 64};
constexpr std::array kSides{128, 256, 512};
constexpr std::array kReferences{64, 256, 1024};

/// A word to tick in a line of its kind; what does not fit goes into the next line.
template <class Value>
void tick(const char* kind, const std::string& word, const char* tip, Value value,
          std::set<Value>& chosen) {
  const float width = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x +
                      ImGui::CalcTextSize(word.c_str()).x;
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
  bool on = chosen.contains(value);
  const std::string name = fmt::format("accuracy.{}.{}", kind, word);
  ImGui::PushID(name.c_str());
  if (ImGui::Checkbox(word.c_str(), &on)) {
    if (on) {
      chosen.insert(value);
    } else {
      chosen.erase(value);
    }
  }
  ImGui::PopID();
  note_widget(name, on ? "on" : "off");
  tooltip(tip);
}

void label(const char* text) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", text);
  ImGui::SameLine(6.5F * ImGui::GetFontSize());
  ImGui::Dummy({0.0F, 0.0F});
}

template <std::size_t N>
void number_choice(const char* name, const char* before, const std::array<int, N>& values,
                   const char* tip, int& value) {
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", before);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(5.0F * ImGui::GetFontSize());
  const std::string id = fmt::format("##{}", name);
  const bool open = ImGui::BeginCombo(id.c_str(), std::to_string(value).c_str());
  if (!open) {
    note_widget(name, std::to_string(value));
    tooltip(tip);
    return;
  }
  for (const int one : values) {
    if (ImGui::Selectable(std::to_string(one).c_str(), one == value)) value = one;
    if (widget_map_enabled()) note_widget(fmt::format("{}.{}", name, one));
  }
  ImGui::EndCombo();
}

void draw_choices(const AccuracyView& view, AccuracyChoice& choice) {
  label("Devices");
  tick("device", "cpu", "The processor's tracer.", PaneDevice::cpu, choice.devices);
  if (view.gpu) {
    tick("device", "gpu", "The tracer in OpenGL.", PaneDevice::gpu, choice.devices);
  }
  number_choice("accuracy.side", "   Side", kSides, "Of the square picture, in pixels.",
                choice.side);
  number_choice("accuracy.reference", "   Reference", kReferences,
                "Camera rays a pixel of the reference picture: the more, the smaller the errors "
                "that can be told.",
                choice.reference_samples);
  label("Structures");
  for (const accel::StructureKind kind : accel::all_structure_kinds()) {
    if (kind == accel::StructureKind::brute) continue;
    tick("structure", std::string(accel::to_string(kind)),
         "Pictures are the same by every structure; what they cost is not.", kind,
         choice.structures);
  }
  label("Modes");
  for (const accel::IntersectionMode mode : accel::all_intersection_modes()) {
    tick("mode", std::string(accel::to_string(mode)),
         "The arithmetic that holds rays against triangles.", mode, choice.modes);
  }
  label("Samples");
  for (const int count : kSamples) {
    tick("samples", std::to_string(count), "Camera rays a pixel.", count, choice.samples);
  }
}

void draw_progress(const WorkView& work, Commands& commands) {
  if (ImGui::Button("Stop")) commands.push_back(StopAccuracy{});
  note_widget("accuracy.stop");
  tooltip("Ends the comparison; what was found stays.");
  ImGui::SameLine();
  progress_bar(10.0F * ImGui::GetFontSize(), work.progress ? &*work.progress : nullptr);
  note_widget("accuracy.progress",
              work.progress ? fmt::format("{:.0f} %", 100.0 * *work.progress) : "unknown");
  tooltip("How much of it is done.");
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(fitted(work.doing, ImGui::GetContentRegionAvail().x).c_str());
  note_widget("accuracy.doing", work.doing);
  tooltip(work.doing);
}

void draw_run_row(const View& view, const UiState& state, Commands& commands) {
  const AccuracyView& accuracy = view.accuracy;
  if (accuracy.work.active) return draw_progress(accuracy.work, commands);
  const std::size_t count = state.accuracy.choice.configurations();
  const bool possible = count > 0 && view.scene.scene != nullptr;
  ImGui::BeginDisabled(!possible);
  if (ImGui::Button("Start")) commands.push_back(StartAccuracy{state.accuracy.choice});
  ImGui::EndDisabled();
  note_widget("accuracy.start", possible ? "" : "disabled");
  tooltip(
      "Draws the reference, compares each combination with it, and times them by turns while the "
      "panes rest. Scene, camera and rays are those of the window.");
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled(
      "%s", !view.scene.scene ? "no scene is open"
            : count == 0      ? "choose at least one of each line"
                         : fmt::format("{} configuration{}", count, count == 1 ? "" : "s").c_str());
}

/// The buttons of the scatter's title row: what x is, and what can be saved.
void draw_scatter_tools(const AccuracyView& view, UiState& state, Commands& commands) {
  const bool any = !view.results.empty();
  std::vector<PlotTool> tools;
  const bool joules = knows_joules(view);
  if (joules) {
    const bool by_joules = state.accuracy.by_joules;
    tools.push_back(
        {.name = "by_time", .label = "Time", .help = "x: seconds a frame.", .on = !by_joules});
    tools.push_back(
        {.name = "by_joules", .label = "Energy", .help = "x: joules a frame.", .on = by_joules});
  }
  tools.push_back({.name = "copy_csv",
                   .label = "Copy",
                   .help = "Copies the results as CSV, as accuracy.csv has them.",
                   .enabled = any});
  tools.push_back({.name = "save",
                   .label = "CSV, SVG",
                   .help = "Saves accuracy.csv and the scatter as SVG in a new folder among the "
                           "pictures; a notice names it.",
                   .enabled = any});
  tools.push_back({.name = "save_png",
                   .label = "PNG",
                   .help = "Saves a picture of this window; a notice names the file."});
  const auto pressed = draw_end_tools("accuracy", tools);
  if (!pressed) return;
  const std::string_view name = tools[*pressed].name;
  if (name == "by_time") state.accuracy.by_joules = false;
  if (name == "by_joules") state.accuracy.by_joules = true;
  if (name == "copy_csv") commands.push_back(CopyText{view.csv, "accuracy copied as CSV"});
  if (name == "save") commands.push_back(SaveAccuracy{});
  if (name == "save_png") commands.push_back(SavePicture{PictureOf::accuracy, {}});
}

void draw_scatter(const AccuracyView& view, float height, UiState& state, Commands& commands) {
  const bool by_joules = state.accuracy.by_joules && knows_joules(view);
  plot_title("accuracy", by_joules ? "Error against energy" : "Error against time",
             "RMSE in % of white over the cost of a frame, both logarithmic. A colour a device and "
             "mode; the stepped line is the Pareto front: of what lies on it nothing else costs no "
             "more and errs no more.");
  if (by_joules) {
    ImGui::SameLine();
    badge(view.energy);
    note_widget("accuracy.origin", energy::to_string(view.energy.origin));
  }
  draw_scatter_tools(view, state, commands);
  const bool waits = view.work.active && !view.results.empty();
  scatter_chart("accuracy.chart", accuracy_scatter(view, by_joules), state.accuracy.chart,
                {0.0F, height},
                waits ? "errors are known, times follow" : "what is found will stand here");
}

void draw_facts(const AccuracyView& view, Theme theme) {
  const ThemeColors& colors = theme_colors(theme);
  if (!view.no_gpu.empty()) {
    wrapped_text(colors.dim_text, "gpu: " + view.no_gpu);
    note_widget("accuracy.no_gpu", view.no_gpu);
  }
  if (!view.problem.empty()) {
    wrapped_text(colors.problem, view.problem);
    note_widget("accuracy.problem", view.problem);
  }
  if (view.of.empty()) return;
  std::string facts = view.of;
  if (view.rounds > 0) {
    facts += fmt::format("; medians of {} of {} rounds", view.rounds, view.rounds_wanted);
  }
  if (!knows_joules(view) && !view.energy.detail.empty() && view.rounds > 0) {
    facts += "; no joules: " + view.energy.detail;
  }
  wrapped_text(colors.dim_text, facts);
  note_widget("accuracy.facts", facts);
}

}  // namespace

void draw_accuracy_window(const View& view, UiState& state, Commands& commands) {
  if (!state.accuracy.open) return;
  const AccuracyView& accuracy = view.accuracy;
  if (begin_dialog("Accuracy", 72.0F, 46.0F, state.accuracy.open)) {
    const ImVec2 at = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    note_area("accuracy.window", at.x, at.y, size.x, size.y);
    state.accuracy.area = {at.x, at.y, size.x, size.y};
    ImGui::BeginDisabled(accuracy.work.active);
    draw_choices(accuracy, state.accuracy.choice);
    ImGui::EndDisabled();
    draw_run_row(view, state, commands);
    draw_facts(accuracy, state.preferences.theme);
    ImGui::Separator();
    const float room = ImGui::GetContentRegionAvail().y;
    const float least = 9.0F * ImGui::GetFontSize();
    draw_scatter(accuracy, std::max(least, 0.55F * room), state, commands);
    const float left = ImGui::GetContentRegionAvail().y;
    if (!accuracy.results.empty()) draw_accuracy_table(accuracy, std::max(least, left));
  }
  ImGui::End();
}

}  // namespace encore::ui
