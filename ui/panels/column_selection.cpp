#include "accel/inspect/node_measures.h"
#include "accel/inspect/node_table.h"
#include "scene/camera_motion.h"
#include "ui/panels/column_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/panels/tree_rows.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cmath>
#include <string>

namespace encore::ui {

namespace {

struct Selected {
  const accel::NodeTable& table;
  std::uint32_t node;
  const accel::NodeRecord& record;
};

void draw_path(const ColumnContext& context, const Selected& selected) {
  const auto path = accel::path_to_root(selected.table, selected.node);
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  const float gap = ImGui::GetFontSize() * 0.3F;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::string label = fmt::format("{}", path[i]);
    if (i > 0) {
      const float width = ImGui::CalcTextSize(label.c_str()).x + gap * 4.0F;
      if (ImGui::GetItemRectMax().x + width < right) ImGui::SameLine(0.0F, gap);
    }
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::SmallButton(label.c_str())) select_node(context.state, path[i]);
    ImGui::PopID();
    note_widget(fmt::format("selection.path.{}", i), label);
    tooltip("The way from the root down; a click selects that node.");
  }
}

void draw_value(const char* name, const char* label, const std::string& text, const char* tip) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  if (!cut_text(label)) tooltip(tip);
  ImGui::TableNextColumn();
  const bool cut = cut_text(text);
  note_widget(std::string("selection.") + name, text);
  if (!cut) tooltip(tip);
}

std::string point_text(const glm::vec3& point) {
  return fmt::format("{:.4g}, {:.4g}, {:.4g}", point.x, point.y, point.z);
}

std::string kind_of(const Selected& selected) {
  constexpr std::array kAxes{"x", "y", "z"};
  if (selected.table.kind() == accel::NodeKind::cells) return "cell of a grid";
  if (selected.record.leaf) return selected.record.triangles == 0 ? "empty leaf" : "leaf";
  if (selected.record.split_axis < 0) return "inner node";
  return fmt::format("splits {} at {:.5g}",
                     kAxes.at(static_cast<std::size_t>(selected.record.split_axis)),
                     selected.record.split_position);
}

void draw_measures(const ColumnContext& context, const Selected& selected) {
  const PaneView& shown = context.shown();
  const double cost = shown.stats ? shown.stats->sah_cost : 0.0;
  if (const auto share = sah_share(selected.table, selected.node, cost)) {
    draw_value("sah_share", "SAH share", fmt::format("{:.3g} %", *share * 100.0),
               "Share of the structure's SAH cost that this node alone has, in %.");
  }
  const auto children = children_of(selected.table, selected.node);
  if (selected.table.kind() == accel::NodeKind::boxes && children.size() == 2) {
    const float overlap =
        accel::node_overlap(selected.record.bounds, selected.table[children[0]].bounds,
                            selected.table[children[1]].bounds);
    if (std::isfinite(overlap)) {
      draw_value("overlap", "overlap", fmt::format("{:.3g} %", double(overlap) * 100.0),
                 "Chance that a ray which meets this node has to go to both children because their "
                 "boxes share space, in %.");
    }
  }
  const auto value = node_value(shown, selected.node);
  if (context.state.settings.overlay.color == OverlayColor::decay && value) {
    draw_value("decay", "growth", fmt::format("{:.4g}", *value),
               "Surface area now over that at the build: above 1, refitting has made it larger.");
  }
}

void draw_facts(const ColumnContext& context, const Selected& selected) {
  if (!ImGui::BeginTable("facts", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
    return;
  }
  ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_WidthStretch, 0.6F);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 1.4F);
  const accel::NodeRecord& record = selected.record;
  draw_value("kind", "kind", kind_of(selected), "What the node is; positions in world units.");
  draw_value("depth", "depth", fmt::format("{}", record.depth), "Levels below the root.");
  draw_value("triangles", "triangles", count_text(record.triangles),
             "References of the leaf, or of all leaves below.");
  draw_value("min", "from", point_text(record.bounds.min),
             "Lower corner of its box: x, y, z in world units.");
  draw_value("max", "to", point_text(record.bounds.max),
             "Upper corner of its box: x, y, z in world units.");
  draw_measures(context, selected);
  ImGui::EndTable();
}

