#include "app/window/busy_marks.h"

#include <algorithm>

namespace encore::app {

namespace {

constexpr std::size_t kMostOverlaps = 4096;

std::size_t index_of(Device device) {
  return static_cast<std::size_t>(device);
}

}  // namespace

energy::Seconds BusyMarks::in_order(energy::Seconds now) {
  // Two threads may read the clock in one order and come here in the other.
  last_ = std::max(last_, now);
  return last_;
}

void BusyMarks::begin(Device device, energy::Phase phase, energy::Seconds now) {
  const std::lock_guard lock(mutex_);
  now = in_order(now);
  if (open_.at(index_of(device))) finish(device, now);
  const bool alone = std::none_of(open_.begin(), open_.end(),
                                  [](const std::optional<Open>& open) { return open.has_value(); });
  open_.at(index_of(device)) = Open{phase, now};
  if (alone) {
    live_.begin(phase, now);
    told_ = device;
    return;
  }
  if (!overlaps_.empty() && !overlaps_.back().to) return;
  overlaps_.push_back({now, std::nullopt});
  if (overlaps_.size() > kMostOverlaps) overlaps_.pop_front();
}

void BusyMarks::end(Device device, energy::Seconds now) {
  const std::lock_guard lock(mutex_);
  if (open_.at(index_of(device))) finish(device, in_order(now));
}

void BusyMarks::finish(Device device, energy::Seconds now) {
  open_.at(index_of(device)).reset();
  std::size_t busy = 0;
  std::optional<Device> other;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (!open_[i]) continue;
    ++busy;
    other = static_cast<Device>(i);
  }
  if (busy < 2 && !overlaps_.empty() && !overlaps_.back().to) overlaps_.back().to = now;
  if (told_ != device) return;
  live_.end(now);
  told_ = other;
  if (other) live_.begin(open_[index_of(*other)]->phase, now);
}

bool BusyMarks::overlapped(energy::Seconds from, energy::Seconds to) const {
  const std::lock_guard lock(mutex_);
  // The latest lie behind: what is asked about is recent.
  for (auto one = overlaps_.rbegin(); one != overlaps_.rend(); ++one) {
    if (one->to && *one->to < from) return false;
    if (one->from <= to) return true;
  }
  return false;
}

std::optional<energy::Phase> BusyMarks::running(Device device) const {
  const std::lock_guard lock(mutex_);
  const std::optional<Open>& open = open_.at(index_of(device));
  if (!open) return std::nullopt;
  return open->phase;
}

}  // namespace encore::app
