#pragma once

#include "app/convergence_log.h"
#include "app/window/power_set.h"
#include "energy/convergence/convergence.h"
#include "energy/session.h"

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace encore::app {

/// A row as convergence sees it, and the slot that it was measured in.
struct SlotRow {
  std::uint64_t slot = 0;
  energy::Seconds slot_start;
  energy::Seconds end;
  double operations = 0.0;
  energy::Seconds per_operation;
  std::shared_ptr<const PowerSet> power;
};

/// How well the figures of one configuration are known, over slots that other configurations and
/// idle times lie between: of the energy only what flowed within its slots counts. Used by one
/// thread.
class SlotConvergence {
 public:
  /// Rows in the order of time. Energies wait until the sensors have got as far as the row.
  void add(SlotRow row);
  /// Takes in what the sensors have told meanwhile.
  void update();

  [[nodiscard]] std::vector<energy::ConvergenceRow> rows(
      const std::vector<energy::KeyValue>& configuration) const;

 private:
  void add_energy(const SlotRow& row);
  void begin_slot(const SlotRow& row);

  std::optional<energy::ConvergenceTracker> time_;
  std::deque<SlotRow> waiting_;
  std::shared_ptr<const PowerSet> power_;  ///< of the slot that is followed
  std::optional<std::uint64_t> slot_;
  std::optional<TotalEnergy> sum_;
  std::deque<energy::TracePoint> points_;  ///< of the sum, not yet reached by rows
  std::optional<energy::ConvergenceTracker> energy_;
};

}  // namespace encore::app