void focus_on(const ColumnContext& context, const scene::Bounds& box) {
  UiState& state = context.state;
  const bool free = state.structure_view && state.free_camera;
  const UiState::Area& area = state.picture_areas.at(free ? kPaneCount : state.inspected_pane);
  const double aspect =
      area.width > 0 && area.height > 0 ? double(area.width) / double(area.height) : 1.0;
  scene::Camera& camera = free ? *state.free_camera : state.camera;
  camera = scene::focus(camera, box, aspect);
}

void draw_buttons(const ColumnContext& context, const Selected& selected) {
  const auto button = [&](const char* label, const char* name, const char* tip) {
    // In the next line where there is no room behind the last button.
    const float width = ImGui::CalcTextSize(label).x + 2.0F * ImGui::GetStyle().FramePadding.x;
    const bool same_line = ImGui::GetCursorPosX() > ImGui::GetCursorStartPos().x + 1.0F;
    if (same_line && width > ImGui::GetContentRegionAvail().x) ImGui::NewLine();
    const bool pressed = ImGui::Button(label);
    note_widget(std::string("selection.") + name);
    tooltip(tip);
    return pressed;
  };
  if (selected.record.parent != accel::kNoNode) {
    if (button("Parent", "parent", "Selects the node above.")) {
      select_node(context.state, selected.record.parent);
    }
    ImGui::SameLine();
  }
  const auto children = children_of(selected.table, selected.node);
  for (std::size_t i = 0; i < children.size() && i < 2; ++i) {
    if (button(i == 0 ? "Left" : "Right", i == 0 ? "left" : "right",
               i == 0 ? "Selects the first child." : "Selects the second child.")) {
      select_node(context.state, children[i]);
    }
    ImGui::SameLine();
  }
  if (button("Focus", "focus", "Moves the camera so that the node fills the picture.")) {
    focus_on(context, selected.record.bounds);
  }
  OverlaySettings& overlay = context.state.settings.overlay;
  if (ImGui::Checkbox("only this subtree", &overlay.selected_subtree) && overlay.selected_subtree) {
    overlay.show = true;
  }
  note_widget("selection.subtree", overlay.selected_subtree ? "on" : "off");
  tooltip("The overlay shows this node and what lies below it, nothing else.");
}

void draw_triangles(const ColumnContext& context, const Selected& selected) {
  const auto& triangles = context.shown().selected_triangles;
  const ThemeColors& colors = theme_colors(context.state.preferences.theme);
  std::string title = fmt::format("{} triangles", count_text(triangles.size()));
  if (triangles.size() < selected.record.triangles) {
    title += fmt::format(", from {} references", count_text(selected.record.triangles));
  }
  colored_text(colors.dim_text, fitted(title, ImGui::GetContentRegionAvail().x));
  note_widget("selection.list_title", title);
  tooltip(title +
          ". Numbers in the scene's list of triangles, each once; of very many the first are "
          "listed.");
  if (ImGui::BeginChild("triangles", {0.0F, 0.0F}, false, ImGuiWindowFlags_NoNav)) {
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(triangles.size()), ImGui::GetTextLineHeightWithSpacing());
    while (clipper.Step()) {
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
        ImGui::Text("%u", triangles[static_cast<std::size_t>(i)]);
      }
    }
  }
  ImGui::EndChild();
}

}  // namespace

void draw_selection(const ColumnContext& context) {
  const auto& table = context.shown().nodes;
  const auto& node = context.state.selected_node;
  if (!node || !table || *node >= table->size()) {
    return draw_missing(
        context, "selection.none",
        "No node is selected. Click one in the 3D view (V), in the tree, or a step of a ray.");
  }
  const Selected selected{*table, *node, (*table)[*node]};
  draw_path(context, selected);
  draw_facts(context, selected);
  draw_buttons(context, selected);
  ImGui::Separator();
  draw_triangles(context, selected);
}

}  // namespace encore::ui
