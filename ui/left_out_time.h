#pragma once

#include <string>

namespace encore::ui {

/// How much longer a frame would take with something that it does without.
struct LeftOutTime {
  std::string feature;  ///< as in scene::LeftOut
  double ms = 0.0;
  double low_ms = 0.0;  ///< ends of an interval that holds the true value in 96 of 100 cases
  double high_ms = 0.0;
  bool below_noise = false;  ///< the interval holds 0
  bool same_picture = true;  ///< false: what another picture would cost
};

}  // namespace encore::ui
