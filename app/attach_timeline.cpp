#include "app/attach_timeline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace encore::app {

namespace {

using energy::FrameRow;
using energy::Phase;
using energy::Seconds;
using energy::WindowRow;

/// Rows of one window, in the order of time, each with the moment at which it must have ended.
struct PlacedRow {
  const FrameRow* row = nullptr;
  Seconds start;
  Seconds end;  ///< of its last operation's last phase
};

std::vector<PlacedRow> rows_in(const std::vector<FrameRow>& frames, const energy::Window& window) {
  std::vector<PlacedRow> rows;
  for (const FrameRow& row : frames) {
    if (row.time < window.from || row.time >= window.to || row.operations == 0) continue;
    rows.push_back({&row, row.time, {}});
  }
  const auto earlier = [](const PlacedRow& a, const PlacedRow& b) { return a.start < b.start; };
  std::stable_sort(rows.begin(), rows.end(), earlier);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Seconds limit = i + 1 < rows.size() ? rows[i + 1].start : window.to;
    const Seconds length = rows[i].row->total() * static_cast<double>(rows[i].row->operations);
    rows[i].end = std::clamp(rows[i].start + length, rows[i].start, limit);
  }
  return rows;
}

void lay_out(const PlacedRow& placed, energy::BusyTimeline& busy) {
  const FrameRow& row = *placed.row;
  const auto operations = static_cast<double>(row.operations);
  busy.add_operations(operations, placed.start, placed.end);
  // Operations much shorter than the timeline resolves are taken several at a time.
  constexpr Seconds kFinest(0.00025);
  const double pieces = std::ceil(row.total() * operations / kFinest);
  const double groups = std::clamp(pieces, 1.0, operations);
  Seconds time = placed.start;
  for (double group = 0; group < groups; ++group) {
    for (const Phase phase : energy::kPhases) {
      if (!row.phases[phase]) continue;
      const Seconds end = std::min(time + *row.phases[phase] * (operations / groups), placed.end);
      if (!(end > time)) continue;
      busy.add(static_cast<std::size_t>(phase), time, end);
      time = end;
    }
  }
}

/// Spans in the order of time; those that touch (or nearly do) become one.
class Spans {
 public:
  void add(Seconds start, Seconds end) {
    constexpr Seconds kTouching(0.001);
    if (!spans_.empty()) start = std::max(start, spans_.back().end);
    if (!(end > start)) return;
    if (!spans_.empty() && start - spans_.back().end <= kTouching) {
      spans_.back().end = end;
    } else {
      spans_.push_back({Phase::render, start, end});
    }
  }
  std::vector<energy::PhaseSpan> take() { return std::move(spans_); }

 private:
  std::vector<energy::PhaseSpan> spans_;
};

}  // namespace

SessionLoad load_of(const energy::Session& session, Seconds since) {
  std::vector<const WindowRow*> windows;
  for (const WindowRow& window : session.windows) {
    if (window.from >= since && window.to > window.from) windows.push_back(&window);
  }
  const auto earlier = [](const WindowRow* a, const WindowRow* b) { return a->from < b->from; };
  std::stable_sort(windows.begin(), windows.end(), earlier);
  SessionLoad load;
  if (windows.empty()) return load;

  load.from = load.to = windows.front()->from;
  Spans spans;
  const WindowRow* before = nullptr;
  for (const WindowRow* window : windows) {
    Seconds busy_from = load.to;
    const bool begins = before != nullptr && before->configuration != window->configuration;
    if (begins) busy_from += session.info.plan.cool_down;
    spans.add(busy_from, window->from);
    if (window->kind == "measured") {
      for (const PlacedRow& row : rows_in(session.frames, {window->from, window->to})) {
        spans.add(row.start, row.end);
      }
    } else if (window->kind != "idle") {
      spans.add(window->from, window->to);
    }
    load.to = std::max(load.to, window->to);
    before = window;
  }
  load.busy = spans.take();
  return load;
}

energy::BusyTimeline busy_in(const std::vector<FrameRow>& frames,
                             std::span<const energy::Window> measured) {
  energy::BusyTimeline busy = energy::BusyTimeline::of_phases();
  for (const energy::Window& window : measured) {
    for (const PlacedRow& row : rows_in(frames, window)) lay_out(row, busy);
  }
  return busy;
}

}  // namespace encore::app
