// What colours mean stands beside the picture: the range, where modelled energy comes from, and why
// there is no difference.
#include "window.h"

namespace encore::ui::test {
namespace {

class Legend : public Window {
 protected:
  void show_heatmap() {
    state_.settings.panes[0].content = PaneContent::heatmap;
    HeatmapView map;
    map.min = 0.0;
    map.max = 200.0;
    map.low = 0.0;
    map.high = 100.0;
    map.unit = "steps";
    map.bins.assign(64, 5);
    map.bins_low = 0.0;
    map.bins_high = 200.0;
    view_.panes[0].heatmap = map;
    frames(2);
  }
};

TEST_F(Legend, DraggingAnEndSetsTheRange) {
  show_heatmap();
  EXPECT_EQ(shown("pane.0.legend"), "steps a pixel");
  EXPECT_EQ(shown("pane.0.heatmap.high"), "100 steps");
  ASSERT_TRUE(state_.settings.heatmap.automatic_range);
  const auto handle = find("pane.0.heatmap.high").value_or(MappedWidget{});
  const auto bars = find("pane.0.heatmap.histogram").value_or(MappedWidget{});
  ASSERT_GT(bars.width, 50.0F);
  const float y = handle.y + handle.height / 2.0F;
  drag(0, handle.x + handle.width / 2.0F, y, bars.x + bars.width * 0.75F, y);
  EXPECT_FALSE(state_.settings.heatmap.automatic_range);
  EXPECT_NEAR(state_.settings.heatmap.high, 150.0F, 1.0F);
  EXPECT_EQ(state_.settings.heatmap.low, 0.0F);
  EXPECT_EQ(state_.camera, scene::Camera{}) << "the picture below was not dragged";
}

TEST_F(Legend, LowEndStaysBelowTheHighOne) {
  show_heatmap();
  const auto handle = find("pane.0.heatmap.low").value_or(MappedWidget{});
  const auto bars = find("pane.0.heatmap.histogram").value_or(MappedWidget{});
  const float y = handle.y + handle.height / 2.0F;
  drag(0, handle.x + handle.width / 2.0F, y, bars.x + bars.width * 0.9F, y);
  EXPECT_FALSE(state_.settings.heatmap.automatic_range);
  EXPECT_EQ(state_.settings.heatmap.low, 100.0F);
  EXPECT_EQ(state_.settings.heatmap.high, 100.0F);
}

TEST_F(Legend, ModelledEnergySaysSo) {
  show_heatmap();
  view_.panes[0].heatmap->unit = "J";
  view_.panes[0].heatmap->high = 2e-9;
  view_.panes[0].heatmap->provenance = {energy::Origin::modelled, "2.1 W times the frame's time"};
  frames(2);
  EXPECT_EQ(shown("pane.0.legend.badge"), "modelled");
  EXPECT_EQ(shown("pane.0.legend"), "Joules a pixel");
}

TEST_F(Legend, EnergyThatIsNotKnownSaysWhy) {
  state_.settings.panes[0].content = PaneContent::heatmap;
  HeatmapView map;
  map.provenance = {energy::Origin::unavailable, "no joules a frame are known"};
  view_.panes[0].heatmap = map;
  frames(2);
  EXPECT_EQ(shown("pane.0.legend.reason"), "no joules a frame are known");
  EXPECT_FALSE(find("pane.0.heatmap.high"));
}

TEST_F(Legend, DifferenceSaysWhatAndWhyNot) {
  state_.settings.panes[0].content = PaneContent::difference;
  view_.panes[1].width = 640;
  frames(2);
  EXPECT_EQ(shown("pane.0.legend.reason"),
            "No difference: this picture has 320 × 240 pixels, the other one 640 × 240. Set the "
            "same size for both.");
  state_.settings.panes[1].device = PaneDevice::off;
  frames(2);
  EXPECT_EQ(shown("pane.0.legend.reason"),
            "No difference: the other pane is off. Switch it on to compare with it.");
  state_.settings.panes[1].device = PaneDevice::gpu;
  view_.panes[0].difference = DifferenceView{0.001, 0.5, 12, 3, 76'800};
  frames(2);
  EXPECT_EQ(shown("pane.0.legend"), "Difference from the GPU pane");
  EXPECT_EQ(shown("pane.0.legend.line"), "RMSE 0.001, largest 0.5");
}

}  // namespace
}  // namespace encore::ui::test
