#pragma once

#include <chrono>

namespace encore::app {

/// Seconds of the steady clock, for how long things take on the screen; what is measured has the
/// power monitor's clock.
inline double steady_now() {
  const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(since_start).count();
}

}  // namespace encore::app
