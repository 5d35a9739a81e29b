#include "app/attach_timeline.h"
#include "app/session_input.h"
#include "app/window/opened_session.h"
#include "app/window/slot_convergence.h"
#include "app/window/slot_figures.h"

#include <algorithm>
#include <utility>

namespace encore::app {

namespace {

using energy::FrameRow;
using energy::Seconds;
using energy::Window;

/// One configuration of the session and what its files tell of it.
struct Recorded {
  std::vector<energy::KeyValue> identity;
  std::vector<FrameRow> rows;
  std::vector<Window> measured;
  std::vector<Window> idle;
};

Recorded& configuration_of(std::vector<Recorded>& all,
                           const std::vector<energy::KeyValue>& configuration) {
  // Rows of one configuration follow each other: the last one found is the likely one.
  std::vector<energy::KeyValue> identity = configuration_identity(configuration);
  const auto known = std::find_if(all.rbegin(), all.rend(),
                                  [&](const Recorded& one) { return one.identity == identity; });
  if (known != all.rend()) return *known;
  return all.emplace_back(Recorded{std::move(identity), {}, {}, {}});
}

Seconds end_of(const FrameRow& row) {
  return row.time + row.total() * static_cast<double>(row.operations);
}

std::vector<Recorded> sort_out(const energy::Session& session) {
  std::vector<Recorded> all;
  Seconds told;
  for (const FrameRow& row : session.frames) {
    configuration_of(all, row.configuration).rows.push_back(row);
  }
  for (const energy::WindowRow& row : session.windows) {
    told = std::max(told, row.to);
    Recorded& one = configuration_of(all, row.configuration);
    if (row.kind == "measured") one.measured.push_back({row.from, row.to});
    if (row.kind == "idle") one.idle.push_back({row.from, row.to});
  }
  // The window that was under way when the program was killed. Rows of two configurations there
  // are none of one window: both panes ran at once.
  Recorded* last = nullptr;
  std::size_t candidates = 0;
  for (Recorded& one : all) {
    if (one.rows.empty() || one.rows.back().time < told) continue;
    last = &one;
    ++candidates;
  }
  if (candidates != 1) return all;
  const auto first = std::find_if(last->rows.begin(), last->rows.end(),
                                  [&](const FrameRow& row) { return row.time >= told; });
  last->measured.push_back({first->time, end_of(last->rows.back())});
  return all;
}

energy::TraceView trace_of(const energy::SourceInfo& info,
                           const std::vector<SourceSeries>& series) {
  const auto found = std::find_if(series.begin(), series.end(),
                                  [&](const SourceSeries& one) { return one.name == info.name; });
  if (found == series.end()) return {};
  std::vector<energy::TracePoint> points;
  points.reserve(found->points.size());
  bool gap = true;
  for (const PowerPoint& point : found->points) {
    gap = gap || point.gap;
    if (!point.joules) continue;
    energy::TracePoint one{
        Seconds(point.time_s), energy::Joules(*point.joules), {}, point.changed, gap};
    if (!info.is_counter && point.watts) one.power = energy::Watts(*point.watts);
    points.push_back(one);
    gap = false;
  }
  return energy::TraceView(std::move(points));
}

energy::PerPhase<std::uint64_t> counts_of(const std::vector<FrameRow>& rows) {
  energy::PerPhase<std::uint64_t> counts{};
  for (const FrameRow& row : rows) {
    for (const energy::Phase phase : energy::kPhases) {
      if (row.phases[phase]) counts[phase] += row.operations;
    }
  }
  return counts;
}

LiveFigures figures_of(const Recorded& one, const energy::SessionInfo& info,
                       const std::vector<energy::TraceView>& traces) {
  Slot slot;
  slot.idle = false;
  slot.configuration = one.rows.back().configuration;
  LiveFigures figures;
  figures.configuration = slot.configuration;
  figures.summary = energy::summarise(one.rows, counts_of(one.rows));
  figures.summary.counters = summary_counters(slot, figures.summary);
  SlotConvergence convergence;
  for (const FrameRow& row : one.rows) {
    convergence.add(
        {0, Seconds(0), end_of(row), static_cast<double>(row.operations), row.total(), nullptr});
  }
  figures.convergence = convergence.rows(figures.configuration);
  if (one.measured.empty()) return figures;
  const auto earlier = [](const Window& a, const Window& b) { return a.from < b.from; };
  std::vector<Window> measured = one.measured;
  std::sort(measured.begin(), measured.end(), earlier);
  const energy::BusyTimeline busy = busy_in(one.rows, measured);
  attribute_sources(info.sources, traces, busy, measured, one.idle, info.sensor, figures);
  return figures;
}

}  // namespace

void recompute_figures(energy::Session& session, const std::vector<SourceSeries>& series) {
  std::vector<energy::TraceView> traces;
  for (const energy::SessionSource& source : session.info.sources) {
    traces.push_back(trace_of(source.info, series));
  }
  session.summaries.clear();
  session.phases.clear();
  session.convergence.clear();
  for (const Recorded& one : sort_out(session)) {
    if (one.rows.empty()) continue;
    LiveFigures figures = figures_of(one, session.info, traces);
    session.summaries.push_back(std::move(figures.summary));
    for (auto* rows : {&figures.source_phases, &figures.phases}) {
      std::move(rows->begin(), rows->end(), std::back_inserter(session.phases));
    }
    std::move(figures.convergence.begin(), figures.convergence.end(),
              std::back_inserter(session.convergence));
  }
}

}  // namespace encore::app
