#pragma once

#include "renderer/gl/fence.h"
#include "renderer/renderer.h"

#include <cstddef>
#include <deque>

namespace encore::renderer {

/// Shares the device's time out among kinds of rays by its own clock, without waiting for it more
/// than now and then. Where the device has no clock, kinds have no seconds.
class StageClock {
 public:
  explicit StageClock(int timestamp_bits) : bits_(timestamp_bits) {}

  /// What is given to the device between the two is for rays of that kind.
  void begin(scene::RayKind kind);
  void end();
  /// Adds what was measured since the last time to `figures`, and returns when the device has come
  /// that far.
  void collect(RayFigures& figures);

 private:
  struct Stretch {
    explicit Stretch(int timestamp_bits) : timer(timestamp_bits) {}
    gl::Timer timer;
    scene::RayKind kind = scene::RayKind::camera;
  };
  /// So many stretches may be waiting to be read.
  static constexpr std::size_t kMostStretches = 256;

  int bits_;
  std::deque<Stretch> stretches_;  ///< kept from picture to picture
  std::size_t used_ = 0;
  RayFigures read_;  ///< seconds of stretches whose timers are in use again
};

}  // namespace encore::renderer
