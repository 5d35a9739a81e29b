#pragma once

#include "app/window/live_attribution.h"
#include "app/window/pane_worker.h"
#include "energy/clock.h"
#include "ui/settings.h"
#include "ui/view.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace encore::app {

/// Measure mode: idle, the first pane alone, idle, the second pane alone, and again, on a thread of
/// its own. Sensors that see the whole machine could not tell two panes apart that run at once.
class MeasureScheduler {
 public:
  struct Setup {
    std::vector<PaneWorker*> panes;
    LiveAttribution* attribution = nullptr;
    const energy::Clock* clock = nullptr;
    energy::Seconds start;            ///< the clock's time that slots are told from
    std::function<void()> on_change;  ///< called on the scheduler's thread
  };
  explicit MeasureScheduler(Setup setup);
  ~MeasureScheduler();
  MeasureScheduler(const MeasureScheduler&) = delete;
  MeasureScheduler& operator=(const MeasureScheduler&) = delete;

  /// Takes effect with the next slot.
  void set(const ui::MeasureSettings& settings);
  void start();
  /// The slot under way ends after its operation; the panes explore again. Does not wait.
  void stop();
  [[nodiscard]] bool running() const { return running_.load(std::memory_order_relaxed); }

  /// What goes on now, and how far the slot is.
  [[nodiscard]] ui::MeasureView view() const;
  /// The slots so far, the oldest first; bounded.
  [[nodiscard]] std::vector<ui::SlotView> slots() const;
  /// Labels of the panes' slots: kind and text.
  void label(std::size_t pane, ui::SlotView::Kind kind, std::string text);

 private:
  void run();
  void idle_slot(energy::Seconds length);
  void pane_slot(std::size_t pane, energy::Seconds length, bool forced);
  void open_slot(ui::SlotView::Kind kind, std::string label, energy::Seconds length);
  void close_slot();
  [[nodiscard]] double now_s() const;

  Setup setup_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  ui::MeasureSettings settings_;
  bool wanted_ = false;
  bool quit_ = false;
  std::atomic<bool> stop_slot_{false};
  std::atomic<bool> running_{false};
  std::deque<ui::SlotView> slots_;
  std::optional<ui::SlotView> open_;
  double open_length_s_ = 0.0;
  struct Label {
    ui::SlotView::Kind kind = ui::SlotView::Kind::cpu;
    std::string text;
  };
  std::vector<Label> labels_;
  std::thread thread_;
};

}  // namespace encore::app
