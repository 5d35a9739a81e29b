#pragma once

#include "app/window/power_monitor.h"
#include "app/window/slot_book.h"
#include "app/window/slots.h"

#include <memory>
#include <span>

namespace encore::app {

/// Measures in the window: is told of slots and operations by the threads that trace, makes rows of
/// them as the command line does, and keeps figures of each configuration up to date on a thread of
/// its own. Thread-safe.
///
///   attribution.slot_began({.idle = true}); sleep ...; attribution.slot_ended();
///   attribution.slot_began({.idle = false, .configuration = configuration_of(...), ...});
///   for each frame:
///     log.clear(); const Seconds began = attribution.begin_operation();
///     { auto mark = log.mark(Phase::render); ... }
///     attribution.operation(log.spans(), began, clock.now());
///   attribution.slot_ended();
class LiveAttribution {
 public:
  struct Setup {
    energy::Seconds row{0.010};  ///< as Plan::row
    energy::Seconds every{1.0};  ///< least time between two computations
    bool threaded = true;        ///< false: compute() is called by hand
  };
  /// The monitor must outlive it.
  explicit LiveAttribution(PowerMonitor& monitor);
  LiveAttribution(PowerMonitor& monitor, Setup setup);
  ~LiveAttribution();
  LiveAttribution(const LiveAttribution&) = delete;
  LiveAttribution& operator=(const LiveAttribution&) = delete;

  /// Begins a slot now; one that is under way ends. Reads the power sources (on this thread, which
  /// is one that measures).
  void slot_began(const Slot& slot);
  /// Said right before each operation: begins a row if there is none. Returns the operation's
  /// beginning.
  energy::Seconds begin_operation();
  /// Tells an operation of the slot under way; without one it is passed over.
  void operation(std::span<const energy::PhaseSpan> spans, energy::Seconds began,
                 energy::Seconds ended);
  /// Ends the slot under way, if there is one, and asks for figures.
  void slot_ended();

  /// Also tells `listener` (a recorder) from now on, null: nobody. A slot under way begins for it
  /// now, and ends for the one before. It must outlive its being told.
  void tell(SlotListener* listener);

  /// Asks for figures; they come within the time of a computation, at most once in Setup::every.
  void request();
  /// The figures computed last; never null.
  [[nodiscard]] std::shared_ptr<const Figures> latest() const;
  /// Forgets everything measured so far (another scene). A slot under way ends, and what of it is
  /// in no row yet is lost.
  void clear();
  /// Computes right here; for tests and for the end of a run.
  std::shared_ptr<const Figures> compute();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace encore::app
