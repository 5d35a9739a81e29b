#pragma once

#include "renderer/renderer.h"

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace encore::renderer {

/// Counts one worker's rays by kind, and shares its time out among the kinds: all that has passed
/// since the clock was last read goes to the kind that the work was for. One reading a change of
/// kind, so the kinds' seconds add up to all of the work.
class RayClock {
 public:
  void reset() { figures_ = {}; }
  /// Time before this belongs to nobody.
  void resume() { last_ = std::chrono::steady_clock::now(); }

  void count(scene::RayKind kind, std::size_t rays) { figures_[kind].rays += rays; }
  void charge(scene::RayKind kind) {
    const auto now = std::chrono::steady_clock::now();
    std::optional<double>& seconds = figures_[kind].seconds;
    seconds = seconds.value_or(0.0) + std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }
  [[nodiscard]] const RayFigures& figures() const { return figures_; }

 private:
  RayFigures figures_;
  std::chrono::steady_clock::time_point last_;
};

/// Adds the rays and seconds of one worker to those of others.
inline void add_figures(RayFigures& sum, const RayFigures& one) {
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    sum.kinds[i].rays += one.kinds[i].rays;
    if (one.kinds[i].seconds) {
      sum.kinds[i].seconds = sum.kinds[i].seconds.value_or(0.0) + *one.kinds[i].seconds;
    }
  }
}

}  // namespace encore::renderer
