#include "ui/panels/camera_navigation.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace encore::ui {

namespace {

using Drag = NavigationState::Drag;

/// What a hand may shake in a click, in pixels.
constexpr float kClickPixels = 4.0F;
/// After the wheel's last turn the camera counts as moving for so long.
constexpr double kWheel_s = 0.2;
constexpr double kZoomStep = 0.88;
constexpr float kSpeedStep = 1.25F;
/// Share of the scene's diagonal that is flown in a second.
constexpr double kFlySpeed = 0.25;

double aspect_of(const Rect& picture) {
  return picture.height > 0.0F ? double(picture.width) / double(picture.height) : 1.0;
}

void take_hold(NavigationState& state) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    state.drag = io.KeyShift ? Drag::pan : Drag::orbit;
  } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) {
    state.drag = Drag::pan;
  } else {
    state.drag = Drag::look;
  }
  state.moved = false;
  state.pressed_x = state.last_x = io.MousePos.x;
  state.pressed_y = state.last_y = io.MousePos.y;
}

void follow_mouse(const NavigationInput& input, scene::Axis up, NavigationState& state,
                  scene::Camera& camera) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (!ImGui::IsMousePosValid(&mouse)) return;
  const float away = std::hypot(mouse.x - state.pressed_x, mouse.y - state.pressed_y);
  state.moved = state.moved || away > kClickPixels;
  if (!state.moved) return;
  const double dx = double(mouse.x) - double(state.last_x);
  const double dy = double(mouse.y) - double(state.last_y);
  state.last_x = mouse.x;
  state.last_y = mouse.y;
  if (dx == 0.0 && dy == 0.0) return;
  const double height = std::max(1.0, double(input.picture.height));
  const double width = std::max(1.0, double(input.picture.width));
  const double turn = std::numbers::pi / height;
  if (state.drag == Drag::orbit) camera = scene::orbit(camera, -dx * turn, dy * turn, up);
  if (state.drag == Drag::look) camera = scene::look(camera, -dx * turn, -dy * turn, up);
  if (state.drag == Drag::pan) {
    camera = scene::pan(camera, dx / width, dy / height, aspect_of(input.picture));
  }
}

/// Keys mean letters, by which both GLFW and Dear ImGui's key state are numbered here.
double held(char key) {
  return ImGui::IsKeyDown(key) ? 1.0 : 0.0;
}

void fly(const NavigationInput& input, NavigationState& state, scene::Camera& camera) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.MouseWheel != 0.0F) {
    state.speed =
        std::clamp(state.speed * std::pow(kSpeedStep, io.MouseWheel), 1.0F / 64.0F, 64.0F);
  }
  if (io.WantTextInput || io.KeyCtrl) return;
  const double forward = held('W') - held('S');
  const double right = held('D') - held('A');
  const double rise = held('E') - held('Q');
  if (forward == 0.0 && right == 0.0 && rise == 0.0) return;
  const glm::dvec3 view = glm::dvec3(camera.target) - glm::dvec3(camera.eye);
  const double size = input.scene_size > 0.0
                          ? input.scene_size
                          : std::sqrt(view.x * view.x + view.y * view.y + view.z * view.z);
  // Frames that took long must not leap.
  const double seconds = std::clamp(double(io.DeltaTime), 0.0, 0.1);
  const double way = size * kFlySpeed * double(state.speed) * (io.KeyShift ? 4.0 : 1.0) * seconds;
  camera = scene::fly(camera, forward * way, right * way, rise * way);
  state.moved = true;
}

void zoom(const NavigationInput& input, NavigationState& state, scene::Camera& camera) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.MouseWheel == 0.0F || input.picture.empty()) return;
  const double x = double(io.MousePos.x - input.picture.x) / double(input.picture.width);
  const double y = double(io.MousePos.y - input.picture.y) / double(input.picture.height);
  camera = scene::zoom_at(camera, std::pow(kZoomStep, double(io.MouseWheel)), x, y,
                          aspect_of(input.picture));
  state.wheel_until.at(input.place) = ImGui::GetTime() + kWheel_s;
}

}  // namespace

scene::Axis up_axis_of(const Preferences& preferences) {
  constexpr std::array kAxes{scene::Axis::x, scene::Axis::y, scene::Axis::z};
  return kAxes.at(static_cast<std::size_t>(std::clamp(preferences.up_axis, 0, 2)));
}

NavigationOutput navigate(const NavigationInput& input, const Preferences& preferences,
                          NavigationState& state, scene::Camera& camera) {
  NavigationOutput output;
  if (input.room.width < 1.0F || input.room.height < 1.0F) return output;
  ImGui::SetCursorScreenPos({input.room.x, input.room.y});
  ImGui::InvisibleButton("picture", {input.room.width, input.room.height},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  const bool hovered = ImGui::IsItemHovered();
  if (ImGui::IsItemActivated()) take_hold(state);
  bool dragging = false;
  if (ImGui::IsItemActive()) {
    follow_mouse(input, up_axis_of(preferences), state, camera);
    if (state.drag == Drag::look) fly(input, state, camera);
    dragging = state.moved;
  } else if (ImGui::IsItemDeactivated()) {
    if (state.drag == Drag::orbit && !state.moved) {
      output.clicked = {state.pressed_x, state.pressed_y};
    }
    state.drag = Drag::none;
  } else if (hovered) {
    zoom(input, state, camera);
  }
  output.hovered = hovered && !dragging;
  output.moving = dragging || ImGui::GetTime() < state.wheel_until.at(input.place);
  if (output.moving) state.moved_in_frame.at(input.place) = ImGui::GetFrameCount();
  return output;
}

std::optional<std::pair<int, int>> pixel_at(const Rect& picture, int width, int height, float x,
                                            float y) {
  if (picture.empty() || width <= 0 || height <= 0) return std::nullopt;
  const double across = (double(x) - double(picture.x)) / double(picture.width);
  const double down = (double(y) - double(picture.y)) / double(picture.height);
  if (!(across >= 0.0 && across < 1.0 && down >= 0.0 && down < 1.0)) return std::nullopt;
  return std::pair{std::min(static_cast<int>(across * width), width - 1),
                   std::min(static_cast<int>(down * height), height - 1)};
}

}  // namespace encore::ui
