#pragma once

#include "ui/panels/panels.h"
#include "ui/style.h"
#include "ui/widget_map.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace encore::test {

/// The whole window drawn without a backend: frames, keys and clicks as a person makes them.
class Shell : public testing::Test {
 protected:
  void SetUp() override {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {1280.0F, 800.0F};
    io.IniFilename = nullptr;
    ui::rebuild_fonts(1.0F);
    ui::apply_style(ui::Theme::dark, 1.0F);
    io.KeyMap[ImGuiKey_Enter] = GLFW_KEY_ENTER;
    io.KeyMap[ImGuiKey_Backspace] = GLFW_KEY_BACKSPACE;
    io.KeyMap[ImGuiKey_Escape] = GLFW_KEY_ESCAPE;
    ui::enable_widget_map(true);
    state.settings = ui::default_settings();
    frames(3);
  }
  void TearDown() override {
    ui::enable_widget_map(false);
    ImGui::DestroyContext();
  }

  void frames(int count = 1) {
    for (int i = 0; i < count; ++i) {
      ui::clear_widget_map();
      ImGui::GetIO().DeltaTime = 1.0F / 60.0F;
      ImGui::NewFrame();
      ui::draw_window(view, state, commands);
      ImGui::Render();
    }
  }

  void key(int code, bool control = false, bool shift = false) {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyCtrl = control;
    io.KeyShift = shift;
    io.KeysDown[code] = true;
    frames();
    io.KeysDown[code] = false;
    io.KeyCtrl = io.KeyShift = false;
    frames(2);
  }

  void type(std::string_view text) {
    for (const char c : text) ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(c));
    frames(2);
  }

  static const ui::MappedWidget* find(std::string_view name) {
    const auto& map = ui::widget_map();
    const auto found = std::find_if(map.begin(), map.end(),
                                    [&](const ui::MappedWidget& w) { return w.name == name; });
    return found == map.end() ? nullptr : &*found;
  }

  void move(float x, float y) {
    ImGui::GetIO().MousePos = {x, y};
    frames(2);
  }
  void button(bool down) {
    ImGui::GetIO().MouseDown[0] = down;
    frames();
  }

  /// Fails the test if there is no such widget.
  void click(std::string_view name) {
    const ui::MappedWidget* widget = find(name);
    ASSERT_NE(widget, nullptr) << name << "\n" << ui::widget_map_text();
    move(widget->x + widget->width / 2.0F, widget->y + widget->height / 2.0F);
    button(true);
    button(false);
    frames(3);
  }

  template <class Wanted>
  const Wanted* last() const {
    return commands.empty() ? nullptr : std::get_if<Wanted>(&commands.back());
  }

  ui::View view;
  ui::UiState state;
  ui::Commands commands;
};

}  // namespace encore::test
