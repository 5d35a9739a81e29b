#include "renderer/stage_clock.h"

#include <optional>

namespace encore::renderer {

void StageClock::begin(scene::RayKind kind) {
  if (bits_ == 0) return;
  if (used_ == kMostStretches) collect(read_);
  if (used_ == stretches_.size()) stretches_.emplace_back(bits_);
  stretches_[used_].kind = kind;
  stretches_[used_].timer.begin();
}

void StageClock::end() {
  if (bits_ > 0) stretches_[used_++].timer.end();
}

void StageClock::collect(RayFigures& figures) {
  const auto add = [&figures](scene::RayKind kind, double seconds) {
    std::optional<double>& sum = figures[kind].seconds;
    sum = sum.value_or(0.0) + seconds;
  };
  for (std::size_t i = 0; i < used_; ++i) {
    // A clock that ran backwards says nothing of this stretch.
    if (const auto seconds = stretches_[i].timer.seconds()) add(stretches_[i].kind, *seconds);
  }
  used_ = 0;
  if (&figures == &read_) return;
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    if (read_.kinds[i].seconds) add(static_cast<scene::RayKind>(i), *read_.kinds[i].seconds);
  }
  read_ = {};
}

}  // namespace encore::renderer
