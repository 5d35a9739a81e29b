#pragma once

#include "accel/build_watch.h"
#include "app/window/live_attribution.h"
#include "app/window/pane_output.h"
#include "app/window/pane_request.h"
#include "app/window/pane_tracer.h"
#include "app/window/power_monitor.h"

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace encore::app {

/// A pane's thread. It works towards the latest request: what it has already stays, what is under
/// way for an older one is given up as soon as that helps. The window never waits for it.
///
/// In measure mode it is held: requests are only looked at when a slot of its own begins.
class PaneWorker {
 public:
  struct Setup {
    std::optional<int> gl_device;
    PowerMonitor* monitor = nullptr;         ///< is told of phases
    LiveAttribution* attribution = nullptr;  ///< is told of operations in slots
    std::function<void()> on_change;         ///< there is news; called on the worker's thread
    /// A frame of explore mode was drawn: its times, no energies. On the worker's thread.
    std::function<void(const energy::FrameRow&)> on_frame;
  };
  explicit PaneWorker(Setup setup);
  ~PaneWorker();
  PaneWorker(const PaneWorker&) = delete;
  PaneWorker& operator=(const PaneWorker&) = delete;

  /// What is wanted from now on. Cheap where nothing differs.
  void ask(PaneRequest request);
  /// The last output; null before the first. Never waits for work.
  [[nodiscard]] std::shared_ptr<const PaneOutput> output() const;
  [[nodiscard]] PaneStatus status() const;

  /// Explore mode's work stops after the step under way (true) or goes on (false).
  void hold(bool held);
  /// Whether it is held and does nothing.
  [[nodiscard]] bool at_rest() const;
  /// Runs operations of the latest request one after the other for so long, as one slot of measure
  /// mode; before that, whatever has to be there is made, unmeasured. Called by the scheduler's
  /// thread, which it blocks; returns early once `stop` is set. False if there is nothing to run.
  bool run_slot(energy::Seconds length, bool forced, const std::atomic<bool>& stop);
  /// What a slot of the latest request would measure; nothing where the pane is off or brute.
  [[nodiscard]] bool can_run() const;
  /// Whether a slot runs right now.
  [[nodiscard]] bool in_slot() const { return in_slot_.load(std::memory_order_relaxed); }

 private:
  struct SlotJob {
    energy::Seconds length;
    bool forced = false;
    const std::atomic<bool>* stop = nullptr;
    bool done = false;
    bool ran = false;
  };
  void run();
  void explore(const PaneRequest& request);
  void measure(const PaneRequest& request, SlotJob& job);
  void measure_operations(const PaneRequest& request, const SlotJob& job);
  bool trace(const PaneRequest& request);
  void set_status(ui::PaneState state, std::string doing = {}, std::string problem = {});
  void publish();
  bool draw_parts(const PaneRequest& request, const std::atomic<bool>* cancel);
  void take_frame(const PaneRequest& request);
  void tell_rays(const PaneRequest& request, Slot& slot);
  [[nodiscard]] bool superseded(const PaneRequest& request) const;
  /// Whether something else is to be looked at before the next part of a picture.
  [[nodiscard]] bool newer_wanted() const;

  Setup setup_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable slot_done_;
  std::optional<PaneRequest> wanted_;  ///< not looked at yet
  PaneRequest latest_;
  SlotJob* job_ = nullptr;
  bool held_ = false;
  bool busy_ = false;
  bool stop_ = false;
  PaneStatus status_;
  std::shared_ptr<const PaneOutput> output_;
  std::atomic<bool> cancel_trace_{false};
  std::atomic<bool> cancel_build_{false};
  std::atomic<bool> in_slot_{false};
  accel::BuildWatch watch_;
  // The thread's own:
  struct Work;
  std::unique_ptr<Work> work_;
  std::thread thread_;
};

}  // namespace encore::app
