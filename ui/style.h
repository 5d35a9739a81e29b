#pragma once

#include "energy/provenance.h"
#include "ui/ui_state.h"

#include <imgui.h>

#include <filesystem>
#include <optional>

namespace encore::ui {

/// The colours that mean something, in either theme readable on windows (contrast of at least 4.5).
struct ThemeColors {
  ImVec4 background;  ///< of columns, plots and dialogs
  ImVec4 canvas;      ///< behind pictures, and in the gaps between parts
  ImVec4 text;
  ImVec4 dim_text;  ///< words beside figures, hints
  ImVec4 accent;    ///< what is selected, links, progress
  ImVec4 good;
  ImVec4 warning;
  ImVec4 problem;
  ImVec4 measured;
  ImVec4 modelled;
  ImVec4 simulated;
  ImVec4 unavailable;
};
const ThemeColors& theme_colors(Theme theme);
/// Green, amber, violet or grey.
ImVec4 origin_color(Theme theme, energy::Origin origin);

/// Sets all colours of Dear ImGui, and its sizes for a scale. To be called when either changes,
/// between frames.
void apply_style(Theme theme, float scale);

inline constexpr float kSmallestScale = 0.75F;
inline constexpr float kLargestScale = 3.0F;
/// Font size in pixels at scale 1.
inline constexpr float kFontPixels = 15.0F;

/// The scale that the user has set, or else the monitor's; within the limits above.
float ui_scale(const Preferences& preferences, float monitor_scale);
/// One step of Ctrl+Plus or Ctrl+Minus: a quarter up or down, on whole quarters.
float next_scale(float scale, int direction);

/// A font file of the system by its name ("DejaVuSans.ttf"), looked for in the usual folders of
/// fonts; nothing if it is not there.
std::optional<std::filesystem::path> find_font(const char* file_name);

/// Which fonts rebuild_fonts() found.
struct FontReport {
  bool sans = false;
  bool mono = false;
  bool bold = false;
  [[nodiscard]] bool complete() const { return sans && mono && bold; }
};
/// Makes Dear ImGui's fonts anew for a scale: DejaVu Sans, its mono-spaced and its bold kin, each
/// with Latin and Greek letters, arrows and the signs of units and formulas. What is not found is
/// replaced by Dear ImGui's own font (which has Latin letters only). To be called between frames;
/// the atlas is built, its texture is for the caller to upload again.
FontReport rebuild_fonts(float scale);

/// For numbers in columns and for code.
ImFont* mono_font();
/// For headings; somewhat larger.
ImFont* heading_font();

}  // namespace encore::ui
