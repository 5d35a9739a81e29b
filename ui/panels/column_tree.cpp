#include "accel/inspect/node_table.h"
#include "ui/panels/column_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/panels/tree_rows.h"
#include "ui/plot/plot_colors.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace encore::ui {

namespace {

/// How far a level is indented: less in deep trees, so that their last level still has room for its
/// number.
float indent_of(const accel::NodeTable& table) {
  const float em = ImGui::GetFontSize();
  const std::string longest(fmt::format("{}", table.size()).size(), '0');
  const float room =
      ImGui::GetContentRegionAvail().x - em * 1.3F - ImGui::CalcTextSize(longest.c_str()).x;
  const auto levels = static_cast<float>(std::max(table.max_depth(), 1U));
  return std::clamp(room / levels, 0.0F, em * 0.5F);
}

std::string kind_text(const accel::NodeTable& table, const accel::NodeRecord& node) {
  if (table.kind() == accel::NodeKind::cells) return "cell";
  if (node.leaf) return node.triangles == 0 ? "empty leaf" : "leaf";
  if (node.split_axis < 0) return "inner";
  constexpr const char* kAxes[]{"x", "y", "z"};
  return fmt::format("{} = {:.4g}", kAxes[static_cast<std::size_t>(node.split_axis)],
                     node.split_position);
}

const char* color_title(OverlayColor color) {
  switch (color) {
    case OverlayColor::depth:
      return "depth";
    case OverlayColor::leaf_size:
      return "triangles";
    case OverlayColor::sah:
      return "SAH share";
    case OverlayColor::overlap:
      return "overlap";
    case OverlayColor::decay:
      return "growth";
  }
  return "";
}

std::string color_text(const PaneView& pane, std::uint32_t node, OverlayColor color) {
  const auto known = node_value(pane, node);
  if (!known) return "–";
  const float value = *known;
  if (color == OverlayColor::sah) return fmt::format("{:.3g} %", value * 100.0F);
  return fmt::format("{:.4g}", value);
}

/// The arrow of an inner node, a gap for a leaf.
void draw_arrow(TreeState& tree, const accel::NodeRecord& record, std::uint32_t node) {
  const float em = ImGui::GetFontSize();
  if (record.leaf) {
    ImGui::Dummy({em, em});
    return;
  }
  const bool open = tree.open.contains(node);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (ImGui::InvisibleButton("arrow", {em, em})) toggle_node(tree, node);
  note_widget(fmt::format("tree.arrow.{}", node), open ? "open" : "closed");
  const std::uint32_t color = text_color(ImGui::IsItemHovered() ? 1.0F : 0.7F);
  const ImVec2 middle{at.x + em * 0.5F, at.y + em * 0.5F};
  const float arm = em * 0.25F;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (open) {
    list.AddTriangleFilled({middle.x - arm, middle.y - arm * 0.6F},
                           {middle.x + arm, middle.y - arm * 0.6F}, {middle.x, middle.y + arm},
                           color);
  } else {
    list.AddTriangleFilled({middle.x - arm * 0.6F, middle.y - arm},
                           {middle.x - arm * 0.6F, middle.y + arm}, {middle.x + arm, middle.y},
                           color);
  }
}

void draw_row(const ColumnContext& context, const accel::NodeTable& table, std::uint32_t node) {
  UiState& state = context.state;
  TreeState& tree = state.inspect.tree;
  const accel::NodeRecord& record = table[node];
  const float em = ImGui::GetFontSize();
  ImGui::PushID(static_cast<int>(node));
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const float indent = indent_of(table);
  const bool selected = state.selected_node == node;
  if (ImGui::Selectable("##row", selected,
                        ImGuiSelectableFlags_SpanAllColumns |
                            ImGuiSelectableFlags_AllowItemOverlap |
                            ImGuiSelectableFlags_AllowDoubleClick)) {
    select_node(state, node);
    tree.revealed = node;
    if (!record.leaf && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) toggle_node(tree, node);
  }
  note_widget(fmt::format("tree.node.{}", node), selected ? "selected" : "");
  const OverlayColor color = state.settings.overlay.color;
  const std::string kind = kind_text(table, record);
  const std::string value = color_text(context.shown(), node, color);
  if (ImGui::IsItemHovered()) {
    tooltip(fmt::format("{} {}, depth {}: {}; {} triangles; {} {}",
                        table.kind() == accel::NodeKind::cells ? "cell" : "node", node,
                        record.depth, kind, count_text(record.triangles), color_title(color),
                        value));
  }
  ImGui::SameLine(0.0F, 0.0F);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + static_cast<float>(record.depth) * indent);
  draw_arrow(tree, record, node);
  ImGui::SameLine(0.0F, em * 0.2F);
  // The row's tooltip has all of what is cut here.
  const auto cell = [](const std::string& text) {
    ImGui::TextUnformatted(fitted(text, ImGui::GetContentRegionAvail().x).c_str());
  };
  cell(fmt::format("{}", node));
  ImGui::TableNextColumn();
  cell(kind);
  ImGui::TableNextColumn();
  cell(count_text(record.triangles));
  ImGui::TableNextColumn();
  cell(value);
  ImGui::PopID();
}

