#pragma once

#include "energy/sources/power_source.h"

#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// One reading of one source, for a plot or a table.
struct PowerPoint {
  double time_s = 0.0;  ///< since the monitor's start (of a session: since its start)
  /// A gauge's own; a counter's mean since its last change, once that is two update periods ago.
  std::optional<double> watts;
  std::optional<double> joules;  ///< since the source was opened
  bool changed = true;           ///< the sensor's value differs from the reading before
  bool gap = false;              ///< what lies between the point before and this one is unknown
};

/// Readings of several sources as points. A counter tells joules: its watts are made here.
class PowerPoints {
 public:
  /// The point of a reading that is ok or restarted; its time is the clock's.
  PowerPoint make(const energy::SourceInfo& info, const energy::ReadResult& result);

 private:
  struct Anchor {
    std::string source;
    energy::Seconds time;
    energy::Joules energy;
  };
  std::vector<Anchor> anchors_;  ///< where the mean power of each counter begins
};

}  // namespace encore::app
