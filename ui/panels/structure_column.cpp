#include "accel/inspect/node_measures.h"
#include "accel/settings.h"
#include "ui/panels/column_parts.h"
#include "ui/panels/pane_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace encore::ui {

namespace {

struct Tab {
  StructureTab tab;
  const char* label;
  const char* name;
  const char* tip;
  void (*draw)(const ColumnContext&);
};

constexpr std::array<Tab, 4> kTabs{{
    {StructureTab::statistics, "Statistics", "structure.tab.statistics",
     "What the structure is made of, and what its last build did.", draw_statistics},
    {StructureTab::tree, "Tree", "structure.tab.tree", "All nodes, or a grid's cells.", draw_tree},
    {StructureTab::selection, "Selection", "structure.tab.selection",
     "The selected node: click one in the 3D view, the tree or a ray's steps.", draw_selection},
    {StructureTab::ray, "Ray", "structure.tab.ray",
     "The way of a pixel's ray through the structure: click the pixel in a pane.", draw_ray},
}};

/// The tab that what is new asks for: a ray that was picked, a node that was selected elsewhere.
std::optional<StructureTab> wanted_tab(const ColumnContext& context) {
  InspectState& inspect = context.state.inspect;
  std::optional<StructureTab> wanted;
  if (inspect.seen_node != context.state.selected_node) {
    inspect.seen_node = context.state.selected_node;
    // The tree shows a new selection by itself.
    if (inspect.seen_node && inspect.tab != StructureTab::tree) wanted = StructureTab::selection;
  }
  std::optional<InspectState::Pixel> pick;
  if (context.view.pick) {
    const PickView& view = *context.view.pick;
    pick = InspectState::Pixel{view.pane, view.pixel.x, view.pixel.y};
  }
  if (pick != inspect.seen_pick) {
    inspect.seen_pick = pick;
    if (pick) wanted = StructureTab::ray;
  }
  return wanted;
}

void draw_tabs(const ColumnContext& context) {
  const auto wanted = wanted_tab(context);
  if (!ImGui::BeginTabBar("tabs")) return;
  for (const Tab& tab : kTabs) {
    const ImGuiTabItemFlags flags =
        wanted == tab.tab ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None;
    const bool open = ImGui::BeginTabItem(tab.label, nullptr, flags);
    note_widget(tab.name, open ? "on" : "off");
    tooltip(tab.tip);
    if (!open) continue;
    // While another tab is asked for, the old one is still drawn once.
    if (!wanted || wanted == tab.tab) context.state.inspect.tab = tab.tab;
    if (ImGui::BeginChild("content", {0.0F, 0.0F}, false, ImGuiWindowFlags_NoNav)) {
      tab.draw(context);
    }
    ImGui::EndChild();
    ImGui::EndTabItem();
  }
  ImGui::EndTabBar();
}

void draw_header(const ColumnContext& context) {
  draw_pane_switch("structure", context.state);
  const PaneSettings& pane = context.state.settings.panes.at(context.state.inspected_pane);
  const bool traces = pane.device == PaneDevice::cpu || pane.device == PaneDevice::gpu;
  const std::string text =
      traces ? std::string(accel::to_string(pane.structure.kind)) : "no structure";
  ImGui::AlignTextToFramePadding();
  const bool cut = cut_text(text);
  note_widget("structure.title", text);
  if (!cut) tooltip("The structure that this column is about.");
}

/// The rasteriser has no structure: then the other pane's is shown.
void keep_inspectable(UiState& state) {
  const auto traces = [&state](std::size_t pane) {
    const PaneDevice device = state.settings.panes.at(pane).device;
    return device == PaneDevice::cpu || device == PaneDevice::gpu;
  };
  const std::size_t other = 1 - state.inspected_pane;
  if (traces(state.inspected_pane) || !traces(other)) return;
  state.inspected_pane = other;
  state.selected_node.reset();
}

}  // namespace

void select_node(UiState& state, std::uint32_t node) {
  state.selected_node = node;
  state.inspect.seen_node = node;
}

std::optional<float> node_value(const PaneView& pane, std::uint32_t node) {
  if (!pane.node_values || node >= pane.node_values->values.size()) return std::nullopt;
  const float value = pane.node_values->values[node];
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

bool cut_text(const std::string& text, std::optional<float> width) {
  const std::string shown = fitted(text, width.value_or(ImGui::GetContentRegionAvail().x));
  ImGui::TextUnformatted(shown.c_str());
  if (shown == text) return false;
  tooltip(text);
  return true;
}

void draw_missing(const ColumnContext& context, const char* name, const std::string& why) {
  ImGui::Spacing();
  ImGui::PushTextWrapPos(0.0F);
  colored_text(theme_colors(context.state.preferences.theme).dim_text, why);
  ImGui::PopTextWrapPos();
  note_widget(name, why);
}

void draw_structure_column(const Rect& area, const View& view, UiState& state, Commands& commands) {
  const ColumnContext context{view, state, commands};
  keep_inspectable(state);
  if (begin_part("##structure column", area)) {
    draw_header(context);
    handle_ray_keys(context);
    draw_tabs(context);
  }
  ImGui::End();
}

}  // namespace encore::ui