/// A node that was selected elsewhere gets a row, and that into sight.
std::optional<std::size_t> reveal_selection(const ColumnContext& context,
                                            const std::shared_ptr<const accel::NodeTable>& table) {
  TreeState& tree = context.state.inspect.tree;
  const auto& selected = context.state.selected_node;
  if (!selected) {
    tree.revealed.reset();
    return std::nullopt;
  }
  if (tree.revealed == selected || *selected >= table->size()) return std::nullopt;
  tree.revealed = selected;
  reveal_node(tree, *table, *selected);
  follow_table(tree, table);
  return row_of(tree, *selected);
}

void draw_headers(const ColumnContext& context, bool cells) {
  const OverlayColor color = context.state.settings.overlay.color;
  const char* const labels[]{cells ? "cell" : "node", cells ? "kind" : "kind, plane", "triangles",
                             color_title(color)};
  const char* const tips[]{cells ? "Number of the cell in the list of those that hold something."
                                 : "Number in depth-first order; the arrow opens what is below.",
                           "Leaf or inner node; of a kd-tree the axis and place that it splits.",
                           "References of the leaf, or of all leaves below.",
                           "What the overlay's colours show of the node; a dash: it has none."};
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (int column = 0; column < 4; ++column) {
    ImGui::TableSetColumnIndex(column);
    ImGui::TableHeader(labels[column]);
    tooltip(tips[column]);
  }
}

}  // namespace

void draw_tree(const ColumnContext& context) {
  const auto& table = context.shown().nodes;
  if (!table || table->empty()) {
    return draw_missing(
        context, "tree.none",
        context.shown().stats ? "The list of nodes is being made." : "There is no structure yet.");
  }
  TreeState& tree = context.state.inspect.tree;
  follow_table(tree, table);
  const auto row = reveal_selection(context, table);
  const ImGuiTableFlags flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg |
                                ImGuiTableFlags_Resizable | ImGuiTableFlags_BordersInnerV |
                                ImGuiTableFlags_SizingStretchProp;
  if (!ImGui::BeginTable("tree", 4, flags)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("node", ImGuiTableColumnFlags_WidthStretch, 1.8F);
  ImGui::TableSetupColumn("kind", ImGuiTableColumnFlags_WidthStretch, 1.5F);
  ImGui::TableSetupColumn("triangles", ImGuiTableColumnFlags_WidthStretch, 1.1F);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.9F);
  draw_headers(context, table->kind() == accel::NodeKind::cells);
  const float line = ImGui::GetTextLineHeight() + 2.0F * ImGui::GetStyle().CellPadding.y;
  if (row) {
    const float middle = (static_cast<float>(*row) + 1.5F) * line;
    ImGui::SetScrollY(std::max(0.0F, middle - ImGui::GetWindowHeight() * 0.5F));
  }
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(tree.rows.size()), line);
  int drawn = 0;
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      draw_row(context, *table, tree.rows[static_cast<std::size_t>(i)]);
      ++drawn;
    }
  }
  ImGui::EndTable();
  note_widget("tree.list", fmt::format("{} of {}", drawn, tree.rows.size()));
}

}  // namespace encore::ui
