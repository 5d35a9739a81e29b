#include "ui/widget_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace encore::ui {

namespace {

/// Dear ImGui's own state is global, too: one window, one thread.
struct Map {
  bool enabled = false;
  std::vector<MappedWidget> widgets;
};

Map& map() {
  static Map instance;
  return instance;
}

}  // namespace

void clear_widget_map() {
  map().widgets.clear();
}

void enable_widget_map(bool on) {
  map().enabled = on;
}

bool widget_map_enabled() {
  return map().enabled;
}

void note_widget(std::string_view name, std::string_view state) {
  if (!map().enabled) return;
  const ImVec2 from = ImGui::GetItemRectMin();
  const ImVec2 size = ImGui::GetItemRectSize();
  // What is scrolled out of sight cannot be clicked.
  const bool visible = ImGui::IsItemVisible();
  if (visible) note_area(name, from.x, from.y, size.x, size.y, state);
}

void note_area(std::string_view name, float x, float y, float width, float height,
               std::string_view state) {
  if (!map().enabled) return;
  map().widgets.push_back({std::string(name), x, y, width, height, std::string(state)});
}

const std::vector<MappedWidget>& widget_map() {
  return map().widgets;
}

std::string widget_map_text() {
  std::string text;
  for (const MappedWidget& widget : map().widgets) {
    std::string state = widget.state;
    std::replace_if(
        state.begin(), state.end(), [](char c) { return c == '\t' || c == '\n'; }, ' ');
    text += fmt::format("{}\t{:.0f}\t{:.0f}\t{:.0f}\t{:.0f}\t{}\n", widget.name, widget.x, widget.y,
                        widget.width, widget.height, state);
  }
  return text;
}

}  // namespace encore::ui
