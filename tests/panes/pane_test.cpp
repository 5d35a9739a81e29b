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
  // Away, which is told once, and back to the same pixel.
  move(2.0F, 2.0F);
  frames(3);
  ASSERT_EQ(asked<HoverPixel>().size(), 3U);
  EXPECT_EQ(asked<HoverPixel>()[2].pane, 0U);
  EXPECT_EQ(asked<HoverPixel>()[2].x, -1);
  EXPECT_EQ(asked<HoverPixel>()[2].y, -1);
  move(area.x + pixel * 11.5F, area.y + pixel * 20.5F);
  EXPECT_EQ(asked<HoverPixel>().size(), 4U);
}

TEST_F(Pane, ThePaneThatTheMouseHasLeftIsToldBeforeTheNext) {
  constexpr Rect kLeft{0.0F, 20.0F, 600.0F, 500.0F};
  constexpr Rect kRight{610.0F, 20.0F, 600.0F, 500.0F};
  draw_ = [&] {
    draw_pane(0, kLeft, view_, state_, commands_);
    draw_pane(1, kRight, view_, state_, commands_);
  };
  frames(2);
  move(900.0F, 300.0F);
  move(300.0F, 300.0F);
  const auto told = asked<HoverPixel>();
  ASSERT_EQ(told.size(), 3U);
  EXPECT_EQ(told[1].pane, 1U);
  EXPECT_EQ(told[1].x, -1);
  EXPECT_EQ(told[2].pane, 0U);
  EXPECT_GE(told[2].x, 0);
  // A picture that goes away is left, too.
  view_.panes[0].texture = 0;
  frames(2);
  ASSERT_EQ(asked<HoverPixel>().size(), 4U);
  EXPECT_EQ(asked<HoverPixel>()[3].x, -1);
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

TEST_F(Pane, NarrowPanesKeepWhatMattersMost) {
  PaneView& pane = view_.panes[0];
  pane.frame = FrameFigures{};
  pane.frame->render_s = 0.0276;
  pane.frame->rays = 91'234;
  pane.frames_per_s = 36.2;
  pane.joules_per_frame = {0.0123, 0.0004, {energy::Origin::measured, "RAPL package 0"}};
  view_.measure.measuring = true;
  float width = 0.0F;
  draw_ = [&] { draw_pane(0, {0.0F, 0.0F, width, 500.0F}, view_, state_, commands_); };
  // Widths in ems of panes in a window of 1280 pixels: two of them, three of them.
  const float em = ImGui::GetIO().Fonts->Fonts[0]->FontSize;
  for (const float ems : {23.6F, 15.6F}) {
    width = ems * em;
    for (const bool mine : {true, false}) {
      pane.my_slot = mine;
      frames(2);
      for (const char* name : {"pane.0.ms", "pane.0.joules", "pane.0.badge", "pane.0.rays",
                               "pane.0.passing", "pane.0.structure", "pane.0.content"}) {
        const auto widget = find(name);
        ASSERT_TRUE(widget) << name << " at " << ems << " em";
        EXPECT_LE(widget->x + widget->width, width) << name << " at " << ems << " em";
      }
      const auto passing = shown("pane.0.passing");
      EXPECT_EQ(passing.find("…"), std::string::npos) << passing;
      const auto rays = find("pane.0.rays");
      const auto slot = find("pane.0.passing");
      EXPECT_TRUE(rays->y + rays->height <= slot->y || rays->x + rays->width <= slot->x);
    }
  }
  EXPECT_EQ(shown("pane.0.ms"), "27.6 ms");
  EXPECT_EQ(shown("pane.0.joules"), "12.3 mJ");
  EXPECT_EQ(shown("pane.0.rays"), "3.31 Mrays/s");
}

TEST_F(Pane, ContentStaysToBeChosenWithoutRoomForItsWord) {
  draw_ = [&] { draw_pane(0, {0.0F, 0.0F, 210.0F, 500.0F}, view_, state_, commands_); };
  frames(2);
  const auto content = find("pane.0.content");
  ASSERT_TRUE(content);
  EXPECT_EQ(content->state, "picture") << "the map has the word, the screen the arrow";
  EXPECT_LE(content->x + content->width, 210.0F);
  click("pane.0.content");
  frames(2);
  click("pane.0.content.heatmap");
  EXPECT_EQ(state_.settings.panes[0].content, PaneContent::heatmap);
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
