#pragma once

#include "energy/sampling/trace.h"
#include "energy/units.h"

#include <deque>
#include <functional>
#include <optional>

namespace encore::energy {

/// What a source counted between two of its updates, and what was done meanwhile.
struct EnergyStep {
  Seconds start;
  Seconds end;
  Joules energy;
  double operations = 0.0;
};

/// Brings a source's updates together with rows of operations that arrive on their own schedule:
/// an update waits until the rows reach it. Operations count linearly within their row. Steps begin
/// at the first update after the start and end at updates, never inside, so that the sensor's
/// period does not cut them; none crosses a gap.
class PairedEnergy {
 public:
  PairedEnergy(Seconds start, std::function<void(const EnergyStep&)> on_step);

  /// Operations that took [start, end]; rows come in the order of time.
  void add_row(Seconds start, Seconds end, double operations);
  /// Points come in the order of time. Those that only repeat the sensor's value are passed over.
  void add_energy(const TracePoint& point);

  /// Points that wait for rows; bounded.
  [[nodiscard]] std::size_t waiting() const { return waiting_.size(); }

 private:
  struct Update {
    Seconds time;
    Joules energy;
    bool starts_stretch = false;
    double operations = 0.0;
  };
  void settle(Update update);

  Seconds start_;
  std::function<void(const EnergyStep&)> on_step_;
  std::deque<Update> waiting_;
  std::optional<Update> last_;
  double operations_ = 0.0;
};

}  // namespace encore::energy
