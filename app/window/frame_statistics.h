#pragma once

#include "ui/view.h"

#include <cstddef>
#include <deque>
#include <ostream>
#include <string>
#include <vector>

namespace encore::app {

/// What the window costs: how long its frames take, and how much of a core its thread uses.
class FrameStatistics {
 public:
  FrameStatistics();
  /// A frame took so long, from the end of waiting to the end of drawing.
  void add(double frame_s, double now_s);
  void fill(ui::WindowView& view) const;
  /// When each frame ended, in seconds since the program was started, and its time in milliseconds;
  /// of the last hundred thousand frames, a line each.
  void write(std::ostream& out) const;

 private:
  struct Mark {
    double time_s = 0.0;
    double processor_s = 0.0;
  };
  std::deque<double> times_ms_;
  std::deque<double> ends_s_;  ///< as now_s was given
  std::deque<Mark> marks_;     ///< of the last seconds
  double memory_at_s_ = -1.0;
  std::uint64_t memory_bytes_ = 0;
};

/// How long this program has been running, to a hundredth of a second.
double seconds_since_start();

}  // namespace encore::app
