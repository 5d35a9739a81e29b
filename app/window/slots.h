#pragma once

#include "energy/attribution/attribution.h"
#include "energy/phase_log.h"
#include "energy/session.h"
#include "energy/workload.h"
#include "scene/ray_settings.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace encore::app {

struct PowerSet;

/// A stretch of measure mode: nothing runs, or operations of one configuration follow each other.
struct Slot {
  bool idle = true;
  /// As configuration_of() gives it; empty for idle slots.
  std::vector<energy::KeyValue> configuration;
  /// Figures of the structure, by the names of counter_columns(); those not given stay empty.
  std::vector<energy::Counter> counters;
  std::optional<double> rays;  ///< of all kinds, an operation, for Mrays/s
  /// Of each kind: rays an operation, and their share of the render phase's time.
  struct Kind {
    std::optional<double> rays{};
    std::optional<double> share{};
  };
  std::array<Kind, scene::kRayKinds> kinds{};
};

/// One build or one frame that was done.
struct Operation {
  std::span<const energy::PhaseSpan> spans;  ///< in order, not overlapping
  energy::Seconds began;
  energy::Seconds ended;
};

/// Hears of slots. Calls come one at a time, on the threads that measure; times are the monitor's
/// clock's. An implementation must not block.
class SlotListener {
 public:
  virtual ~SlotListener() = default;
  /// `power`: what is read during it; null if nothing is.
  virtual void slot_began(const Slot& slot, const std::shared_ptr<const PowerSet>& power,
                          energy::Seconds now) = 0;
  virtual void operation(const Operation& operation) = 0;
  /// A row of frames.csv is full; its time is the clock's.
  virtual void row(const energy::FrameRow& row) = 0;
  virtual void slot_ended(energy::Seconds now) = 0;
};

}  // namespace encore::app
