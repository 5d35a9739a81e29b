#pragma once

#include "ui/panels/panels.h"

#include <cstdint>
#include <optional>
#include <string>

namespace encore::ui {

// What the structure's column is made of; internal to ui/panels.

/// What every tab reads and edits.
struct ColumnContext {
  const View& view;
  UiState& state;
  Commands& commands;

  /// The one whose structure is shown.
  [[nodiscard]] const PaneView& shown() const { return view.panes.at(state.inspected_pane); }
};

void draw_statistics(const ColumnContext& context);
/// Nodes a depth, leaves a size, memory.
void draw_profile(const ColumnContext& context);
void draw_tree(const ColumnContext& context);
void draw_selection(const ColumnContext& context);
void draw_ray(const ColumnContext& context);
/// Left and Right step along the picked ray.
void handle_ray_keys(const ColumnContext& context);

/// Selects a node without leaving the tab.
void select_node(UiState& state, std::uint32_t node);
/// What the overlay's colour shows of a node; nothing where it has no value.
std::optional<float> node_value(const PaneView& pane, std::uint32_t node);
/// A line in the place of what is not there.
void draw_missing(const ColumnContext& context, const char* name, const std::string& why);

/// A text cut to a width with an ellipsis, by default to the room left in the line or cell; what is
/// cut off is in its tooltip. True if it was cut.
bool cut_text(const std::string& text, std::optional<float> width = {});

}  // namespace encore::ui
