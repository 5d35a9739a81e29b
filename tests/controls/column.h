#pragma once

#include "ui/panels/panels.h"
#include "ui/style.h"
#include "ui/widget_map.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>

namespace encore::ui {

/// The settings' column in a Dear ImGui without a window, moved by a mouse that goes where the
/// widget map says.
class Column : public ::testing::Test {
 protected:
  Column() {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.Fonts->AddFontDefault();
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    apply_style(Theme::dark, 1.0F);
    enable_widget_map(true);
    state.settings = default_settings();
    put_scene("toys", 11'141, false);
  }
  ~Column() override {
    enable_widget_map(false);
    clear_widget_map();
    ImGui::DestroyContext();
  }
  Column(const Column&) = delete;
  Column& operator=(const Column&) = delete;

  void put_scene(const std::string& name, std::uint64_t triangles, bool animated) {
    auto scene = std::make_shared<scene::Scene>();
    scene->name = name;
    auto info = std::make_shared<scene::SceneInfo>();
    info->name = name;
    info->triangles = triangles;
    info->bounds = {{-1.0F, -2.0F, -3.0F}, {1.0F, 2.0F, 3.0F}};
    view.scene.scene = scene;
    view.scene.info = info;
    view.scene.animated = animated;
    view.scene.duration_s = animated ? 4.0 : 0.0;
  }

  PaneSettings& left() { return state.settings.panes[0]; }
  PaneSettings& right() { return state.settings.panes[1]; }
  void use(PaneSettings& pane, accel::StructureKind kind) {
    pane.structure = accel::default_spec(kind);
  }

  void frame() {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {1000.0F, std::max(area.bottom(), 900.0F)};
    io.DeltaTime = 1.0F / 60.0F;
    ImGui::NewFrame();
    clear_widget_map();
    draw_settings_column(area, view, state, commands);
    ImGui::Render();
    ++frames;
  }

  std::optional<MappedWidget> find(const std::string& name) const {
    for (const MappedWidget& widget : widget_map()) {
      if (widget.name == name) return widget;
    }
    return std::nullopt;
  }
  /// After two frames: sizes settle in the second.
  bool shown(const std::string& name) {
    frame();
    frame();
    return find(name).has_value();
  }

  void move_to(float x, float y) {
    ImGui::GetIO().MousePos = {x, y};
    frame();
  }
  void press(bool down, int button = 0) {
    ImGui::GetIO().MouseDown[button] = down;
    frame();
  }
  void click(const std::string& name, int button = 0, float share = 0.5F) {
    frame();
    frame();
    const auto widget = find(name);
    ASSERT_TRUE(widget.has_value()) << name;
    // Checkboxes and headers take clicks at their left, where no label is too far away.
    move_to(widget->x + widget->width * share, widget->y + widget->height * 0.5F);
    press(true, button);
    press(false, button);
    frame();
  }
  /// Opens a list and takes an entry of it.
  void choose(const std::string& row, const std::string& word) {
    click(row);
    click(row + "." + word);
  }
  void type(const char* text) {
    ImGui::GetIO().AddInputCharactersUTF8(text);
    frame();
  }
  void enter() {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyMap[ImGuiKey_Enter] = 1;
    io.KeysDown[1] = true;
    frame();
    io.KeysDown[1] = false;
    frame();
  }
  /// Types into a field or a slider that is clicked with Ctrl held.
  void enter_number(const std::string& name, const char* text) {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyCtrl = true;
    click(name);
    io.KeyCtrl = false;
    type(text);
    enter();
  }

  template <class Wanted>
  const Wanted* command() const {
    return commands.size() == 1 ? std::get_if<Wanted>(&commands.front()) : nullptr;
  }

  View view;
  UiState state;
  Commands commands;
  Rect area{0.0F, 0.0F, 300.0F, 3000.0F};
  int frames = 0;
};

}  // namespace encore::ui
