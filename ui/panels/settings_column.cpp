#include "ui/panels/settings_column.h"

#include "accel/acceleration_structure.h"
#include "accel/make_structure.h"
#include "renderer/heatmap_palette.h"
#include "ui/panels/shell_parts.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace encore::ui {

using accel::StructureKind;

bool traces(PaneDevice device) {
  return device == PaneDevice::cpu || device == PaneDevice::gpu;
}

bool is_grid(StructureKind kind) {
  return kind == StructureKind::grid_exact || kind == StructureKind::grid_box;
}

bool is_kd_tree(StructureKind kind) {
  return kind == StructureKind::kd_median || kind == StructureKind::kd_sah;
}

bool is_tree(StructureKind kind) {
  return kind != StructureKind::brute && !is_grid(kind);
}

bool can_refit(StructureKind kind) {
  static const std::vector<StructureKind> refitting = [] {
    std::vector<StructureKind> kinds;
    for (const StructureKind candidate : accel::all_structure_kinds()) {
      if (accel::make_structure(accel::default_spec(candidate))->can_refit()) {
        kinds.push_back(candidate);
      }
    }
    return kinds;
  }();
  return std::find(refitting.begin(), refitting.end(), kind) != refitting.end();
}

bool scene_moves(const View& view, const UiState& state) {
  return view.scene.animated || state.settings.measure.forced;
}

void draw_palette_band(const char* name, int palette, const std::string& low,
                       const std::string& high, const std::string& tip) {
  constexpr int kSteps = 32;
  const auto last = static_cast<int>(std::size(renderer::kPalettes)) - 1;
  const auto codes = renderer::palette_codes(renderer::kPalettes[std::clamp(palette, 0, last)]);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0F);
  const float height = std::round(ImGui::GetFontSize() * 0.6F);
  ImGui::Dummy({width, height});
  note_widget(name, low + " … " + high);
  tooltip(tip);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (int step = 0; step < kSteps; ++step) {
    const auto color = [&](int place) {
      return codes[static_cast<std::size_t>(place * 255 / kSteps)];
    };
    const float x0 = at.x + width * float(step) / float(kSteps);
    const float x1 = at.x + width * float(step + 1) / float(kSteps);
    list.AddRectFilledMultiColor({x0, at.y}, {x1, at.y + height}, color(step), color(step + 1),
                                 color(step + 1), color(step));
  }
  if (low.empty() && high.empty()) return;
  ImGui::TextUnformatted(low.c_str());
  ImGui::SameLine();
  const float right = at.x + width - ImGui::CalcTextSize(high.c_str()).x;
  ImGui::SetCursorScreenPos(
      {std::max(right, ImGui::GetCursorScreenPos().x), ImGui::GetCursorScreenPos().y});
  ImGui::TextUnformatted(high.c_str());
}

void draw_settings_column(const Rect& area, const View& view, UiState& state, Commands& commands) {
  const ColumnContext context{view, state, commands};
  // The part that scrolls is all of the column, so that the wheel works at its edges, too.
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0.0F, 0.0F));
  const bool shown = begin_part("##settings column", area);
  ImGui::PopStyleVar();
  if (shown) {
    note_area("settings", area.x, area.y, area.width, area.height);
    if (ImGui::BeginChild("settings", {0.0F, 0.0F}, false,
                          ImGuiWindowFlags_AlwaysVerticalScrollbar | ImGuiWindowFlags_NoNav |
                              ImGuiWindowFlags_AlwaysUseWindowPadding)) {
      draw_scene_section(context);
      draw_animation_section(context);
      draw_rays_section(context);
      for (std::size_t pane = 0; pane < kPaneCount; ++pane) draw_pane_section(context, pane);
      draw_copy_structure(context);
      draw_camera_section(context);
      draw_overlay_section(context);
      draw_heatmap_section(context);
      draw_measure_section(context);
      draw_energy_section(context);
    }
    ImGui::EndChild();
  }
  ImGui::End();
}

}  // namespace encore::ui
