// A pane tells which pixel the mouse means, asks for what its buttons say, and shows no number that
// it does not know.
#include "ui/widgets.h"
#include "window.h"

#include <algorithm>

namespace encore::ui::test {
namespace {

class Pane : public Window {
 protected:
  MappedWidget picture() {
    frames(2);
    return find("pane.0.picture").value_or(MappedWidget{});
  }
  static bool has_digit(const std::string& text) {
    return std::any_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  }
};

TEST_F(Pane, ClickPicksThePixelUnderTheMouse) {
  const MappedWidget area = picture();
  ASSERT_GT(area.width, 320.0F) << "shown larger than it is";
  EXPECT_NEAR(area.width / area.height, 4.0F / 3.0F, 0.01F);
  const auto at = [&](int x, int y) {
    click(area.x + (static_cast<float>(x) + 0.5F) / 320.0F * area.width,
          area.y + (static_cast<float>(y) + 0.5F) / 240.0F * area.height);
  };
  at(0, 0);
  at(319, 239);
  at(17, 200);
  const auto picks = asked<PickPixel>();
  ASSERT_EQ(picks.size(), 3U);
  EXPECT_EQ(picks[0].x, 0);
  EXPECT_EQ(picks[0].y, 0);
  EXPECT_EQ(picks[1].x, 319);
  EXPECT_EQ(picks[1].y, 239);
  EXPECT_EQ(picks[2].x, 17);
  EXPECT_EQ(picks[2].y, 200);
  EXPECT_EQ(picks[2].pane, 0U);
}

TEST_F(Pane, ShakingHandStillClicks) {
  const MappedWidget area = picture();
  const scene::Camera before = state_.camera;
  drag(0, area.x + 50.0F, area.y + 50.0F, area.x + 53.0F, area.y + 51.0F);
  EXPECT_EQ(asked<PickPixel>().size(), 1U);
  EXPECT_EQ(state_.camera, before);
}

TEST_F(Pane, HoverIsToldOnceAPixel) {
  const MappedWidget area = picture();
  const float pixel = area.width / 320.0F;
  move(area.x + pixel * 10.2F, area.y + pixel * 20.2F);
  frames(3);
  move(area.x + pixel * 10.7F, area.y + pixel * 20.7F);
  ASSERT_EQ(asked<HoverPixel>().size(), 1U);
  EXPECT_EQ(asked<HoverPixel>()[0].x, 10);
  EXPECT_EQ(asked<HoverPixel>()[0].y, 20);
  move(area.x + pixel * 11.5F, area.y + pixel * 20.5F);
  EXPECT_EQ(asked<HoverPixel>().size(), 2U);
  // Away, and back to the same pixel.
  move(2.0F, 2.0F);
  move(area.x + pixel * 11.5F, area.y + pixel * 20.5F);
  EXPECT_EQ(asked<HoverPixel>().size(), 3U);
}

TEST_F(Pane, HoverBoxTellsWhatIsKnown) {
  const MappedWidget area = picture();
  PixelView pixel;
  pixel.x = 3;
  pixel.y = 4;
  pixel.found = true;
  pixel.distance = 12.5;
  pixel.triangle = 4711;
  pixel.material = "red";
  pixel.steps = 31;
  pixel.box_tests = 62;
  pixel.triangle_tests = 9;
  view_.panes[0].hover = pixel;
  move(2.0F, 2.0F);
  EXPECT_EQ(shown("pane.hover"), "not there");
  move(area.x + 30.0F, area.y + 30.0F);
  EXPECT_EQ(shown("pane.hover"),
            "pixel 3, 4; distance 12.5; triangle 4,711; material red; 31 steps; 62 box tests; 9 "
            "triangle tests");
}

TEST_F(Pane, TellsTheRoomForThePicture) {
  frame();
  const UiState::Area area = state_.picture_areas[0];
  EXPECT_EQ(area.width, 640);
  EXPECT_GT(area.height, 400);
  EXPECT_LT(area.height, 560) << "less the header";
  // Whatever the pane shows, so that the pictures of two panes can be compared.
  state_.settings.panes[0].content = PaneContent::difference;
  view_.measure.measuring = true;
  frame();
  EXPECT_EQ(state_.picture_areas[0].width, area.width);
  EXPECT_EQ(state_.picture_areas[0].height, area.height);
}

TEST_F(Pane, WorkShowsAndCanBeCancelledOnceItLasts) {
  PaneView& pane = view_.panes[0];
  pane.state = PaneState::working;
  pane.work = {true, "building kd-sah over 1,087,716 triangles", 0.42, true, 0.2};
  frames(2);
  EXPECT_FALSE(find("pane.0.cancel")) << "too short to show";
  pane.work.elapsed_s = 1.5;
  frames(2);
  EXPECT_EQ(shown("pane.0.state"), "building kd-sah over 1,087,716 triangles, 42 % (1.50 s)");
  click("pane.0.cancel");
  ASSERT_EQ(asked<CancelWork>().size(), 1U);
  EXPECT_EQ(asked<CancelWork>()[0].pane, std::size_t{0});
  EXPECT_TRUE(asked<PickPixel>().empty()) << "the button is not the picture";
  pane.work.cancellable = false;
  frames(2);
  EXPECT_FALSE(find("pane.0.cancel"));
}

TEST_F(Pane, GoesOnAfterCancelAndFailure) {
  view_.panes[0].state = PaneState::cancelled;
  frames(2);
  click("pane.0.go_on");
  ASSERT_EQ(asked<Rebuild>().size(), 1U);
  view_.panes[0].state = PaneState::failed;
  view_.panes[0].problem = "the graphics device has 128 MiB a block, 260 MiB are needed";
  frames(2);
  EXPECT_EQ(shown("pane.0.state"), view_.panes[0].problem);
  click("pane.0.try_again");
  ASSERT_EQ(asked<Rebuild>().size(), 2U);
  EXPECT_EQ(asked<Rebuild>()[1].pane, 0U);
}

TEST_F(Pane, SwitchesOn) {
  state_.settings.panes[0].device = PaneDevice::off;
  frames(2);
  EXPECT_FALSE(find("pane.0.picture"));
  click("pane.0.switch_on");
  EXPECT_EQ(state_.settings.panes[0].device, PaneDevice::cpu);
}

TEST_F(Pane, WaitsForTheSceneWithWords) {
  view_.panes[0].state = PaneState::waiting;
  view_.panes[0].texture = 0;
  view_.scene.loading = {true, "reading bunny.ply", 0.5, true, 1.0};
  frames(2);
  EXPECT_EQ(shown("pane.0.state"), "waiting for the scene: reading bunny.ply");
}

TEST_F(Pane, MissingEnergyShowsNoDigit) {
  PaneView& pane = view_.panes[0];
  pane.joules_per_frame.provenance = {energy::Origin::unavailable, "no sensor can be read"};
  frames(2);
  EXPECT_EQ(shown("pane.0.badge"), "unavailable");
  EXPECT_FALSE(has_digit(shown("pane.0.joules"))) << shown("pane.0.joules");
  EXPECT_EQ(figure_text(pane.joules_per_frame, "J"), "unavailable");
  EXPECT_FALSE(find("pane.0.ms")) << "no frame, no time";
  EXPECT_FALSE(find("pane.0.fps"));
  EXPECT_FALSE(find("pane.0.rays"));
}

TEST_F(Pane, FiguresOfTheLastFrame) {
  PaneView& pane = view_.panes[0];
  pane.frame = FrameFigures{};
  pane.frame->build_s = 0.010;
  pane.frame->render_s = 0.040;
  pane.frame->rays = 80'000;
  pane.frames_per_s = 20.0;
  pane.joules_per_frame = {0.0123, 0.0004, {energy::Origin::measured, "RAPL package 0"}};
  frames(2);
  EXPECT_EQ(shown("pane.0.ms"), "50.0 ms a frame");
  EXPECT_EQ(shown("pane.0.fps"), "20.0 fps");
  EXPECT_EQ(shown("pane.0.joules"), "12.30 ±0.40 mJ a frame");
  EXPECT_EQ(shown("pane.0.badge"), "measured");
  EXPECT_EQ(shown("pane.0.rays"), "2 Mrays/s");
}

TEST_F(Pane, TellsThatItRefinesOrWhoseSlotItIs) {
  view_.panes[0].traced_width = 160;
  view_.panes[0].traced_height = 120;
  frames(2);
  EXPECT_EQ(shown("pane.0.passing"), "refining 160 × 120");
  view_.measure.measuring = true;
  view_.panes[0].my_slot = true;
  frames(2);
  EXPECT_EQ(shown("pane.0.passing"), "its slot");
}

TEST_F(Pane, QuickChoicesShowOnlyWhatApplies) {
  frames(2);
  click("pane.0.structure");
  frames(2);
  click("pane.0.structure.kd-sah");
  EXPECT_EQ(state_.settings.panes[0].structure.kind, accel::StructureKind::kd_sah);
  EXPECT_TRUE(
      std::holds_alternative<accel::KdTreeSettings>(state_.settings.panes[0].structure.settings));
  frames(2);
  click("pane.0.device");
  frames(2);
  click("pane.0.device.raster");
  EXPECT_EQ(state_.settings.panes[0].device, PaneDevice::raster);
  frames(2);
  EXPECT_FALSE(find("pane.0.structure")) << "a rasteriser has none";
  click("pane.0.content");
  frames(2);
  EXPECT_TRUE(find("pane.0.content.difference"));
  EXPECT_FALSE(find("pane.0.content.heatmap")) << "it traces no rays";
}

}  // namespace
}  // namespace encore::ui::test
