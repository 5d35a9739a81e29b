#pragma once

#include "accel/settings.h"
#include "ui/layout.h"
#include "ui/plot/scatter_chart.h"
#include "ui/settings.h"

#include <set>

namespace encore::ui {

/// What the window of accuracy compares: every combination of these.
struct AccuracyChoice {
  std::set<PaneDevice> devices{PaneDevice::cpu};  ///< cpu and gpu
  std::set<accel::StructureKind> structures{accel::StructureKind::kd_sah,
                                            accel::StructureKind::bvh_median};
  std::set<accel::IntersectionMode> modes{accel::IntersectionMode::precise,
                                          accel::IntersectionMode::moller_trumbore,
                                          accel::IntersectionMode::watertight};
  std::set<int> samples{1, 4, 16};
  int side = 256;               ///< of the square picture, pixels
  int reference_samples = 256;  ///< of the reference picture

  [[nodiscard]] std::size_t configurations() const {
    return devices.size() * structures.size() * modes.size() * samples.size();
  }
};

/// What the window of accuracy keeps between frames.
struct AccuracyUiState {
  bool open = false;
  AccuracyChoice choice;
  bool by_joules = false;  ///< the scatter's cost, where joules are known
  ScatterState chart;
  Rect area;  ///< of the window, for pictures of it
};

}  // namespace encore::ui
