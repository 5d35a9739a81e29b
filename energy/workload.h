#pragma once

#include "energy/phase_log.h"

#include <optional>
#include <string>
#include <vector>

namespace encore::energy {

/// A named text: one part of what identifies a configuration.
struct KeyValue {
  std::string key;
  std::string value;

  friend bool operator==(const KeyValue&, const KeyValue&) = default;
};

/// A named figure; without a value if it does not apply.
struct Counter {
  std::string name;
  std::optional<double> value;
  /// Without a value: whether it applies but could not be measured.
  bool unavailable = false;

  friend bool operator==(const Counter&, const Counter&) = default;
};

/// Something to measure: one configuration whose operation is repeated. The runner drives it
/// without knowing what it does.
class Workload {
 public:
  virtual ~Workload() = default;

  /// For people: "toys, bvh-sah, build".
  [[nodiscard]] virtual std::string name() const = 0;

  /// What identifies this configuration, always with the same keys in the same order. Asked
  /// between operations only; values may change from operation to operation.
  [[nodiscard]] virtual std::vector<KeyValue> configuration() const = 0;

  /// Everything that must be there before the first operation. Not measured.
  virtual void prepare() = 0;

  /// One build or one frame. All work that counts happens inside marks of `log`, at most one mark
  /// of each phase; the operation's time is the sum of its phases.
  virtual void operation(PhaseLog& log) = 0;

  /// Said once, after the warm-up and before the first operation that is measured.
  virtual void begin_measuring() {}

  /// The phases that can be run alone between operations, any number of times and in any order:
  /// what attribution by regression varies. Empty if there are none.
  [[nodiscard]] virtual std::vector<Phase> separable() const { return {}; }
  /// Runs one of them, inside one mark of `log`.
  virtual void run_alone(Phase phase, PhaseLog& log) {
    (void)phase;
    (void)log;
  }

  /// Figures of the state after the last operation, always with the same names in the same order.
  /// `mean` is the mean time of each phase an operation; 0 where it did not happen.
  [[nodiscard]] virtual std::vector<Counter> counters(const PerPhase<Seconds>& mean) const = 0;
};

}  // namespace encore::energy
