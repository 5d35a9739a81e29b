#pragma once

#include "ui/panels/panels.h"
#include "ui/style.h"
#include "ui/widget_map.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <optional>
#include <string>
#include <variant>

namespace encore::ui {

/// Draws panels in a Dear ImGui context without a screen and uses them as a person would: each
/// widget is found by its name in the widget map and clicked there.
class PanelTest : public testing::Test {
 protected:
  PanelTest() {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {1600.0F, 960.0F};
    io.DeltaTime = 1.0F / 60.0F;
    io.Fonts->AddFontDefault();
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    enable_widget_map(true);
    clear_widget_map();
  }
  ~PanelTest() override {
    enable_widget_map(false);
    ImGui::DestroyContext();
  }

  /// What is drawn in each frame.
  virtual void draw() = 0;

  void frame() {
    clear_widget_map();
    ImGui::NewFrame();
    draw();
    ImGui::Render();
  }
  /// Enough for windows to find their sizes.
  void settle() {
    for (int i = 0; i < 4; ++i) frame();
  }

  [[nodiscard]] static const MappedWidget* widget(const std::string& name) {
    const auto& all = widget_map();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const MappedWidget& one) { return one.name == name; });
    return found == all.end() ? nullptr : &*found;
  }
  [[nodiscard]] static std::string state_of(const std::string& name) {
    const MappedWidget* found = widget(name);
    return found == nullptr ? "(not there)" : found->state;
  }

  /// The mouse goes to the middle of a widget and clicks.
  void click(const std::string& name) {
    settle();
    const MappedWidget* found = widget(name);
    ASSERT_NE(found, nullptr) << name << " is not drawn; there are:\n" << widget_map_text();
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = {found->x + 0.5F * found->width, found->y + 0.5F * found->height};
    frame();
    io.MouseDown[0] = true;
    frame();
    io.MouseDown[0] = false;
    frame();
    io.MousePos = {-1.0F, -1.0F};
    // Far enough from the next click to be no double click.
    for (int i = 0; i < 60; ++i) frame();
  }
  /// Types into the field that has the keyboard.
  void type(const std::string& text) {
    ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
    settle();
  }

  /// The last command of a kind; forgets all.
  template <class Kind>
  std::optional<Kind> last() {
    std::optional<Kind> found;
    for (const Command& command : commands) {
      if (const auto* one = std::get_if<Kind>(&command)) found = *one;
    }
    commands.clear();
    return found;
  }

  View view;
  UiState state;
  Commands commands;
};

inline bool has_digit(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace encore::ui
