#include "app/window/live_attribution.h"

#include "app/window/slot_rows.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace encore::app {

namespace {

using energy::Seconds;

/// Computing shares the processor with what is measured: it may take a twentieth of one core.
constexpr double kMostShare = 0.05;

}  // namespace

struct LiveAttribution::Impl {
  Impl(PowerMonitor& from, Setup how) : monitor(from), setup(how) {}

  /// The slot under way as its listeners know it.
  void end_slot() {
    if (!slot) return;
    if (rows) {
      if (const auto row = rows->finish()) tell_row(*row);
    }
    const Seconds now = monitor.clock().now();
    book.slot_ended(now);
    if (listener != nullptr) listener->slot_ended(now);
    rows.reset();
    slot.reset();
  }
  void tell_row(const energy::FrameRow& row) {
    book.row(row);
    if (listener != nullptr) listener->row(row);
  }
  std::shared_ptr<const Figures> compute() {
    const std::lock_guard one_at_a_time(compute_mutex);
    const std::uint64_t before = clears;
    auto figures = std::make_shared<const Figures>(book.compute(monitor.clock().now()));
    const std::lock_guard lock(latest_mutex);
    if (clears == before) latest = figures;  // else it is about what was forgotten meanwhile
    return latest;
  }
  void work(const std::stop_token& stop);

  PowerMonitor& monitor;
  Setup setup;
  SlotBook book;
  std::mutex mutex;  ///< of what is told
  std::optional<Slot> slot;
  std::shared_ptr<const PowerSet> power;
  std::unique_ptr<SlotRows> rows;
  SlotListener* listener = nullptr;
  std::mutex compute_mutex;
  std::atomic<std::uint64_t> clears{0};
  mutable std::mutex latest_mutex;
  std::shared_ptr<const Figures> latest = std::make_shared<const Figures>();
  std::mutex request_mutex;
  std::condition_variable_any wake;
  bool requested = false;
  std::jthread thread;
};

void LiveAttribution::Impl::work(const std::stop_token& stop) {
  using SteadyClock = std::chrono::steady_clock;
  std::unique_lock lock(request_mutex);
  while (wake.wait(lock, stop, [this] { return requested; })) {
    requested = false;
    lock.unlock();
    const auto start = SteadyClock::now();
    compute();
    const std::chrono::duration<double> cost = SteadyClock::now() - start;
    const auto pause =
        std::chrono::duration<double>(std::max(setup.every.value, cost.count() / kMostShare));
    lock.lock();
    wake.wait_for(lock, stop, pause, [] { return false; });
  }
}

LiveAttribution::LiveAttribution(PowerMonitor& monitor) : LiveAttribution(monitor, Setup{}) {}

LiveAttribution::LiveAttribution(PowerMonitor& monitor, Setup setup)
    : impl_(std::make_unique<Impl>(monitor, setup)) {
  if (!setup.threaded) return;
  impl_->thread =
      std::jthread([impl = impl_.get()](const std::stop_token& stop) { impl->work(stop); });
}

LiveAttribution::~LiveAttribution() {
  // Before what it works on goes.
  impl_->thread = {};
}

void LiveAttribution::slot_began(const Slot& slot) {
  // Before the lock, for a sensor may take its time: one reading is the edge of both slots.
  impl_->monitor.read_now();
  const std::lock_guard lock(impl_->mutex);
  impl_->end_slot();
  impl_->power = impl_->monitor.current();
  const Seconds now = impl_->monitor.clock().now();
  impl_->slot = slot;
  impl_->book.slot_began(slot, impl_->power, now);
  if (impl_->listener != nullptr) impl_->listener->slot_began(slot, impl_->power, now);
  if (slot.idle) return;
  impl_->rows =
      std::make_unique<SlotRows>(slot, impl_->power, impl_->monitor.clock(), impl_->setup.row);
}

Seconds LiveAttribution::begin_operation() {
  const std::lock_guard lock(impl_->mutex);
  if (impl_->rows) impl_->rows->begin();
  return impl_->monitor.clock().now();
}

void LiveAttribution::operation(std::span<const energy::PhaseSpan> spans, Seconds began,
                                Seconds ended) {
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->rows || spans.empty()) return;
  const Operation operation{spans, began, ended};
  impl_->book.operation(operation);
  if (impl_->listener != nullptr) impl_->listener->operation(operation);
  const bool edges = impl_->monitor.edges_read_since(began);
  if (const auto row = impl_->rows->add(operation, edges)) impl_->tell_row(*row);
}

void LiveAttribution::slot_ended() {
  {
    const std::lock_guard lock(impl_->mutex);
    if (!impl_->slot) return;
  }
  impl_->monitor.read_now();
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->end_slot();
  }
  request();
}

void LiveAttribution::tell(SlotListener* listener) {
  const std::lock_guard lock(impl_->mutex);
  const Seconds now = impl_->monitor.clock().now();
  if (impl_->slot && impl_->listener != nullptr) impl_->listener->slot_ended(now);
  impl_->listener = listener;
  if (impl_->slot && listener != nullptr) listener->slot_began(*impl_->slot, impl_->power, now);
}

void LiveAttribution::request() {
  {
    const std::lock_guard lock(impl_->request_mutex);
    impl_->requested = true;
  }
  impl_->wake.notify_all();
}

std::shared_ptr<const Figures> LiveAttribution::latest() const {
  const std::lock_guard lock(impl_->latest_mutex);
  return impl_->latest;
}

void LiveAttribution::clear() {
  const std::lock_guard lock(impl_->mutex);
  if (impl_->slot && impl_->listener != nullptr) {
    impl_->listener->slot_ended(impl_->monitor.clock().now());
  }
  impl_->rows.reset();
  impl_->slot.reset();
  impl_->book.clear();
  const std::lock_guard latest_lock(impl_->latest_mutex);
  ++impl_->clears;
  impl_->latest = std::make_shared<const Figures>();
}

std::shared_ptr<const Figures> LiveAttribution::compute() {
  return impl_->compute();
}

}  // namespace encore::app
