#include "app/window/power_hub.h"

#include <algorithm>
#include <utility>

namespace encore::app {

namespace {

constexpr std::size_t kMostPending = 1U << 18U;
constexpr std::size_t kMostEvents = 1024;
constexpr energy::Seconds kTellAgain(60.0);

}  // namespace

void PowerHub::install(const std::shared_ptr<const PowerSet>& set) {
  const std::lock_guard lock(mutex_);
  current_ = set;
  points_ = {};
  for (Series& one : series_) {
    one.source.active = one.source.in_total = false;
    one.watts.reset();
  }
  for (const energy::SessionSource& source : set->sources) {
    const auto known = std::find_if(series_.begin(), series_.end(), [&](const Series& one) {
      return one.source.info == source.info;
    });
    const bool fresh = known == series_.end();
    Series& one = fresh ? series_.emplace_back() : *known;
    if (fresh) {
      one.source.id = static_cast<std::uint32_t>(series_.size() - 1);
      one.source.info = source.info;
    }
    one.source.in_total = source.in_total;
    one.source.active = true;
    one.source.lost = false;
    one.fresh = true;
  }
  error_.clear();
}

std::shared_ptr<const PowerSet> PowerHub::current() const {
  const std::lock_guard lock(mutex_);
  return current_;
}

PowerHub::Series* PowerHub::series_of(const energy::SourceInfo& info) {
  for (Series& one : series_) {
    if (one.source.active && one.source.info.name == info.name) return &one;
  }
  return nullptr;
}

void PowerHub::reading(std::uint64_t generation, const energy::SourceInfo& info,
                       const energy::ReadResult& result) {
  energy::ReadResult told = result;
  {
    const std::lock_guard lock(mutex_);
    if (!current_ || current_->generation != generation) return;
    Series* series = series_of(info);
    if (series == nullptr) return;
    const bool good =
        result.state == energy::ReadState::ok || result.state == energy::ReadState::restarted;
    if (!good) {
      series->watts.reset();
      series->source.lost = result.state == energy::ReadState::lost;
    } else {
      // A source that was opened anew counts from 0 again.
      if (series->fresh && series->ever) told.state = energy::ReadState::restarted;
      series->fresh = false;
      series->ever = true;
      PowerPoint point = points_.make(info, told);
      point.time_s -= start_.value;
      if (point.watts) series->watts = point.watts;
      std::vector<PowerPoint>& pending = series->pending;
      if (pending.size() >= kMostPending) {
        pending.erase(pending.begin(), pending.begin() + kMostPending / 2);
        pending.front().gap = true;
        dropped_ += kMostPending / 2;
      }
      pending.push_back(point);
    }
  }
  const std::lock_guard lock(sink_mutex_);
  if (sink_.on_reading) sink_.on_reading(info, told);
}

void PowerHub::event(const energy::SamplerEvent& event) {
  {
    const std::lock_guard lock(mutex_);
    const auto [told, first] = told_.try_emplace({event.source, event.message}, event.time);
    if (!first && event.time - told->second < kTellAgain) return;
    told->second = event.time;
    if (told_.size() > kMostEvents) told_.clear();
    events_.push_back({(event.time - start_).value, event.source, event.message});
    if (events_.size() > kMostEvents) events_.erase(events_.begin());
  }
  const std::lock_guard lock(sink_mutex_);
  if (sink_.on_event) sink_.on_event(event);
}

void PowerHub::set_sink(energy::SamplerSink sink) {
  const std::lock_guard lock(sink_mutex_);
  sink_ = std::move(sink);
}

void PowerHub::set_cost(const energy::SamplerCost& cost) {
  const std::lock_guard lock(mutex_);
  cost_ = cost;
}
void PowerHub::set_opening(bool opening) {
  const std::lock_guard lock(mutex_);
  opening_ = opening;
}
void PowerHub::set_error(std::string error) {
  const std::lock_guard lock(mutex_);
  error_ = std::move(error);
}

PowerState PowerHub::state() const {
  const std::lock_guard lock(mutex_);
  PowerState state;
  bool complete = true;
  double watts = 0.0;
  for (const Series& one : series_) {
    state.sources.push_back(one.source);
    if (!one.source.in_total) continue;
    complete = complete && one.watts && !one.source.lost;
    watts += one.watts.value_or(0.0);
  }
  if (current_) {
    state.total = current_->provenance;
    state.total_name = current_->total_name;
    state.generation = current_->generation;
    if (complete && !current_->total.empty()) state.watts = watts;
  } else {
    state.total.detail = "the power sources are being opened";
  }
  state.opening = opening_;
  state.error = error_;
  state.cost = cost_;
  return state;
}

PowerNews PowerHub::drain() {
  const std::lock_guard lock(mutex_);
  PowerNews news;
  for (Series& one : series_) {
    if (one.pending.empty()) continue;
    news.points.push_back({one.source.id, std::move(one.pending)});
    one.pending.clear();
  }
  news.events.swap(events_);
  news.dropped = std::exchange(dropped_, 0);
  return news;
}

}  // namespace encore::app
