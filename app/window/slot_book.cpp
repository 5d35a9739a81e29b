#include "app/window/slot_book.h"

#include "app/session_input.h"
#include "app/window/slot_convergence.h"
#include "app/window/slot_figures.h"

#include <algorithm>
#include <deque>
#include <mutex>
#include <utility>

namespace encore::app {

namespace {

using energy::Phase;
using energy::Seconds;

constexpr std::size_t kMostWindows = 4096;
constexpr std::size_t kMostRows = 1U << 14U;
constexpr std::size_t kMostKnots = 1U << 18U;

energy::BusyTimeline phase_timeline() {
  std::vector<std::string> names;
  for (const Phase phase : energy::kPhases) names.emplace_back(to_string(phase));
  return energy::BusyTimeline(std::move(names), Seconds(0.001), kMostKnots);
}

/// Neighbours in pairs: their means stay as they are.
void halve(std::vector<energy::FrameRow>& rows) {
  for (std::size_t i = 0; i + 1 < rows.size(); i += 2) {
    rows[i / 2] = energy::merge(rows[i], rows[i + 1]);
  }
  rows.resize(rows.size() / 2);
}

/// A window and what was read during it.
struct Measured {
  energy::Window window;
  std::shared_ptr<const PowerSet> power;
  bool overlapped = false;
};

void remember(std::deque<Measured>& windows, Measured window) {
  windows.push_back(std::move(window));
  if (windows.size() > kMostWindows) windows.pop_front();
}

struct Configuration {
  std::vector<energy::KeyValue> identity;
  SlotEvidence evidence;
  std::deque<Measured> measured;
  std::vector<SlotRow> new_rows;  ///< not yet seen by `convergence`
  /// Only compute() uses it.
  std::shared_ptr<SlotConvergence> convergence = std::make_shared<SlotConvergence>();
};

}  // namespace

struct SlotBook::Impl {
  std::mutex mutex;
  std::deque<Configuration> configurations;
  std::deque<Measured> idle;
  std::shared_ptr<const PowerSet> power;  ///< of the latest slot
  std::optional<Slot> slot;               ///< under way
  Configuration* configuration = nullptr;
  energy::Window window;  ///< of the slot under way, up to its last operation
  std::uint64_t slots = 0;
  std::uint64_t version = 0;

  Configuration& configuration_of(const Slot& begun);
  [[nodiscard]] Measured under_way() const {
    return {window, power, power && power->busy && power->busy->overlapped(window.from, window.to)};
  }
  SlotEvidence evidence_of(const Configuration& one) const;
};

Configuration& SlotBook::Impl::configuration_of(const Slot& begun) {
  std::vector<energy::KeyValue> identity = configuration_identity(begun.configuration);
  for (Configuration& known : configurations) {
    if (known.identity == identity) return known;
  }
  Configuration& fresh = configurations.emplace_back();
  fresh.identity = std::move(identity);
  fresh.evidence.busy = phase_timeline();
  return fresh;
}

SlotEvidence SlotBook::Impl::evidence_of(const Configuration& one) const {
  SlotEvidence evidence = one.evidence;
  evidence.power = power;
  const auto take = [&](const Measured& measured) {
    if (measured.power != power) return;
    evidence.overlapped = evidence.overlapped || measured.overlapped;
    if (!measured.overlapped) evidence.measured.push_back(measured.window);
  };
  for (const Measured& measured : one.measured) take(measured);
  if (slot && configuration == &one && window.to > window.from) take(under_way());
  for (const Measured& resting : idle) {
    if (resting.power == power && !resting.overlapped) evidence.idle.push_back(resting.window);
  }
  return evidence;
}

SlotBook::SlotBook() : impl_(std::make_unique<Impl>()) {}
SlotBook::~SlotBook() = default;

void SlotBook::slot_began(const Slot& slot, const std::shared_ptr<const PowerSet>& power,
                          Seconds now) {
  slot_ended(now);
  const std::lock_guard lock(impl_->mutex);
  impl_->slot = slot;
  impl_->power = power;
  impl_->window = {now, now};
  ++impl_->slots;
  impl_->configuration = slot.idle ? nullptr : &impl_->configuration_of(slot);
  if (impl_->configuration != nullptr) impl_->configuration->evidence.slot = slot;
}

void SlotBook::operation(const Operation& operation) {
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->slot || impl_->configuration == nullptr) return;
  if (operation.began < impl_->window.to) return;
  SlotEvidence& evidence = impl_->configuration->evidence;
  for (const energy::PhaseSpan& span : operation.spans) {
    ++evidence.counts[span.phase];
    evidence.busy.add(static_cast<std::size_t>(span.phase), span.start, span.end);
  }
  evidence.busy.add_operations(1.0, operation.began, operation.ended);
  impl_->window.to = operation.ended;
}

void SlotBook::row(const energy::FrameRow& row) {
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->slot || impl_->configuration == nullptr || row.time < impl_->window.from) return;
  Configuration& one = *impl_->configuration;
  const auto operations = static_cast<double>(row.operations);
  // Operations follow each other closely; where the row ended is the end of its last one.
  const Seconds end = std::max(impl_->window.to, row.time + row.total() * operations);
  one.new_rows.push_back(
      {impl_->slots, impl_->window.from, end, operations, row.total(), impl_->power});
  std::vector<energy::FrameRow>& rows = one.evidence.rows;
  rows.push_back(row);
  rows.back().configuration.clear();
  if (rows.size() >= kMostRows) halve(rows);
}

void SlotBook::slot_ended(Seconds now) {
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->slot) return;
  if (impl_->slot->idle) {
    impl_->window.to = now;
    if (now > impl_->window.from) remember(impl_->idle, impl_->under_way());
  } else if (impl_->window.to > impl_->window.from) {
    // Up to the end: what ran between and after operations is part of it, as in the runner.
    impl_->window.to = std::max(impl_->window.to, now);
    remember(impl_->configuration->measured, impl_->under_way());
    ++impl_->configuration->evidence.slots;
  }
  impl_->slot.reset();
  impl_->configuration = nullptr;
}

Figures SlotBook::compute(Seconds now) {
  struct Work {
    SlotEvidence evidence;
    std::vector<SlotRow> new_rows;
    std::shared_ptr<SlotConvergence> convergence;
  };
  std::vector<Work> work;
  Figures figures;
  figures.computed_at = now;
  {
    const std::lock_guard lock(impl_->mutex);
    figures.version = ++impl_->version;
    for (Configuration& one : impl_->configurations) {
      if (one.evidence.rows.empty()) continue;
      work.push_back({impl_->evidence_of(one), std::move(one.new_rows), one.convergence});
      one.new_rows.clear();
    }
  }
  for (Work& one : work) {
    for (SlotRow& row : one.new_rows) one.convergence->add(std::move(row));
    one.convergence->update();
    LiveFigures& live = figures.configurations.emplace_back(figures_of(one.evidence, now));
    live.convergence = one.convergence->rows(live.configuration);
    if (live.summary.idle_watts) figures.idle_watts = live.summary.idle_watts;
  }
  return figures;
}

void SlotBook::clear() {
  const std::lock_guard lock(impl_->mutex);
  impl_->configurations.clear();
  impl_->idle.clear();
  impl_->slot.reset();
  impl_->configuration = nullptr;
}

}  // namespace encore::app
