#include "ui/plot/sample_history.h"

#include <algorithm>
#include <cmath>

namespace encore::ui {

namespace {

constexpr std::uint64_t kFactor = 4;

std::size_t whole_groups(std::size_t capacity) {
  return std::max<std::size_t>(16, capacity / kFactor * kFactor);
}

}  // namespace

Bucket merge(const Bucket& a, const Bucket& b) {
  Bucket both = a;
  both.t1 = b.t1;
  both.covered += b.covered;
  both.integral += b.integral;
  both.sum += b.sum;
  both.count += b.count;
  both.changed += b.changed;
  both.min = std::min(a.min, b.min);
  both.max = std::max(a.max, b.max);
  both.low = std::min(a.low, b.low);
  both.high = std::max(a.high, b.high);
  both.last = b.last;
  return both;
}

template <class T>
void SampleHistory::Ring<T>::push(const T& item) {
  // Drops the oldest group of four when full, as its sum is in the level above.
  if (end_ - dropped == capacity) dropped += kFactor;
  if (items.size() < capacity) {
    items.push_back(item);
  } else {
    items[static_cast<std::size_t>(end_ % capacity)] = item;
  }
  ++end_;
}

template <class T>
void SampleHistory::Ring<T>::clear() {
  items.clear();
  items.shrink_to_fit();
  dropped = 0;
  end_ = 0;
}

SampleHistory::SampleHistory(Reading reading, std::size_t raw, std::size_t merged)
    : reading_(reading), merged_capacity_(whole_groups(merged)) {
  raw_.capacity = whole_groups(raw);
}

bool SampleHistory::add(double time_s, double value, bool changed, bool gap_before,
                        double half_width) {
  const auto narrow = static_cast<float>(value);
  const bool late = added_ > 0 && time_s < raw_[raw_.end() - 1].time;
  if (!std::isfinite(time_s) || !std::isfinite(narrow) || late) {
    gap_pending_ = true;
    return false;
  }
  const auto band = static_cast<float>(std::isfinite(half_width) ? std::abs(half_width) : 0.0);
  if (raw_.end() - raw_.dropped == raw_.capacity) before_raw_ = raw_[raw_.dropped + kFactor - 1];
  raw_.push({time_s, narrow, band, changed, gap_before || gap_pending_});
  gap_pending_ = false;
  if (added_ == 0) first_time_ = time_s;
  ++added_;
  carry(0);
  return true;
}

void SampleHistory::carry(std::size_t level) {
  // Each full group of four is one entry of the level above.
  const std::uint64_t end = end_of(level);
  if (end % kFactor != 0) return;
  Bucket group = entry(level, end - kFactor);
  for (std::uint64_t i = end - kFactor + 1; i < end; ++i) group = merge(group, entry(level, i));
  if (levels_.size() == level) levels_.emplace_back().capacity = merged_capacity_;
  levels_[level].push(group);
  carry(level + 1);
}

void SampleHistory::clear() {
  raw_.clear();
  levels_.clear();
  before_raw_.reset();
  first_time_.reset();
  added_ = 0;
  gap_pending_ = false;
}

std::uint64_t SampleHistory::end_of(std::size_t level) const {
  return level == 0 ? raw_.end() : levels_[level - 1].end();
}

std::uint64_t SampleHistory::dropped_of(std::size_t level) const {
  return level == 0 ? raw_.dropped : levels_[level - 1].dropped;
}

Bucket SampleHistory::entry(std::size_t level, std::uint64_t index) const {
  return level == 0 ? raw_bucket(index) : levels_[level - 1][index];
}

Bucket SampleHistory::raw_bucket(std::uint64_t index) const {
  const Raw& raw = raw_[index];
  const Raw* previous = nullptr;
  if (index > raw_.dropped) {
    previous = &raw_[index - 1];
  } else if (before_raw_) {
    previous = &*before_raw_;
  }
  Bucket bucket;
  bucket.from = bucket.t0 = bucket.t1 = raw.time;
  bucket.sum = static_cast<double>(raw.value);
  bucket.count = 1;
  bucket.changed = raw.changed ? 1 : 0;
  bucket.min = bucket.max = bucket.first = bucket.last = raw.value;
  bucket.low = raw.value - raw.half_width;
  bucket.high = raw.value + raw.half_width;
  bucket.gap_before = raw.gap_before;
  if (previous != nullptr && !raw.gap_before) {
    bucket.from = previous->time;
    bucket.covered = raw.time - previous->time;
    const double other = reading_ == Reading::point ? static_cast<double>(previous->value)
                                                    : static_cast<double>(raw.value);
    bucket.integral = bucket.covered * 0.5 * (other + static_cast<double>(raw.value));
  }
  return bucket;
}

std::optional<Bucket> SampleHistory::latest() const {
  if (added_ == 0) return std::nullopt;
  return raw_bucket(raw_.end() - 1);
}

std::optional<double> SampleHistory::first_time() const {
  return first_time_;
}

std::size_t SampleHistory::bytes() const {
  std::size_t total = raw_.items.capacity() * sizeof(Raw);
  for (const auto& level : levels_) total += level.items.capacity() * sizeof(Bucket);
  return total;
}

void SampleHistory::descend(std::size_t level, std::uint64_t index, double width,
                            const Wanted& wanted, const Use& use) const {
  const Bucket bucket = entry(level, index);
  if (!wanted(bucket)) return;
  const bool has_parts = level > 0 && index * kFactor >= dropped_of(level - 1);
  if (!has_parts || bucket.t1 - bucket.from <= width) {
    use(bucket);
    return;
  }
  for (std::uint64_t i = 0; i < kFactor; ++i) {
    descend(level - 1, index * kFactor + i, width, wanted, use);
  }
}

void SampleHistory::visit(double width, const Wanted& wanted, const Use& use) const {
  // The top level holds everything but the groups that are not full yet; those are at the end of
  // the levels below, fewer than four on each.
  std::uint64_t next = 0;
  for (std::size_t level = levels_.size() + 1; level-- > 0;) {
    const std::uint64_t end = end_of(level);
    for (std::uint64_t i = std::max(next, dropped_of(level)); i < end; ++i) {
      descend(level, i, width, wanted, use);
    }
    next = end * kFactor;
  }
}

std::vector<Bucket> SampleHistory::between(double t0, double t1, std::size_t most) const {
  std::vector<Bucket> found;
  if (most == 0 || !(t0 <= t1)) return found;
  const double width = (t1 - t0) / static_cast<double>(std::max<std::size_t>(most, 2) - 1);
  visit(
      width, [&](const Bucket& b) { return b.t1 >= t0 && b.t0 <= t1; },
      [&](const Bucket& b) { found.push_back(b); });
  if (found.size() <= most) return found;

  // Merges what falls in one cell of a grid that does not move with the range.
  const double origin = width > 0.0 ? std::floor(t0 / width) * width : t0;
  const auto cell_of = [&](const Bucket& b) {
    const double middle = std::clamp(0.5 * (b.t0 + b.t1), t0, t1);
    const double cell = width > 0.0 ? std::floor((middle - origin) / width) : 0.0;
    return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(most - 1)));
  };
  std::vector<Bucket> merged;
  merged.reserve(most);
  std::size_t cell = most;
  for (const Bucket& bucket : found) {
    const std::size_t its_cell = cell_of(bucket);
    if (!merged.empty() && its_cell == cell) {
      merged.back() = merge(merged.back(), bucket);
    } else {
      merged.push_back(bucket);
    }
    cell = its_cell;
  }
  return merged;
}

