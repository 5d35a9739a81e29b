#include "ui/panels/settings_column.h"
#include "ui/plot/value_text.h"
#include "ui/widgets.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace encore::ui {

namespace {

/// Scene seconds of a step by hand: a frame of a sequence, else a thirtieth.
double step_of(const SceneView& scene) {
  const auto frames = scene.info ? scene.info->animation.frames : 0;
  if (frames > 1) return scene.duration_s / static_cast<double>(frames);
  return 1.0 / 30.0;
}

/// Brings a time into the loop, or to its ends where it is not looped.
double within(double time, double duration, bool loop) {
  if (!loop) return std::clamp(time, 0.0, duration);
  const double rest = std::fmod(time, duration);
  return rest < 0.0 ? rest + duration : rest;
}

void draw_steps(const ColumnContext& context) {
  UiState& state = context.state;
  AnimationSettings& settings = state.settings.animation;
  const SceneView& scene = context.view.scene;
  if (text_button({"settings.animation.play", settings.playing ? "Pause" : "Play",
                   "Lets the animation go on, or stops it (Space)."})) {
    settings.playing = !settings.playing;
  }
  double step = 0.0;
  if (text_button_beside(
          {"settings.animation.back", "− frame", "One frame of the sequence back, or 1/30 s."})) {
    step = -step_of(scene);
  }
  if (text_button_beside(
          {"settings.animation.forward", "+ frame", "One frame of the sequence on, or 1/30 s."})) {
    step = step_of(scene);
  }
  if (step == 0.0) return;
  settings.playing = false;
  state.time_s = within(state.time_s + step, scene.duration_s, settings.loop);
}

}  // namespace

void draw_animation_section(const ColumnContext& context) {
  const SceneView& scene = context.view.scene;
  if (!scene.animated || !(scene.duration_s > 0.0)) return;
  if (!section("settings.animation", "Animation", "The scene's own time.")) return;
  AnimationSettings& settings = context.state.settings.animation;
  draw_steps(context);
  auto time = static_cast<float>(context.state.time_s);
  if (number_row(NumberRow<float>{.row = {"settings.animation.time", "Time",
                                          "Place in the loop, in scene seconds."},
                                  .high = static_cast<float>(scene.duration_s),
                                  .format = "%.2f s",
                                  .commit = Commit::at_once},
                 time)) {
    context.state.time_s = static_cast<double>(time);
  }
  number_row(NumberRow<float>{.row = {"settings.animation.speed", "Speed",
                                      "Scene seconds a second; 1: as the scene was made. Slower "
                                      "shows more of what happens, and costs as much a frame."},
                              .low = 0.05F,
                              .high = 10.0F,
                              .format = "%.2f ×",
                              .usual = 1.0F,
                              .logarithmic = true,
                              .commit = Commit::at_once},
             settings.speed);
  toggle_row({"settings.animation.loop", "Loop", "Begins again at the end instead of stopping."},
             settings.loop);
}

}  // namespace encore::ui
