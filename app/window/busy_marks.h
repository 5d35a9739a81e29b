#pragma once

#include "app/device.h"
#include "energy/attribution/busy_timeline.h"
#include "energy/phase_log.h"

#include <array>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>

namespace encore::app {

/// Which phase of which device runs right now: what modelled and simulated power sources look at.
/// The threads that trace tell it; thread-safe.
///
/// A power model has one power a phase, not one for two devices at work together. So only one
/// device at a time is passed on: the one that began first. While a second one is busy beside it
/// the machine counts as overlapped; sources that follow the marks give no value then (a gap, never
/// a wrong number), and no energy is attributed to slots that an overlap touches.
class BusyMarks {
 public:
  /// `history`: as for LiveBusyTime; a simulated sensor looks back.
  explicit BusyMarks(std::size_t history = 1U << 18U) : live_(history) {}

  void begin(Device device, energy::Phase phase, energy::Seconds now);
  void end(Device device, energy::Seconds now);

  [[nodiscard]] const energy::LiveBusyTime& live() const { return live_; }
  /// Whether both were busy at some moment of [from, to]. Of the far past it remembers the last
  /// 4096 overlaps.
  [[nodiscard]] bool overlapped(energy::Seconds from, energy::Seconds to) const;
  /// What is running now.
  [[nodiscard]] std::optional<energy::Phase> running(Device device) const;

 private:
  struct Open {
    energy::Phase phase = energy::Phase::render;
    energy::Seconds since;
  };
  struct Overlap {
    energy::Seconds from;
    std::optional<energy::Seconds> to;  ///< nothing: goes on
  };
  [[nodiscard]] energy::Seconds in_order(energy::Seconds now);
  void finish(Device device, energy::Seconds now);

  mutable std::mutex mutex_;
  energy::LiveBusyTime live_;
  std::array<std::optional<Open>, 3> open_;  ///< a device each
  std::optional<Device> told_;               ///< whose phase `live_` was told of
  std::deque<Overlap> overlaps_;
  energy::Seconds last_;
};

}  // namespace encore::app
