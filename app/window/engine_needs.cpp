#include "app/window/engine.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

namespace encore::app {

namespace {

/// Pictures of the size that most panes have; larger ones are drawn smaller anyway.
constexpr ImageSize kSize{512, 512};

}  // namespace

bool Engine::LeftOutCost::is_of(const scene::Scene* other, const scene::RaySettings& others) const {
  return scene.get() == other && rays == others;
}

void Engine::measure_left_out(const ui::UiState& state) {
  if (!scene_ || needs_task_.running() || accuracy_->running()) return;
  LeftOutCost what{scene_, state.settings.rays, {}};
  needs_task_.start([this, what = std::move(what)](TaskControl& control) mutable {
    // What panes draw meanwhile would be measured as well.
    struct Rest {
      Engine& engine;
      const std::atomic<bool>& stop;
      Rest(Engine& one, const std::atomic<bool>& end) : engine(one), stop(end) {
        engine.hold_panes(true, stop);
      }
      ~Rest() { engine.hold_panes(false, stop); }
    };
    const Rest rest(*this, control.stop);
    what.cost =
        measure_needs_cost({what.scene.get(), what.rays, kSize, setup_.threads}, control.stop);
    if (setup_.wake) setup_.wake();
    return std::move(what);
  });
}

void Engine::take_left_out() {
  if (auto result = needs_task_.take()) {
    needs_problem_ = std::move(result->error);
    if (result->value && result->value->cost) left_out_cost_ = std::move(*result->value);
  }
}

void Engine::fill_left_out(ui::SceneView& view, const ui::UiState& state) const {
  view.left_out_times.clear();
  view.left_out_measured.clear();
  view.measuring_left_out = needs_task_.running();
  view.left_out_problem = needs_problem_;
  const LeftOutCost& known = left_out_cost_;
  if (!known.cost || !known.is_of(scene_.get(), state.settings.rays)) return;
  for (const FeatureCost& one : known.cost->features) {
    view.left_out_times.push_back(
        {one.feature, one.ms, one.low_ms, one.high_ms, one.below_noise(), one.same_picture});
  }
  view.left_out_measured = fmt::format(
      "On the CPU over bvh-median at {} × {}, where a frame takes {:.3g} ms: the median difference "
      "of {} rounds and its 96 % interval.",
      known.cost->size.width, known.cost->size.height, known.cost->frame_ms, kCostRounds);
}

}  // namespace encore::app
