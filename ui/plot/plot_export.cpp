#include "ui/plot/plot_export.h"

#include "energy/csv.h"

#include <fmt/format.h>

#include <initializer_list>
#include <string_view>

namespace encore::ui {

namespace {

using energy::csv_field;
using energy::csv_number;

void add_row(std::string& text, std::initializer_list<std::string> fields) {
  bool first = true;
  for (const std::string& field : fields) {
    if (!first) text += ',';
    first = false;
    text += csv_field(field);
  }
  text += '\n';
}

std::string number(double value) {
  return csv_number(value);
}
std::string count(std::uint64_t value) {
  return fmt::format("{}", value);
}
std::string origin(const energy::Provenance& provenance) {
  return std::string(energy::to_string(provenance.origin));
}
/// A float's own shortest digits: 0.1 and not 0.10000000149.
std::string single(float value) {
  return fmt::format("{}", value);
}

bool shown(const StripSeries& series, const StripState& state) {
  return series.history != nullptr && !state.hidden.contains(series.name);
}

}  // namespace

std::string strip_csv(const StripData& data, const StripState& state, std::size_t most) {
  const std::string& u = data.unit;
  std::string text;
  add_row(text, {"series", "provenance", "from_s", "to_s", "samples", "changed", "first_" + u,
                 "last_" + u, "mean_" + u, "min_" + u, "max_" + u, "low_" + u, "high_" + u,
                 "integral_" + data.integral_unit, "covered_s"});
  for (const StripSeries& series : data.series) {
    if (!shown(series, state)) continue;
    for (const Bucket& b : series.history->between(state.x.low, state.x.high, most)) {
      const bool covered = b.covered > 0.0;
      add_row(text, {series.name, origin(series.provenance), number(b.t0), number(b.t1),
                     count(b.count), count(b.changed), single(b.first), single(b.last),
                     number(b.mean()), single(b.min), single(b.max), single(b.low), single(b.high),
                     covered ? number(b.integral) : "", number(b.covered)});
    }
  }
  return text;
}

std::string selection_csv(const StripData& data, StripState& state) {
  const std::string& u = data.unit;
  std::string text;
  add_row(text, {"series",
                 "provenance",
                 "from_s",
                 "to_s",
                 "samples",
                 "changed",
                 "time_mean_" + u,
                 "mean_" + u,
                 "min_" + u,
                 "p5_" + u,
                 "p25_" + u,
                 "median_" + u,
                 "p75_" + u,
                 "p95_" + u,
                 "p99_" + u,
                 "max_" + u,
                 "integral_" + data.integral_unit,
                 "covered_s",
                 "without_data_s",
                 "approximate"});
  for (const StripSeries& series : data.series) {
    if (!shown(series, state)) continue;
    const auto s = selection_statistics(*series.history, state);
    if (!s) continue;
    add_row(text, {series.name,
                   origin(series.provenance),
                   number(s->t0),
                   number(s->t1),
                   count(s->samples),
                   count(s->changes),
                   csv_number(s->time_mean),
                   number(s->mean),
                   number(s->min),
                   number(s->p5),
                   number(s->p25),
                   number(s->median),
                   number(s->p75),
                   number(s->p95),
                   number(s->p99),
                   number(s->max),
                   csv_number(s->integral),
                   number(s->covered_s),
                   number(s->without_data_s),
                   s->approximate ? "true" : "false"});
  }
  return text;
}

std::string bars_csv(const BarData& data) {
  std::string text;
  add_row(text, {"group", "bar", "part", "value", "ci95", "unit", "provenance", "detail"});
  for (const BarGroup& group : data.groups) {
    for (const Bar& bar : group.bars) {
      for (const BarPart& part : bar.parts) {
        add_row(text, {group.label, bar.name, part.name, csv_number(part.value),
                       csv_number(part.half_width), bar.unit, origin(part.provenance),
                       part.provenance.detail});
      }
    }
  }
  return text;
}

std::string errors_csv(const ErrorData& data) {
  std::string text;
  add_row(text, {"series", "elapsed_s", "relative_ci95", "effective_samples", "provenance"});
  for (const ErrorSeries& series : data.series) {
    for (const ErrorSample& point : series.points) {
      add_row(text, {series.name, number(point.elapsed_s), csv_number(point.relative_ci95),
                     csv_number(point.samples), origin(series.provenance)});
    }
  }
  return text;
}

}  // namespace encore::ui
