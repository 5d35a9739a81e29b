#include "app/window/measure_scheduler.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace encore::app {

namespace {

/// A day of the shortest slots.
constexpr std::size_t kMostSlots = 100'000;
/// Nothing to measure: look again so often.
constexpr energy::Seconds kNothingToDo(0.2);

}  // namespace

MeasureScheduler::MeasureScheduler(Setup setup)
    : setup_(std::move(setup)), labels_(setup_.panes.size()) {
  thread_ = std::thread([this] { run(); });
}

MeasureScheduler::~MeasureScheduler() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    wanted_ = false;
    stop_slot_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void MeasureScheduler::set(const ui::MeasureSettings& settings) {
  const std::lock_guard lock(mutex_);
  settings_ = settings;
}

void MeasureScheduler::start() {
  {
    const std::lock_guard lock(mutex_);
    if (wanted_) return;
    wanted_ = true;
    stop_slot_ = false;
  }
  wake_.notify_all();
}

void MeasureScheduler::stop() {
  const std::lock_guard lock(mutex_);
  wanted_ = false;
  stop_slot_ = true;
}

void MeasureScheduler::label(std::size_t pane, ui::SlotView::Kind kind, std::string text) {
  const std::lock_guard lock(mutex_);
  labels_.at(pane) = {kind, std::move(text)};
}

double MeasureScheduler::now_s() const {
  return (setup_.clock->now() - setup_.start).value;
}

ui::MeasureView MeasureScheduler::view() const {
  const std::lock_guard lock(mutex_);
  ui::MeasureView view;
  view.measuring = wanted_;
  if (!open_) return view;
  const double elapsed = now_s() - open_->from_s;
  view.progress = open_length_s_ > 0 ? std::clamp(elapsed / open_length_s_, 0.0, 1.0) : 0.0;
  view.doing = fmt::format("{}, {:.1f} of {:.1f} s", open_->label,
                           std::min(elapsed, open_length_s_), open_length_s_);
  return view;
}

std::vector<ui::SlotView> MeasureScheduler::slots() const {
  const std::lock_guard lock(mutex_);
  std::vector<ui::SlotView> slots(slots_.begin(), slots_.end());
  if (open_) {
    slots.push_back(*open_);
    slots.back().to_s = now_s();
  }
  return slots;
}

void MeasureScheduler::open_slot(ui::SlotView::Kind kind, std::string label,
                                 energy::Seconds length) {
  {
    const std::lock_guard lock(mutex_);
    const double now = now_s();
    open_ = ui::SlotView{now, now, kind, std::move(label)};
    open_length_s_ = length.value;
  }
  if (setup_.on_change) setup_.on_change();
}

void MeasureScheduler::close_slot() {
  const std::lock_guard lock(mutex_);
  if (!open_) return;
  open_->to_s = now_s();
  slots_.push_back(*open_);
  open_.reset();
  if (slots_.size() > kMostSlots) slots_.pop_front();
}

void MeasureScheduler::idle_slot(energy::Seconds length) {
  if (length.value <= 0.0) return;
  open_slot(ui::SlotView::Kind::idle, "idle", length);
  setup_.attribution->slot_began({.idle = true, .configuration = {}, .counters = {}, .rays = {}});
  setup_.clock->sleep_until(setup_.clock->now() + length, stop_slot_);
  setup_.attribution->slot_ended();
  close_slot();
}

void MeasureScheduler::pane_slot(std::size_t pane, energy::Seconds length, bool forced) {
  Label label;
  {
    const std::lock_guard lock(mutex_);
    label = labels_[pane];
  }
  open_slot(label.kind, label.text, length);
  setup_.panes[pane]->run_slot(length, forced, stop_slot_);
  close_slot();
}

void MeasureScheduler::run() {
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return wanted_ || quit_; });
      if (quit_) return;
    }
    running_ = true;
    for (PaneWorker* pane : setup_.panes) pane->hold(true);
    while (!stop_slot_.load()) {
      ui::MeasureSettings settings;
      {
        const std::lock_guard lock(mutex_);
        settings = settings_;
      }
      bool any = false;
      for (std::size_t pane = 0; pane < setup_.panes.size() && !stop_slot_.load(); ++pane) {
        if (!setup_.panes[pane]->can_run()) continue;
        any = true;
        idle_slot(energy::Seconds(double(settings.idle_s)));
        if (stop_slot_.load()) break;
        pane_slot(pane, energy::Seconds(double(settings.slot_s)), settings.forced);
      }
      if (!any) setup_.clock->sleep_until(setup_.clock->now() + kNothingToDo, stop_slot_);
    }
    for (PaneWorker* pane : setup_.panes) pane->hold(false);
    running_ = false;
    const std::lock_guard lock(mutex_);
    if (wanted_) stop_slot_ = false;  // started again meanwhile
  }
}

}  // namespace encore::app
