#pragma once

#include "accel/settings.h"
#include "ui/panels/panels.h"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace encore::ui {

// What the settings' column is made of; internal to it. Each part draws nothing where it does not
// apply.

/// What every part of the column reads and edits.
struct ColumnContext {
  const View& view;
  UiState& state;
  Commands& commands;
};

void draw_scene_section(const ColumnContext& context);
/// What is to be known of a scene besides: sizes, where they lie, memory.
void draw_scene_figures(const scene::SceneInfo& info);
/// What the scene does without as it is set, and what that saves.
void draw_left_out(const ColumnContext& context);
/// Which rays pictures are made of.
void draw_rays_section(const ColumnContext& context);
void draw_animation_section(const ColumnContext& context);
void draw_pane_section(const ColumnContext& context, std::size_t pane);
/// Carries one pane's structure and policy over to the other.
void draw_copy_structure(const ColumnContext& context);
/// The parameters of the structure's kind. `moves`: whether it is updated from frame to frame.
void draw_structure_parameters(const char* prefix, PaneSettings& pane, bool moves);
void draw_camera_section(const ColumnContext& context);
void draw_overlay_section(const ColumnContext& context);
void draw_heatmap_section(const ColumnContext& context);
void draw_measure_section(const ColumnContext& context);
void draw_energy_section(const ColumnContext& context);

/// An entry of a list of values; see value_choice_row().
template <class Value>
struct ValueChoice {
  Value value;
  std::string_view word;
  const char* tip = "";
};

/// Whether rays are traced, and so a structure is there.
bool traces(PaneDevice device);
bool is_grid(accel::StructureKind kind);
bool is_kd_tree(accel::StructureKind kind);
bool is_tree(accel::StructureKind kind);
/// Whether a structure of this kind can be updated without a build.
bool can_refit(accel::StructureKind kind);

/// Whether some pane traces rays through a structure of which `test` holds.
template <class Test>
bool any_structure(const UiState& state, const Test& test) {
  for (const PaneSettings& pane : state.settings.panes) {
    if (traces(pane.device) && test(pane.structure.kind)) return true;
  }
  return false;
}

/// Whether structures have anything to do from frame to frame.
bool scene_moves(const View& view, const UiState& state);

/// A palette as a band over the column's width, from its first colour to its last, and the words at
/// its ends.
void draw_palette_band(const char* name, int palette, const std::string& low,
                       const std::string& high, const std::string& tip);

}  // namespace encore::ui
