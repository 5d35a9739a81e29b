#pragma once

#include "energy/phase_probe.h"
#include "energy/runner.h"

#include <optional>
#include <span>

namespace encore::energy {

/// Gathers operations until they fill a row of frames.csv, with their energy where the sources of
/// the total update often enough to resolve it.
class RowBuilder {
 public:
  explicit RowBuilder(const RunContext& context) : context_(context) {}

  [[nodiscard]] bool empty() const { return operations_ == 0; }
  [[nodiscard]] Seconds started() const { return start_; }

  /// Begins a row; `expected`: how long it will be at least.
  void start(Seconds expected);
  /// Adds one operation. `edges`: whose phases were read at their edges.
  void add(std::span<const PhaseSpan> spans, const PhaseProbe& edges,
           PerPhase<std::uint64_t>& counts);
  /// The row of everything since start(); ends it.
  FrameRow take(const Workload& workload);

 private:
  void add_energy(FrameRow& row) const;
  [[nodiscard]] std::optional<Joules> total_energy(Seconds from, Seconds to) const;

  const RunContext& context_;
  Seconds start_;
  Seconds end_;
  std::uint64_t operations_ = 0;
  PerPhase<std::optional<Seconds>> seconds_;
  /// Of the phases that were read at their edges; unknown once one reading is missing.
  PerPhase<std::optional<Joules>> joules_;
  PerPhase<bool> unknown_{};
};

}  // namespace encore::energy
