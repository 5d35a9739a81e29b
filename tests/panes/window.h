#pragma once

#include "accel/inspect/node_measures.h"
#include "accel/inspect/node_table.h"
#include "accel/make_structure.h"
#include "scene/sample_scenes.h"
#include "scene/triangles.h"
#include "ui/panels/panels.h"
#include "ui/style.h"
#include "ui/widget_map.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace encore::ui::test {

/// Dear ImGui without a screen, and a person at it who moves the mouse and presses keys.
class Window : public ::testing::Test {
 protected:
  static constexpr Rect kPane{10.0F, 20.0F, 640.0F, 560.0F};
  static constexpr int kLeftKey = 263;  ///< as GLFW numbers them
  static constexpr int kRightKey = 262;

  Window() {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {1280.0F, 900.0F};
    io.DeltaTime = 1.0F / 60.0F;
    io.KeyMap[ImGuiKey_LeftArrow] = kLeftKey;
    io.KeyMap[ImGuiKey_RightArrow] = kRightKey;
    io.MousePos = {-1.0F, -1.0F};
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    apply_style(Theme::dark, 1.0F);
    enable_widget_map(true);
    state_.settings = default_settings();
    fill_picture(view_.panes[0]);
    fill_picture(view_.panes[1]);
    draw_ = [this] { draw_pane(0, kPane, view_, state_, commands_); };
  }
  ~Window() override {
    enable_widget_map(false);
    clear_widget_map();
    ImGui::DestroyContext();
  }

  static void fill_picture(PaneView& pane) {
    pane.state = PaneState::ready;
    pane.texture = 1;
    pane.width = 320;
    pane.height = 240;
    pane.traced_width = 320;
    pane.traced_height = 240;
  }

  void frame() {
    clear_widget_map();
    ImGui::NewFrame();
    draw_();
    ImGui::Render();
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) frame();
  }
  void move(float x, float y) {
    ImGui::GetIO().MousePos = {x, y};
    frame();
  }
  void press(int button, bool down = true) {
    ImGui::GetIO().MouseDown[button] = down;
    frame();
  }
  void drag(int button, float from_x, float from_y, float to_x, float to_y) {
    move(from_x, from_y);
    press(button);
    move((from_x + to_x) / 2.0F, (from_y + to_y) / 2.0F);
    move(to_x, to_y);
    press(button, false);
  }
  void click(float x, float y) {
    move(x, y);
    press(0);
    press(0, false);
  }
  void key(int code) {
    ImGui::GetIO().KeysDown[code] = true;
    frame();
    ImGui::GetIO().KeysDown[code] = false;
    frame();
  }

  static std::optional<MappedWidget> find(const std::string& name) {
    for (const MappedWidget& widget : widget_map()) {
      if (widget.name == name) return widget;
    }
    return std::nullopt;
  }
  static std::string shown(const std::string& name) {
    const auto widget = find(name);
    return widget ? widget->state : "not there";
  }
  /// Clicks the middle of a widget of the last frame.
  void click(const std::string& name) {
    const auto widget = find(name);
    ASSERT_TRUE(widget) << name << " is not there; there are\n" << widget_map_text();
    click(widget->x + widget->width / 2.0F, widget->y + widget->height / 2.0F);
  }

  template <class Kind>
  [[nodiscard]] std::vector<Kind> asked() const {
    std::vector<Kind> all;
    for (const Command& command : commands_) {
      if (const auto* kind = std::get_if<Kind>(&command)) all.push_back(*kind);
    }
    return all;
  }

  View view_;
  UiState state_;
  Commands commands_;
  std::function<void()> draw_;
};

/// A structure over a sample scene, and what a pane knows of it.
struct Built {
  explicit Built(accel::StructureKind kind, std::string_view name = "toys") {
    const scene::Scene scene = scene::make_sample_scene(name).value();
    scene::update_triangles(scene, 0.0, list);
    structure = accel::make_structure(accel::default_spec(kind));
    structure->build(list.triangles);
    nodes = std::make_shared<const accel::NodeTable>(accel::NodeTable::make(*structure));
  }
  void fill(PaneView& pane) const {
    pane.stats = std::make_shared<const accel::BuildStats>(structure->stats());
    pane.nodes = nodes;
    pane.profile = std::make_shared<const accel::StructureProfile>(accel::profile_of(*nodes));
    pane.node_values = std::make_shared<const accel::NodeValues>(
        accel::measure_nodes(*nodes, accel::NodeMeasure::depth));
  }
  scene::TriangleList list;
  std::unique_ptr<accel::AccelerationStructure> structure;
  std::shared_ptr<const accel::NodeTable> nodes;
};

}  // namespace encore::ui::test