std::uint64_t SampleHistory::first_entry(std::size_t level, double time_s, bool at) const {
  std::uint64_t low = dropped_of(level);
  std::uint64_t high = end_of(level);
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    const double t = level == 0 ? raw_[middle].time : levels_[level - 1][middle].t0;
    if (at ? t < time_s : t <= time_s) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

std::optional<Bucket> SampleHistory::before(double time_s) const {
  for (std::size_t level = 0; level <= levels_.size(); ++level) {
    const std::uint64_t index = first_entry(level, time_s, true);
    if (index > dropped_of(level)) return entry(level, index - 1);
  }
  return std::nullopt;
}

std::optional<Bucket> SampleHistory::after(double time_s) const {
  std::optional<Bucket> finer;  // the oldest entry of the level below, if it is after the time
  for (std::size_t level = 0; level <= levels_.size(); ++level) {
    const std::uint64_t index = first_entry(level, time_s, false);
    const bool reaches_back = index > dropped_of(level) || dropped_of(level) == 0;
    if (index < end_of(level)) {
      if (reaches_back) return entry(level, index);
      finer = entry(level, index);
    } else if (reaches_back) {
      return finer;
    }
  }
  return finer;
}

std::optional<std::array<double, 2>> SampleHistory::extremes(double t0, double t1) const {
  std::optional<std::array<double, 2>> range;
  constexpr double kParts = 256.0;
  visit((t1 - t0) / kParts, [&](const Bucket& b) { return b.t1 >= t0 && b.t0 <= t1; },
        [&](const Bucket& b) {
          const auto low = static_cast<double>(b.min);
          const auto high = static_cast<double>(b.max);
          range = range ? std::array{std::min((*range)[0], low), std::max((*range)[1], high)}
                        : std::array{low, high};
        });
  return range;
}

}  // namespace encore::ui
