#include "app/window/power_plots.h"

#include <algorithm>

namespace encore::app {

namespace {

/// More would not be read by anybody.
constexpr std::size_t kMostEvents = 1000;

std::unique_ptr<ui::SampleHistory> history_of(bool counter) {
  return std::make_unique<ui::SampleHistory>(counter ? ui::Reading::mean_since
                                                     : ui::Reading::point);
}

}  // namespace

void PowerPlots::append(Series& series, const PowerPoint& point) {
  series.gap = series.gap || point.gap;
  if (!point.watts) return;  // a counter between two of its updates
  series.history->add(point.time_s, *point.watts, point.changed, series.gap);
  series.watts = point.watts;
  series.gap = false;
}

void PowerPlots::add(const PowerNews& news, const PowerState& state) {
  for (const PowerNews::Points& points : news.points) {
    Series& series = series_[points.source];
    if (!series.history) {
      const auto source =
          std::find_if(state.sources.begin(), state.sources.end(),
                       [&points](const MonitoredSource& s) { return s.id == points.source; });
      series.history = history_of(source == state.sources.end() || source->info.is_counter);
    }
    for (const PowerPoint& point : points.points) append(series, point);
  }
  events_.insert(events_.end(), news.events.begin(), news.events.end());
  if (events_.size() > kMostEvents) {
    events_.erase(events_.begin(), events_.end() - static_cast<std::ptrdiff_t>(kMostEvents));
  }
}

std::vector<ui::PowerSeriesView> PowerPlots::views(const PowerState& state) const {
  std::vector<ui::PowerSeriesView> views;
  for (const MonitoredSource& source : state.sources) {
    const auto found = series_.find(source.id);
    ui::PowerSeriesView view;
    view.name = source.info.name;
    view.includes = source.info.includes;
    view.provenance = source.info.provenance;
    view.in_total = source.in_total && source.active;
    view.lost = source.lost;
    if (found != series_.end()) {
      view.history = found->second.history.get();
      if (source.active && !source.lost) view.watts = found->second.watts;
    }
    views.push_back(std::move(view));
  }
  return views;
}

void PowerPlots::show(const OpenedSession& session) {
  series_.clear();
  events_.clear();
  for (std::size_t i = 0; i < session.series.size(); ++i) {
    const SourceSeries& source = session.series[i];
    bool counter = true;
    for (const energy::SessionSource& listed : session.session.info.sources) {
      if (listed.info.name == source.name) counter = listed.info.is_counter;
    }
    Series series;
    series.history = history_of(counter);
    for (const PowerPoint& point : source.points) append(series, point);
    series_.emplace(static_cast<std::uint32_t>(i), std::move(series));
  }
}

std::vector<ui::PowerSeriesView> PowerPlots::views(const OpenedSession& session) const {
  std::vector<ui::PowerSeriesView> views;
  for (std::size_t i = 0; i < session.series.size(); ++i) {
    const SourceSeries& source = session.series[i];
    ui::PowerSeriesView view;
    view.name = source.name;
    for (const energy::SessionSource& listed : session.session.info.sources) {
      if (listed.info.name == source.name) view.includes = listed.info.includes;
    }
    view.provenance = source.provenance;
    view.in_total = source.in_total;
    const auto found = series_.find(static_cast<std::uint32_t>(i));
    if (found != series_.end()) view.history = found->second.history.get();
    views.push_back(std::move(view));
  }
  return views;
}

}  // namespace encore::app
