// However low the window is: every widget can be scrolled to, none lies over another or sticks out.
#include "tests/controls/column.h"

#include <set>

namespace encore::ui {
namespace {

class Reach : public Column {
 protected:
  /// All that there is, opened, with every section that can be there.
  void fill(accel::StructureKind kind) {
    put_scene("wave", 20'000, true);
    use(left(), kind);
    left().policy = accel::Policy::automatic;
    right().policy = accel::Policy::automatic;
    left().content = PaneContent::heatmap;
    left().size = SizeChoice::custom;
    state.settings.heatmap.cost = HeatmapCost::energy;
    state.settings.heatmap.automatic_range = false;
    state.settings.overlay.show = true;
    state.settings.overlay.section = true;
    state.selected_node = 4;
    view.scene.warnings = {"frame 7: 3 triangles without area were left out"};
    view.scene.loading = {.active = true, .doing = "reading", .progress = 0.3, .cancellable = true};
    view.panes[0].work = {
        .active = true, .doing = "building", .progress = 0.5, .cancellable = true};
    view.panes[0].device = "CPU, 2 threads";
    auto stats = std::make_shared<accel::BuildStats>();
    stats->max_depth = 18;
    view.panes[0].stats = view.panes[1].stats = stats;
    HeatmapView heatmap;
    heatmap.max = heatmap.bins_high = 90.0;
    heatmap.high = 64.0;
    heatmap.bins = {4, 9, 1};
    heatmap.unit = "J";
    view.panes[0].heatmap = heatmap;
    view.measure = {.measuring = true, .doing = "idle", .progress = 0.5, .together = "by turns"};
    view.recorder.state = RecorderView::State::recording;
    state.settings.energy.from = EnergySettings::From::model;
    for (const char* closed : {"settings.camera", "settings.overlay", "settings.scene.more"}) {
      click(closed, 0, 0.3F);
    }
    ImGui::GetIO().MousePos = {10.0F, 10.0F};
    frame();
  }

  static bool counts(const std::string& name) {
    return name != "settings" && !name.ends_with(".low") && !name.ends_with(".high");
  }
  std::set<std::string> names() {
    frame();
    frame();
    std::set<std::string> all;
    for (const MappedWidget& widget : widget_map()) {
      if (counts(widget.name)) all.insert(widget.name);
    }
    return all;
  }
  void expect_apart() {
    const auto& widgets = widget_map();
    for (std::size_t i = 0; i < widgets.size(); ++i) {
      const MappedWidget& a = widgets[i];
      if (!counts(a.name)) continue;
      EXPECT_GE(a.x, area.x) << a.name;
      EXPECT_LE(a.x + a.width, area.right()) << a.name;
      for (std::size_t k = i + 1; k < widgets.size(); ++k) {
        const MappedWidget& b = widgets[k];
        if (!counts(b.name)) continue;
        const bool apart = a.x + a.width <= b.x + 0.5F || b.x + b.width <= a.x + 0.5F ||
                           a.y + a.height <= b.y + 0.5F || b.y + b.height <= a.y + 0.5F;
        EXPECT_TRUE(apart) << a.name << " and " << b.name;
      }
    }
  }
  void reach_all() {
    const std::set<std::string> all = names();
    EXPECT_GT(all.size(), 60U);
    expect_apart();
    area.height = 320.0F;
    std::set<std::string> reached;
    for (int turns = 0; turns < 400 && reached.size() < all.size(); ++turns) {
      frame();
      for (const MappedWidget& widget : widget_map()) {
        const bool inside = widget.y >= area.y && widget.y + widget.height <= area.bottom();
        if (inside && counts(widget.name)) reached.insert(widget.name);
      }
      ImGui::GetIO().MouseWheel = -1.0F;
      ImGui::GetIO().MousePos = {area.x + 2.0F, area.y + 160.0F};
      frame();
    }
    for (const std::string& name : all) EXPECT_TRUE(reached.contains(name)) << name;
    expect_apart();
  }
};

TEST_F(Reach, KdTreesBesideHierarchies) {
  area = {20.0F, 30.0F, 285.0F, 3600.0F};
  fill(accel::StructureKind::kd_sah);
  reach_all();
}

TEST_F(Reach, GridsInANarrowColumn) {
  area = {0.0F, 0.0F, 200.0F, 3600.0F};
  fill(accel::StructureKind::grid_exact);
  reach_all();
}

TEST_F(Reach, LargeLetters) {
  apply_style(Theme::light, 2.0F);
  ImGui::GetIO().FontGlobalScale = 2.0F;
  area = {0.0F, 0.0F, 570.0F, 6000.0F};
  fill(accel::StructureKind::bvh_median);
  reach_all();
}

TEST_F(Reach, NothingIsDrawnOutsideWithoutAScene) {
  view.scene = {};
  view.scene.problem = "cannot open nowhere.obj: there is no such file";
  frame();
  frame();
  expect_apart();
  EXPECT_TRUE(find("settings.scene.sample").has_value());
  EXPECT_FALSE(find("settings.scene.reload").has_value());
  EXPECT_FALSE(find("settings.left.rebuild").has_value());
}

}  // namespace
}  // namespace encore::ui
