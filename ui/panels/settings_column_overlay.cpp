#include "accel/inspect/node_measures.h"
#include "renderer/heatmap_palette.h"
#include "ui/overlay_range.h"
#include "ui/panels/settings_column.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <vector>

namespace encore::ui {

namespace {

constexpr std::array<ValueChoice<OverlayColor>, 5> kColors{{
    {OverlayColor::depth, "depth", "levels below the root"},
    {OverlayColor::leaf_size, "leaf size", "triangles of a leaf or cell"},
    {OverlayColor::sah, "SAH share",
     "share of the structure's expected cost for a random ray that this node alone has"},
    {OverlayColor::overlap, "overlap",
     "surface area that a node's two children share, over the node's own: the chance that a ray "
     "has to go to both because of it"},
    {OverlayColor::decay, "decay", "surface area of a node now, over that at the last build"},
}};

constexpr std::array<ValueChoice<HiddenLines>, 3> kHidden{{
    {HiddenLines::hidden, "hidden", "not drawn"},
    {HiddenLines::dimmed, "dimmed", "drawn faintly"},
    {HiddenLines::x_ray, "x-ray", "drawn as if nothing were before them"},
}};

void draw_colors(const ColumnContext& context, OverlaySettings& overlay) {
  const UiState& state = context.state;
  const bool bvh = any_structure(state, [](auto kind) {
    return kind == accel::StructureKind::bvh_median || kind == accel::StructureKind::bvh_sah;
  });
  const bool refits = any_structure(state, can_refit);
  std::vector<ValueChoice<OverlayColor>> colors;
  for (const auto& color : kColors) {
    if (color.value == OverlayColor::depth && !any_structure(state, is_tree)) continue;
    if (color.value == OverlayColor::overlap && !bvh) continue;
    if (color.value == OverlayColor::decay && !refits) continue;
    colors.push_back(color);
  }
  // A colour that no structure has any more stays named until another one is chosen.
  const bool there = std::any_of(colors.begin(), colors.end(),
                                 [&](const auto& color) { return color.value == overlay.color; });
  if (!there) {
    colors.push_back(kColors.at(static_cast<std::size_t>(overlay.color)));
  }
  value_choice_row({"settings.overlay.color", "Colour says", "What the colour of a node means."},
                   overlay.color, colors);
}

std::string value_of(OverlayColor color, float value) {
  return color == OverlayColor::sah || color == OverlayColor::overlap
             ? fmt::format("{:.3g} %", double(value) * 100.0)
             : fmt::format("{:.4g}", value);
}

void draw_legend(const ColumnContext& context, OverlayColor color) {
  const PaneView& shown = context.view.panes.at(context.state.inspected_pane);
  if (!shown.node_values) return;
  const accel::NodeValues& values = *shown.node_values;
  if (values.count == 0) {
    hint_line("No node of the inspected structure has such a value.");
    return;
  }
  const auto range = overlay_range(context.state.settings.overlay, values);
  const auto at = std::find(std::begin(renderer::kPalettes), std::end(renderer::kPalettes),
                            renderer::Palette::rainbow);
  draw_palette_band("settings.overlay.legend",
                    static_cast<int>(at - std::begin(renderer::kPalettes)),
                    value_of(color, range[0]), value_of(color, range[1]),
                    fmt::format("Of the inspected structure: depths as they are drawn, all else "
                                "from the 1st to the 99th percentile; what lies outside has the "
                                "colour of the end. Smallest {}, largest {}.",
                                value_of(color, values.min), value_of(color, values.max)));
}

/// How deep the trees of the panes are; 0 while none is known.
int deepest(const ColumnContext& context) {
  std::uint32_t depth = 0;
  for (std::size_t pane = 0; pane < kPaneCount; ++pane) {
    const PaneSettings& settings = context.state.settings.panes[pane];
    const auto& stats = context.view.panes[pane].stats;
    if (traces(settings.device) && is_tree(settings.structure.kind) && stats) {
      depth = std::max(depth, stats->max_depth);
    }
  }
  return static_cast<int>(depth);
}

void draw_tree_filter(const ColumnContext& context, OverlaySettings& overlay) {
  const int depth = deepest(context);
  double first = overlay.first_depth;
  double last = overlay.last_depth;
  if (depth > 0 &&
      range_row({.row = {"settings.overlay.depths", "Depths",
                         fmt::format("Levels that are drawn; the root has depth 0, the deepest "
                                     "node {}.",
                                     depth)},
                 .high = double(depth),
                 .whole = true},
                first, last)) {
    overlay.first_depth = static_cast<int>(first);
    overlay.last_depth = static_cast<int>(last);
  }
  toggle_row({"settings.overlay.leaves", "Leaves", "Nodes that hold triangles."}, overlay.leaves);
  toggle_row({"settings.overlay.inner", "Inner nodes", "Nodes that hold other nodes."},
             overlay.inner_nodes);
  if (any_structure(context.state, is_kd_tree)) {
    toggle_row({"settings.overlay.empty", "Empty leaves", "Leaves of kd-trees that hold nothing."},
               overlay.empty_leaves);
  }
}

void draw_limits(OverlaySettings& overlay) {
  number_row(NumberRow<int>{.row = {"settings.overlay.least_triangles", "Least triangles",
                                    "Leaves and cells with fewer are left out."},
                            .high = 1 << 30,
                            .usual = 0,
                            .most_slid = 64,
                            .commit = Commit::at_once},
             overlay.least_triangles);
  number_row(NumberRow<float>{.row = {"settings.overlay.smallest", "Smallest size",
                                      "Nodes that look smaller than so many pixels are left out, "
                                      "and all below them."},
                              .high = 64.0F,
                              .format = "%.1f px",
                              .usual = OverlaySettings{}.smallest_pixels,
                              .commit = Commit::at_once},
             overlay.smallest_pixels);
  number_row(NumberRow<int>{.row = {"settings.overlay.most", "Most nodes",
                                    "A frame; of more, the smallest are left out. Many cost time "
                                    "to draw."},
                            .low = 100,
                            .high = 10'000'000,
                            .usual = OverlaySettings{}.most_nodes,
                            .logarithmic = true,
                            .most_slid = 1'000'000,
                            .commit = Commit::at_once},
             overlay.most_nodes);
}

void draw_looks(const ColumnContext& context, OverlaySettings& overlay) {
  toggle_row({"settings.overlay.boxes", "Boxes", "Draws the edges of nodes and cells."},
             overlay.boxes);
  if (any_structure(context.state, is_kd_tree)) {
    toggle_row({"settings.overlay.planes", "Split planes",
                "Draws where kd-trees divide, clipped to the node."},
               overlay.planes);
    if (overlay.planes) {
      constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
      for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
        if (axis > 0) ImGui::SameLine();
        toggle_row({fmt::format("settings.overlay.plane_{}", kAxes[axis]), kAxes[axis],
                    fmt::format("Planes at right angles to the {} axis.", kAxes[axis])},
                   overlay.plane_axes.at(axis));
      }
    }
  }
  toggle_row({"settings.overlay.filled", "Filled", "Fills the boxes with a thin colour."},
             overlay.filled);
  const OverlaySettings usual;
  number_row(NumberRow<float>{.row = {"settings.overlay.line", "Line width", "In pixels."},
                              .low = 0.5F,
                              .high = 8.0F,
                              .format = "%.1f px",
                              .usual = usual.line_pixels,
                              .commit = Commit::at_once},
             overlay.line_pixels);
  number_row(NumberRow<float>{.row = {"settings.overlay.opacity", "Opacity",
                                      "0: not to be seen, 1: hides what is behind."},
                              .high = 1.0F,
                              .format = "%.2f",
                              .usual = usual.opacity,
                              .commit = Commit::at_once},
             overlay.opacity);
}

void draw_section_plane(const ColumnContext& context, OverlaySettings& overlay) {
  toggle_row({"settings.overlay.section", "Section plane", "Cuts away what lies above a plane."},
             overlay.section);
  if (overlay.section) {
    constexpr std::array<ValueChoice<int>, 3> kAxes{{{0, "x"}, {1, "y"}, {2, "z"}}};
    value_choice_row({"settings.overlay.section_axis", "Across", "Axis that the plane is across."},
                     overlay.section_axis, kAxes);
    number_row(NumberRow<float>{.row = {"settings.overlay.section_position", "Position",
                                        "Share of the scene's extent along the axis."},
                                .high = 1.0F,
                                .format = "%.3f",
                                .commit = Commit::at_once},
               overlay.section_position);
    toggle_row({"settings.overlay.section_flipped", "Other side", "Cuts away what lies below."},
               overlay.section_flipped);
  }
  if (context.state.selected_node || overlay.selected_subtree) {
    toggle_row({"settings.overlay.subtree", "Selected subtree only",
                "Draws only what lies below the selected node."},
               overlay.selected_subtree);
  }
}

void draw_counts(const View& view, const UiState& state) {
  for (std::size_t pane = 0; pane < kPaneCount; ++pane) {
    const PaneView& shown = view.panes[pane];
    if (!traces(state.settings.panes[pane].device) || !shown.nodes) continue;
    figure_row({fmt::format("settings.overlay.drawn.{}", pane), pane == 0 ? "Left" : "Right",
                "Nodes drawn, and how many were left out for their size or the limit."},
               fmt::format("{} drawn, {} left out", count_text(shown.nodes_drawn),
                           count_text(shown.nodes_hidden_small)));
  }
}

}  // namespace

void draw_overlay_section(const ColumnContext& context) {
  const auto any = [](accel::StructureKind kind) { return kind != accel::StructureKind::brute; };
  if (!any_structure(context.state, any)) return;
  if (!section("settings.overlay", "Overlay",
               "The structure itself, drawn over the pictures and in the 3D view.", false)) {
    return;
  }
  OverlaySettings& overlay = context.state.settings.overlay;
  toggle_row({"settings.overlay.show", "Show over the pictures", "Key B."}, overlay.show);
  if (!overlay.show && !context.state.structure_view) return;
  draw_colors(context, overlay);
  draw_legend(context, overlay.color);
  draw_counts(context.view, context.state);
  value_choice_row({"settings.overlay.hidden", "Hidden parts",
                    "What becomes of lines behind the scene's surface."},
                   overlay.hidden, kHidden);
  if (any_structure(context.state, is_tree)) draw_tree_filter(context, overlay);
  draw_limits(overlay);
  draw_looks(context, overlay);
  draw_section_plane(context, overlay);
}

}  // namespace encore::ui
