#pragma once

#include "ui/widget_map.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <string>

namespace encore::ui::test {

/// Dear ImGui without a screen: frames are laid out and drawn into lists, the mouse is ours.
class Screenless : public ::testing::Test {
 protected:
  void SetUp() override {
    context_ = ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {1000.0F, 700.0F};
    io.DeltaTime = 1.0F / 60.0F;
    io.IniFilename = nullptr;
    io.MousePos = {-1.0F, -1.0F};
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    io.Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    enable_widget_map(true);
  }
  void TearDown() override {
    enable_widget_map(false);
    clear_widget_map();
    ImGui::DestroyContext(context_);
  }

  /// One frame with `draw` in a window that fills the display.
  template <class Draw>
  void frame(const Draw& draw) {
    clear_widget_map();
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    ImGui::Begin("plots", nullptr, ImGuiWindowFlags_NoDecoration);
    draw();
    ImGui::End();
    ImGui::Render();
  }

  static MappedWidget widget(const std::string& name) {
    for (const MappedWidget& found : widget_map()) {
      if (found.name == name) return found;
    }
    ADD_FAILURE() << "no widget called " << name;
    return {};
  }
  /// Puts the mouse at a share of a widget's size.
  static void mouse_at(const MappedWidget& place, float x, float y) {
    ImGui::GetIO().MousePos = {place.x + x * place.width, place.y + y * place.height};
  }
  static void button(int index, bool down) { ImGui::GetIO().MouseDown[index] = down; }
  static int vertices() { return ImGui::GetDrawData()->TotalVtxCount; }
  /// Whether a tooltip window was drawn in the last frame.
  static bool tooltip_drawn() {
    const ImDrawData* data = ImGui::GetDrawData();
    for (int i = 0; i < data->CmdListsCount; ++i) {
      const char* owner = data->CmdLists[i]->_OwnerName;
      if (owner != nullptr && std::string(owner).find("Tooltip") != std::string::npos) return true;
    }
    return false;
  }

 private:
  ImGuiContext* context_ = nullptr;
};

}  // namespace encore::ui::test
