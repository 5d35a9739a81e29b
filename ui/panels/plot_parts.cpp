#include "ui/panels/plot_parts.h"

#include "ui/panels/shell_parts.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <utility>

namespace encore::ui {

namespace {

float tool_width(const PlotTool& tool) {
  return ImGui::CalcTextSize(tool.label, nullptr, true).x + 2.0F * ImGui::GetStyle().FramePadding.x;
}

}  // namespace

bool comparing(const View& view, const UiState& state) {
  return state.show_session && !view.session.folder.empty() && !view.session.changes.empty();
}

ShownPlots shown_plots(const View& view, UiState& state) {
  PlotStates& plots = state.plots;
  if (!state.show_session || view.session.folder.empty()) return {view.plots, plots.now, false};
  if (plots.session_folder != view.session.folder) {
    plots.session = {};
    plots.comparison = {};
    plots.session_folder = view.session.folder;
  }
  return {view.session.plots, plots.session, true};
}

void plot_title(std::string_view plot, const char* title, const char* help) {
  ImGui::TextUnformatted(title);
  if (widget_map_enabled()) note_widget(fmt::format("{}.title", plot), title);
  tooltip(help);
}

void plot_words(std::string_view name, const std::string& text, const char* help, float reserved) {
  if (text.empty()) return;
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  ImGui::SameLine();
  const float room = ImGui::GetContentRegionAvail().x - reserved - spacing;
  if (room < 4.0F * ImGui::GetFontSize()) {
    ImGui::NewLine();
    return;
  }
  const std::string shown = fitted(text, room);
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextUnformatted(shown.c_str());
  ImGui::PopStyleColor();
  note_widget(name, text);
  tooltip(shown == text ? std::string(help) : fmt::format("{}\n{}", text, help));
}

float tools_width(std::span<const PlotTool> tools) {
  float width = 0.0F;
  for (const PlotTool& tool : tools) {
    width += tool_width(tool) + (width > 0.0F ? ImGui::GetStyle().ItemInnerSpacing.x : 0.0F);
  }
  return width;
}

std::optional<std::size_t> draw_tools(std::string_view plot, std::span<const PlotTool> tools) {
  std::optional<std::size_t> pressed;
  for (std::size_t i = 0; i < tools.size(); ++i) {
    const PlotTool& tool = tools[i];
    if (i > 0) ImGui::SameLine(0.0F, ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::PushID(tool.name);
    ImGui::BeginDisabled(!tool.enabled);
    if (tool.on) {
      ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    }
    if (ImGui::SmallButton(tool.label)) pressed = i;
    if (tool.on) ImGui::PopStyleColor();
    ImGui::EndDisabled();
    ImGui::PopID();
    if (widget_map_enabled()) {
      note_widget(fmt::format("{}.{}", plot, tool.name), !tool.enabled ? "disabled"
                                                         : tool.on     ? "on"
                                                                       : "");
    }
    tooltip(tool.help);
  }
  return pressed;
}

std::optional<std::size_t> draw_end_tools(std::string_view plot, std::span<const PlotTool> tools) {
  ImGui::SameLine();
  const float room = ImGui::GetContentRegionAvail().x;
  const float width = tools_width(tools);
  if (room >= width) {
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - width);
  } else {
    ImGui::NewLine();
  }
  return draw_tools(plot, tools);
}

PlotColor phase_color(std::string_view phase) {
  static constexpr std::array<std::pair<std::string_view, PlotColor>, 6> kColors{
      {{"animate", PlotColor::animate},
       {"build", PlotColor::build},
       {"update", PlotColor::update},
       {"transfer", PlotColor::transfer},
       {"render", PlotColor::render},
       {"idle", PlotColor::idle}}};
  for (const auto& [name, color] : kColors) {
    if (name == phase) return color;
  }
  return PlotColor::remainder;
}

PlotColor ray_color(scene::RayKind kind) {
  switch (kind) {
    case scene::RayKind::camera:
      return PlotColor::render;
    case scene::RayKind::shadow:
      return PlotColor::shadow_rays;
    case scene::RayKind::reflection:
      return PlotColor::reflection_rays;
    case scene::RayKind::refraction:
      return PlotColor::refraction_rays;
  }
  return PlotColor::render;
}

}  // namespace encore::ui
