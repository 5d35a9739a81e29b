#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace encore::ui {

/// Where each named widget lies in the window, in pixels from its top left, for programs that drive
/// the window as a person would: the tests, screen recorders. Off unless the program is told where
/// to write it; then it costs a string a widget and frame, else one comparison.
struct MappedWidget {
  std::string name;  ///< as panels name it: "structure.kind.cpu"
  float x = 0.0F;
  float y = 0.0F;
  float width = 0.0F;
  float height = 0.0F;
  std::string state;  ///< what it shows: "on", "off", a value; may be empty

  friend bool operator==(const MappedWidget&, const MappedWidget&) = default;
};

/// Begins a frame: what was noted before is forgotten.
void clear_widget_map();
void enable_widget_map(bool on);
[[nodiscard]] bool widget_map_enabled();
/// Notes the widget that Dear ImGui drew last.
void note_widget(std::string_view name, std::string_view state = {});
/// Notes any rectangle.
void note_area(std::string_view name, float x, float y, float width, float height,
               std::string_view state = {});
[[nodiscard]] const std::vector<MappedWidget>& widget_map();

/// One line a widget: name, x, y, width, height, state, with tabs between them.
[[nodiscard]] std::string widget_map_text();

}  // namespace encore::ui
