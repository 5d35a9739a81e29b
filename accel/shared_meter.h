#pragma once

#include "accel/build_watch.h"

#include <atomic>
#include <cstdint>
#include <thread>

namespace encore::accel {

/// A BuildMeter for work that several threads share, from what is done now to `until`: the building
/// thread reports what all have done, the others only look whether they are to end. To be made by
/// the building thread.
class SharedMeter {
 public:
  /// `work`: in any unit, the whole of it.
  SharedMeter(BuildMeter& meter, double until, double work)
      : meter_(meter), from_(meter.done()), until_(until), work_(work) {}

  /// So much more is done, by the calling thread. Throws BuildCancelled.
  void add(double work) {
    if (!meter_.watched()) return;
    const double sum = done_.fetch_add(work, std::memory_order_relaxed) + work;
    if (std::this_thread::get_id() == building_) {
      meter_.report(from_ + (until_ - from_) * sum / work_);
    } else if (meter_.cancel_asked()) {
      throw BuildCancelled();
    }
  }
  [[nodiscard]] const BuildMeter& meter() const { return meter_; }

 private:
  BuildMeter& meter_;
  const double from_;
  const double until_;
  const double work_;
  const std::thread::id building_ = std::this_thread::get_id();
  std::atomic<double> done_{0.0};
};

/// A meter of its own for a task that any thread may run: it ends where the build does.
class TaskMeter {
 public:
  explicit TaskMeter(const BuildMeter& build)
      : watch_{.cancel = build.cancel_flag()}, meter_(build.watched() ? &watch_ : nullptr) {}
  TaskMeter(const TaskMeter&) = delete;
  TaskMeter& operator=(const TaskMeter&) = delete;
  BuildMeter& meter() { return meter_; }

 private:
  BuildWatch watch_;
  BuildMeter meter_;
};

}  // namespace encore::accel
