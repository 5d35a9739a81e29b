#pragma once

#include "app/window/slots.h"
#include "energy/session.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// The figures of one configuration so far.
struct LiveFigures {
  std::vector<energy::KeyValue> configuration;
  std::string name;  ///< for people
  std::size_t slots = 0;
  /// As summary.csv has it: time an operation, its interval and median, joules gross and net with
  /// their intervals, idle watts, counters (mrays_per_s among them).
  energy::SummaryRow summary;
  std::vector<energy::PhaseRow> phases;         ///< as phases.csv: of the total
  std::vector<energy::PhaseRow> source_phases;  ///< as phases.csv: of each source by itself
  std::vector<energy::ConvergenceRow> convergence;
  std::optional<double> mrays_per_s;
  /// Of the joules; unavailable with the reason in `detail`.
  energy::Provenance energy;
  std::vector<std::string> notes;  ///< sentences about how far to trust it
};

/// What all slots say, one configuration each.
struct Figures {
  std::vector<LiveFigures> configurations;  ///< in the order they were first measured
  std::optional<energy::Watts> idle_watts;  ///< of the last configuration that knows it
  std::uint64_t version = 0;                ///< rises with every computation
  energy::Seconds computed_at;              ///< the clock's time
};

/// Keeps what slots told, in bounded memory, and computes figures of it. Being told is cheap and
/// thread-safe; compute() takes long and is called by one thread at a time.
///
/// Energies rest on the slots measured with the power sources in use now: figures of two sensors do
/// not mix. Times rest on all slots. Of each configuration the last 4096 slots count for energy.
class SlotBook final : public SlotListener {
 public:
  SlotBook();
  ~SlotBook() override;

  void slot_began(const Slot& slot, const std::shared_ptr<const PowerSet>& power,
                  energy::Seconds now) override;
  void operation(const Operation& operation) override;
  void row(const energy::FrameRow& row) override;
  void slot_ended(energy::Seconds now) override;

  /// The figures up to `now`; a slot under way counts up to its last operation.
  Figures compute(energy::Seconds now);
  void clear();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace encore::app
