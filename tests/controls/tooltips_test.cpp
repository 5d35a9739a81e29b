// Every widget says what it is, after a moment, also where it is greyed.
#include "tests/controls/column.h"

namespace encore::ui {
namespace {

class Tooltips : public Column {
 protected:
  static int windows() { return ImGui::GetIO().MetricsRenderWindows; }
  /// Frames until a tooltip is there; nothing if there is none within a second.
  std::optional<int> frames_until_tooltip(float x, float y) {
    ImGui::GetIO().MousePos = {-1.0F, -1.0F};
    frame();
    frame();
    const int without = windows();
    for (int count = 1; count <= 60; ++count) {
      move_to(x, y);
      if (windows() > without) return count;
    }
    return std::nullopt;
  }
};

TEST_F(Tooltips, AreThereForEveryWidgetAndWaitAMoment) {
  put_scene("wave", 20'000, true);
  use(left(), accel::StructureKind::kd_sah);
  left().content = PaneContent::heatmap;
  state.settings.overlay.show = true;
  for (const char* closed : {"settings.camera", "settings.overlay", "settings.scene.more"}) {
    click(closed, 0, 0.3F);
  }
  frame();
  const std::vector<MappedWidget> widgets = widget_map();
  ASSERT_GT(widgets.size(), 60U);
  for (const MappedWidget& widget : widgets) {
    if (widget.name == "settings") continue;
    const auto waited =
        frames_until_tooltip(widget.x + widget.width * 0.5F, widget.y + widget.height * 0.5F);
    ASSERT_TRUE(waited.has_value()) << widget.name;
    EXPECT_GT(*waited, 10) << widget.name;
  }
}

TEST_F(Tooltips, AreThereForGreyedButtons) {
  view.scene.info.reset();  // there is nothing to focus on
  click("settings.camera", 0, 0.3F);
  ASSERT_TRUE(shown("settings.camera.focus"));
  const MappedWidget button = *find("settings.camera.focus");
  EXPECT_EQ(button.state, "disabled");
  EXPECT_TRUE(frames_until_tooltip(button.x + 4.0F, button.y + 4.0F).has_value());
}

}  // namespace
}  // namespace encore::ui
