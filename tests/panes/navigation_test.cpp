// The mouse moves the camera by scene/camera_motion.h, in both panes alike, and says so while it
// does.
#include "scene/camera_motion.h"
#include "scene/scene_info.h"
#include "window.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <utility>

namespace encore::ui::test {
namespace {

class Navigation : public Window {
 protected:
  /// Where the picture lies.
  MappedWidget picture() {
    frames(2);
    return find("pane.0.picture").value_or(MappedWidget{});
  }
};

double distance(const glm::vec3& a, const glm::vec3& b) {
  return std::sqrt(std::pow(double(a.x) - double(b.x), 2.0) +
                   std::pow(double(a.y) - double(b.y), 2.0) +
                   std::pow(double(a.z) - double(b.z), 2.0));
}

TEST_F(Navigation, LeftDragOrbits) {
  const MappedWidget area = picture();
  const scene::Camera before = state_.camera;
  const float x = area.x + 100.0F;
  const float y = area.y + 100.0F;
  move(x, y);
  press(0);
  move(x + 60.0F, y + 20.0F);
  EXPECT_TRUE(state_.camera_moving);
  const double turn = std::numbers::pi / double(area.height);
  const scene::Camera expected = scene::orbit(before, -60.0 * turn, 20.0 * turn, scene::Axis::y);
  EXPECT_EQ(state_.camera, expected);
  press(0, false);
  frames(2);
  EXPECT_EQ(state_.camera, expected);
  EXPECT_FALSE(state_.camera_moving);
  EXPECT_TRUE(asked<PickPixel>().empty()) << "a drag is no click";
}

TEST_F(Navigation, UpAxisIsTheOneThatIsSet) {
  const MappedWidget area = picture();
  state_.preferences.up_axis = 2;
  const scene::Camera before = state_.camera;
  drag(0, area.x + 50.0F, area.y + 50.0F, area.x + 90.0F, area.y + 50.0F);
  EXPECT_NE(state_.camera, before);
  EXPECT_EQ(state_.camera.up, glm::vec3(0.0F, 0.0F, 1.0F));
}

TEST_F(Navigation, MiddleDragAndShiftDragPanSoThatThePointFollows) {
  const MappedWidget area = picture();
  const scene::Camera before = state_.camera;
  const double aspect = double(area.width) / double(area.height);
  const scene::Camera expected =
      scene::pan(before, 80.0 / double(area.width), 40.0 / double(area.height), aspect);
  drag(2, area.x + 50.0F, area.y + 50.0F, area.x + 130.0F, area.y + 90.0F);
  EXPECT_LT(distance(state_.camera.eye, expected.eye), 1e-4);
  EXPECT_LT(distance(state_.camera.target, expected.target), 1e-4);
  state_.camera = before;
  ImGui::GetIO().KeyShift = true;
  drag(0, area.x + 50.0F, area.y + 50.0F, area.x + 130.0F, area.y + 90.0F);
  ImGui::GetIO().KeyShift = false;
  EXPECT_LT(distance(state_.camera.eye, expected.eye), 1e-4);
  EXPECT_TRUE(asked<PickPixel>().empty());
}

TEST_F(Navigation, WheelZoomsAtTheCursorAndCountsAsMovingForAWhile) {
  const MappedWidget area = picture();
  const scene::Camera before = state_.camera;
  move(area.x + area.width * 0.25F, area.y + area.height * 0.75F);
  ImGui::GetIO().MouseWheel = 2.0F;
  frame();
  const ImVec2 at = ImGui::GetIO().MousePos;
  const scene::Camera expected = scene::zoom_at(
      before, std::pow(0.88, 2.0), double(at.x - area.x) / double(area.width),
      double(at.y - area.y) / double(area.height), double(area.width) / double(area.height));
  EXPECT_LT(distance(state_.camera.eye, expected.eye), 1e-5);
  EXPECT_TRUE(state_.camera_moving);
  frames(5);
  EXPECT_TRUE(state_.camera_moving) << "0.1 s later";
  frames(15);
  EXPECT_FALSE(state_.camera_moving) << "0.3 s later";
}

TEST_F(Navigation, RightDragLooksAroundAndKeysFlyWhileItHolds) {
  const MappedWidget area = picture();
  const scene::Camera before = state_.camera;
  const float x = area.x + 100.0F;
  const float y = area.y + 100.0F;
  ImGui::GetIO().KeysDown['W'] = true;
  move(x, y);
  EXPECT_EQ(state_.camera, before) << "no key flies without the button";
  press(1);
  frame();
  EXPECT_LT(distance(state_.camera.eye, {0.0F, 0.0F, 0.0F}), 25.0) << "W goes forward";
  EXPECT_TRUE(state_.camera_moving);
  ImGui::GetIO().KeysDown['W'] = false;
  const scene::Camera flown = state_.camera;
  move(x + 30.0F, y);
  EXPECT_EQ(state_.camera, scene::look(flown, -30.0 * std::numbers::pi / double(area.height), 0.0,
                                       scene::Axis::y));
  press(1, false);
  EXPECT_TRUE(asked<PickPixel>().empty());
}

TEST_F(Navigation, ShiftFliesFasterAndTheWheelSetsTheSpeed) {
  const MappedWidget area = picture();
  const auto flown = [&](bool shift, float wheel) {
    state_.camera = scene::Camera{};
    state_.inspect.navigation.speed = 1.0F;
    move(area.x + 100.0F, area.y + 100.0F);
    press(1);
    ImGui::GetIO().MouseWheel = wheel;
    frame();
    ImGui::GetIO().KeyShift = shift;
    ImGui::GetIO().KeysDown['D'] = true;
    frame();
    ImGui::GetIO().KeyShift = false;
    ImGui::GetIO().KeysDown['D'] = false;
    press(1, false);
    return double(state_.camera.eye.x);
  };
  const double usual = flown(false, 0.0F);
  EXPECT_GT(usual, 0.0);
  EXPECT_NEAR(flown(true, 0.0F) / usual, 4.0, 1e-3);
  EXPECT_NEAR(flown(false, 2.0F) / usual, 1.25 * 1.25, 1e-3);
}

TEST_F(Navigation, BothPanesMoveTheSameCamera) {
  draw_ = [this] {
    draw_pane(0, {0.0F, 0.0F, 500.0F, 500.0F}, view_, state_, commands_);
    draw_pane(1, {500.0F, 0.0F, 500.0F, 500.0F}, view_, state_, commands_);
  };
  frames(2);
  const scene::Camera before = state_.camera;
  drag(0, 200.0F, 300.0F, 240.0F, 300.0F);
  const scene::Camera left = state_.camera;
  EXPECT_NE(left, before);
  state_.camera = before;
  drag(0, 700.0F, 300.0F, 740.0F, 300.0F);
  EXPECT_EQ(state_.camera, left);
}

/// Where a point lies in the picture of a camera, in half heights from its middle.
std::pair<double, double> seen_at(const scene::Camera& camera, const glm::vec3& point) {
  const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
  const glm::vec3 up = glm::cross(right, forward);
  const glm::vec3 to = point - camera.eye;
  const double depth = double(glm::dot(to, forward));
  EXPECT_GT(depth, 0.0);
  const double half = std::tan(double(camera.vertical_fov_degrees) * std::numbers::pi / 360.0);
  return {double(glm::dot(to, right)) / depth / half, double(glm::dot(to, up)) / depth / half};
}

TEST_F(Navigation, TheFreeViewShowsTheWholeFromTheSideAndAbove) {
  draw_ = [this] { draw_structure_view(kPane, view_, state_, commands_); };
  frames(2);
  EXPECT_FALSE(state_.free_camera) << "it is not known yet what there is to see";
  EXPECT_NE(shown("structure_view.reason"), "not there");
  auto info = std::make_shared<scene::SceneInfo>();
  info->bounds = {{-30.0F, 2.0F, -8.0F}, {-6.0F, 9.0F, 30.0F}};
  view_.scene.info = info;
  frames(2);
  ASSERT_TRUE(state_.free_camera);
  const scene::Camera first = *state_.free_camera;
  const UiState::Area area = state_.picture_areas[kPaneCount];
  const double aspect = double(area.width) / double(area.height);
  for (int corner = 0; corner < 8; ++corner) {
    const auto& box = info->bounds;
    const glm::vec3 point{(corner & 1) != 0 ? box.max.x : box.min.x,
                          (corner & 2) != 0 ? box.max.y : box.min.y,
                          (corner & 4) != 0 ? box.max.z : box.min.z};
    const auto [x, y] = seen_at(first, point);
    EXPECT_LT(std::abs(x), aspect) << "corner " << corner;
    EXPECT_LT(std::abs(y), 1.0) << "corner " << corner;
  }
  // The panes' camera looks along -z: turned by 35 degrees and raised by 20.
  const glm::vec3 from = glm::normalize(first.eye - first.target);
  EXPECT_NEAR(std::asin(double(from.y)) * 180.0 / std::numbers::pi, 20.0, 0.1);
  EXPECT_NEAR(std::abs(std::atan2(double(from.x), double(from.z))) * 180.0 / std::numbers::pi, 35.0,
              0.1);
  // Moved away, and back by the button.
  state_.free_camera = scene::dolly(first, 7.0);
  frames(2);
  EXPECT_NE(*state_.free_camera, first);
  click("structure_view.reset");
  frames(2);
  EXPECT_EQ(*state_.free_camera, first);
}

TEST_F(Navigation, TheFreeViewHasACameraOfItsOwn) {
  fill_picture(view_.structure_view);
  const Built built(accel::StructureKind::bvh_median);
  built.fill(view_.panes[0]);
  draw_ = [this] { draw_structure_view(kPane, view_, state_, commands_); };
  EXPECT_FALSE(state_.free_camera);
  frames(2);
  ASSERT_TRUE(state_.free_camera);
  const scene::Camera placed = *state_.free_camera;
  EXPECT_GT(state_.picture_areas[kPaneCount].width, 0);
  const scene::Camera before = state_.camera;
  const MappedWidget area = find("structure_view.picture").value_or(MappedWidget{});
  drag(0, area.x + 50.0F, area.y + 50.0F, area.x + 90.0F, area.y + 50.0F);
  EXPECT_NE(*state_.free_camera, placed);
  EXPECT_EQ(state_.camera, before);
  click(area.x + area.width * 0.5F + 1.0F, area.y + area.height * 0.25F + 1.0F);
  const auto picked = asked<PickNode>();
  ASSERT_EQ(picked.size(), 1U);
  EXPECT_EQ(picked[0].x, 160);
  EXPECT_EQ(picked[0].y, 60);
}

}  // namespace
}  // namespace encore::ui::test
