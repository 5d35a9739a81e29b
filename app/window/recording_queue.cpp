#include "app/window/recording_queue.h"

#include <utility>

namespace encore::app {

namespace {

using energy::Seconds;

constexpr std::size_t kMostWaiting = 1U << 17U;

}  // namespace

RecordingQueue::RecordingQueue() : book_(std::make_unique<SlotBook>()) {}
RecordingQueue::~RecordingQueue() = default;

void RecordingQueue::begin(Seconds session_start) {
  const std::lock_guard lock(mutex_);
  open_ = true;
  start_ = session_start;
  pauses_ = {};
  paused_since_.reset();
  rows_.clear();
  overflowed_ = false;
  points_ = {};
  continued_.clear();
  slot_.reset();
  slot_start_.reset();
  last_measured_.clear();
  idle_before_.reset();
  book_ = std::make_unique<SlotBook>();
}

void RecordingQueue::end() {
  const std::lock_guard lock(mutex_);
  open_ = false;
}

Seconds RecordingQueue::seconds(Seconds now) const {
  const std::lock_guard lock(mutex_);
  return paused_since_.value_or(now) - start_ - pauses_;
}

void RecordingQueue::pause(Seconds now) {
  const std::lock_guard lock(mutex_);
  if (paused_since_) return;
  if (open_) {
    close_slot(now);
    push(energy::EventRow{now - start_, "", "recording paused"});
  }
  paused_since_ = now;
}

void RecordingQueue::resume(Seconds now) {
  const std::lock_guard lock(mutex_);
  if (!paused_since_) return;
  pauses_ += now - *paused_since_;
  paused_since_.reset();
  // What the sensors counted meanwhile belongs to nothing that was recorded.
  continued_.clear();
  idle_before_.reset();
  if (!open_) return;
  push(energy::EventRow{now - start_, "", "recording resumed"});
  open_slot(now);
}

void RecordingQueue::push(RecordedRow row) {
  if (rows_.size() >= kMostWaiting) {
    overflowed_ = true;
    return;
  }
  rows_.push_back(std::move(row));
}

std::vector<RecordedRow> RecordingQueue::take() {
  const std::lock_guard lock(mutex_);
  if (overflowed_) {
    throw energy::SessionError(
        "the disk takes rows more slowly than they are measured; record to another one");
  }
  return std::exchange(rows_, {});
}

void RecordingQueue::reading(const energy::SourceInfo& info, const energy::ReadResult& result) {
  const std::lock_guard lock(mutex_);
  if (!takes()) return;
  const bool good =
      result.state == energy::ReadState::ok || result.state == energy::ReadState::restarted;
  if (!good || result.reading.time < start_) return;
  const bool after_pause = pauses_.value > 0 && !continued_.contains(info.name);
  continued_.insert(info.name);
  energy::ReadResult told = result;
  if (after_pause) told.state = energy::ReadState::restarted;
  const PowerPoint point = points_.make(info, told);
  energy::SampleRow row;
  row.time = result.reading.time - start_;
  row.source = info.name;
  if (point.watts) row.watts = energy::Watts(*point.watts);
  row.joules = result.reading.energy;
  row.changed = result.reading.changed;
  row.restarted = told.state == energy::ReadState::restarted;
  row.origin = info.provenance.origin;
  push(std::move(row));
}

void RecordingQueue::event(const energy::SamplerEvent& event) {
  const std::lock_guard lock(mutex_);
  if (takes()) push(energy::EventRow{event.time - start_, event.source, event.message});
}

void RecordingQueue::note(Seconds now, std::string text) {
  const std::lock_guard lock(mutex_);
  if (open_) push(energy::EventRow{now - start_, "", std::move(text)});
}

void RecordingQueue::frame(const energy::FrameRow& row) {
  const std::lock_guard lock(mutex_);
  if (!takes() || row.time < start_) return;
  energy::FrameRow told = row;
  told.time = row.time - start_;
  push(std::move(told));
}

void RecordingQueue::slot_began(const Slot& slot, const std::shared_ptr<const PowerSet>& power,
                                Seconds now) {
  const std::lock_guard lock(mutex_);
  slot_ = slot;
  power_ = power;
  if (takes()) open_slot(now);
}

void RecordingQueue::open_slot(Seconds now) {
  if (!slot_) return;
  slot_start_ = now;
  book_->slot_began(*slot_, power_, now);
  if (slot_->idle) return;
  if (idle_before_ && slot_->configuration != last_measured_) {
    push_window(slot_->configuration, "idle", *idle_before_);
  }
  idle_before_.reset();
  last_measured_ = slot_->configuration;
}

void RecordingQueue::operation(const Operation& operation) {
  const std::lock_guard lock(mutex_);
  if (takes() && slot_start_ && operation.began >= *slot_start_) book_->operation(operation);
}

void RecordingQueue::row(const energy::FrameRow& row) {
  const std::lock_guard lock(mutex_);
  if (!takes() || !slot_start_ || row.time < *slot_start_) return;
  book_->row(row);
  energy::FrameRow told = row;
  told.time = row.time - start_;
  push(std::move(told));
}

void RecordingQueue::slot_ended(Seconds now) {
  const std::lock_guard lock(mutex_);
  if (takes()) close_slot(now);
  slot_.reset();
}

void RecordingQueue::close_slot(Seconds now) {
  if (!slot_ || !slot_start_) return;
  book_->slot_ended(now);
  const energy::Window window{*slot_start_, now};
  slot_start_.reset();
  if (!(window.to > window.from)) return;
  if (!slot_->idle) {
    push_window(slot_->configuration, "measured", window);
    return;
  }
  // It is the baseline of the configuration before it and of the one behind it, which windows.csv
  // names one by one.
  if (!last_measured_.empty()) push_window(last_measured_, "idle", window);
  idle_before_ = window;
}

void RecordingQueue::push_window(const std::vector<energy::KeyValue>& configuration,
                                 const char* kind, const energy::Window& window) {
  push(energy::WindowRow{configuration, kind, window.from - start_, window.to - start_});
}

}  // namespace encore::app
