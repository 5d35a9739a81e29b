#include "app/compare.h"

#include "app/session_input.h"
#include "energy/student_t.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace encore::app {

namespace {

using energy::KeyValue;
using energy::SummaryRow;

/// The repeats of one configuration in one session.
struct Group {
  std::vector<KeyValue> identity;
  std::vector<const SummaryRow*> rows;
};

std::vector<Group> groups_of(const energy::Session& session) {
  std::vector<Group> groups;
  for (const SummaryRow& row : session.summaries) {
    std::vector<KeyValue> identity = configuration_identity(row.configuration);
    const auto same = std::find_if(groups.begin(), groups.end(),
                                   [&](const Group& group) { return group.identity == identity; });
    if (same == groups.end()) {
      groups.push_back({std::move(identity), {&row}});
    } else {
      same->rows.push_back(&row);
    }
  }
  return groups;
}

/// The figures that are compared.
std::optional<RunFigure> seconds_of(const SummaryRow& row) {
  if (!(row.mean.value > 0.0)) return std::nullopt;
  RunFigure figure{row.mean.value, {}, {}};
  if (row.ci95) figure.half_width = row.ci95->value;
  return figure;
}
std::optional<RunFigure> watts_of(const SummaryRow& row) {
  if (!row.watts || !(row.watts->value > 0.0)) return std::nullopt;
  RunFigure figure{row.watts->value, {}, {}};
  if (row.watts_ci95) figure.half_width = row.watts_ci95->value;
  if (row.watts_ci95_without_gain) figure.without_gain = row.watts_ci95_without_gain->value;
  return figure;
}
std::optional<RunFigure> joules_of(const SummaryRow& row) {
  if (!row.joules || !(row.joules->value > 0.0)) return std::nullopt;
  RunFigure figure{row.joules->value, {}, {}};
  if (row.joules_ci95) figure.half_width = row.joules_ci95->value;
  if (row.joules_ci95_without_gain) figure.without_gain = row.joules_ci95_without_gain->value;
  return figure;
}
using FigureOf = std::optional<RunFigure> (*)(const SummaryRow&);

/// One figure of all repeats; empty if one lacks it.
std::vector<RunFigure> figures_of(const Group& group, FigureOf figure_of) {
  std::vector<RunFigure> figures;
  for (const SummaryRow* row : group.rows) {
    const auto figure = figure_of(*row);
    if (!figure) return {};
    figures.push_back(*figure);
  }
  return figures;
}

RunSpread spread_of(const std::vector<Group>& a, const std::vector<Group>& b, FigureOf figure_of) {
  std::vector<std::vector<RunFigure>> groups;
  for (const auto* session : {&a, &b}) {
    for (const Group& group : *session) groups.push_back(figures_of(group, figure_of));
  }
  return pool_spread(groups);
}

double log_mean(std::span<const RunFigure> figures) {
  double sum = 0.0;
  for (const RunFigure& figure : figures) sum += std::log(figure.value);
  return sum / static_cast<double>(figures.size());
}

/// Half-width of the log mean by the runs' own intervals; nothing if one has none.
std::optional<double> own_half_width(std::span<const RunFigure> figures) {
  double squares = 0.0;
  for (const RunFigure& figure : figures) {
    if (!figure.half_width) return std::nullopt;
    squares += std::pow(*figure.half_width / figure.value, 2);
  }
  return std::sqrt(squares) / static_cast<double>(figures.size());
}

/// Compares what only sensors tell.
class EnergyComparison {
 public:
  EnergyComparison(const energy::SessionInfo& a, const energy::SessionInfo& b)
      : a_(a), b_(b), same_sensor_(same_sensor(a, b)) {}

  /// Nothing unless both sessions have the figure, from the same kind of origin.
  [[nodiscard]] std::optional<FigureChange> change(const Group& a, const Group& b,
                                                   FigureOf figure_of, const RunSpread& spread,
                                                   std::optional<double> tolerance) const {
    if (a.rows.front()->origin != b.rows.front()->origin) return std::nullopt;
    const auto of_a = figures(a, a_, figure_of);
    const auto of_b = figures(b, b_, figure_of);
    if (of_a.empty() || of_b.empty()) return std::nullopt;
    return change_of(of_a, of_b, spread, tolerance);
  }

 private:
  /// The gain error of one sensor is the same in both sessions, and leaves their ratio alone.
  [[nodiscard]] std::vector<RunFigure> figures(const Group& group, const energy::SessionInfo& info,
                                               FigureOf figure_of) const {
    std::vector<RunFigure> figures = figures_of(group, figure_of);
    for (RunFigure& figure : figures) {
      if (!same_sensor_ || !figure.half_width) continue;
      figure.half_width = figure.without_gain
                              ? *figure.without_gain
                              : without_gain(info, figure.value, *figure.half_width);
    }
    return figures;
  }

  const energy::SessionInfo& a_;
  const energy::SessionInfo& b_;
  bool same_sensor_;
};

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::lower:
      return "lower";
    case Verdict::higher:
      return "higher";
    case Verdict::noise:
      return "noise";
    case Verdict::unknown:
      return "unknown";
  }
  return "unknown";
}

RunSpread pool_spread(std::span<const std::vector<RunFigure>> groups) {
  RunSpread spread;
  double squares = 0.0;
  for (const auto& group : groups) {
    if (group.size() < 2) continue;
    const double mean = log_mean(group);
    for (const RunFigure& figure : group) squares += std::pow(std::log(figure.value) - mean, 2);
    spread.degrees_of_freedom += group.size() - 1;
  }
  if (spread.degrees_of_freedom > 0) {
    spread.deviation = std::sqrt(squares / static_cast<double>(spread.degrees_of_freedom));
  }
  return spread;
}

FigureChange change_of(std::span<const RunFigure> a, std::span<const RunFigure> b,
                       const RunSpread& spread, std::optional<double> tolerance) {
  FigureChange change;
  const double log_a = log_mean(a);
  const double log_b = log_mean(b);
  change.a = std::exp(log_a);
  change.b = std::exp(log_b);
  change.ratio = std::exp(log_b - log_a);

  std::optional<double> half;
  const auto own_a = own_half_width(a);
  const auto own_b = own_half_width(b);
  if (own_a && own_b) half = std::hypot(*own_a, *own_b);
  if (spread.degrees_of_freedom > 0) {
    const double t =
        energy::student_t_quantile(0.975, static_cast<double>(spread.degrees_of_freedom));
    const double between =
        t * spread.deviation *
        std::sqrt(1.0 / static_cast<double>(a.size()) + 1.0 / static_cast<double>(b.size()));
    half = std::max(half.value_or(0.0), between);
  }
  if (!half) return change;

  change.low = std::exp(log_b - log_a - *half);
  change.high = std::exp(log_b - log_a + *half);
  change.verdict = Verdict::noise;
  if (*change.high < 1.0) change.verdict = Verdict::lower;
  if (*change.low > 1.0) change.verdict = Verdict::higher;
  change.regression = tolerance && *change.low > 1.0 + *tolerance;
  return change;
}

std::size_t Comparison::regressions() const {
  return static_cast<std::size_t>(
      std::count_if(matched.begin(), matched.end(), [](const ConfigurationChange& change) {
        return change.seconds.regression || (change.joules && change.joules->regression);
      }));
}

Comparison compare_sessions(const energy::Session& a, const energy::Session& b,
                            std::optional<double> tolerance) {
  const std::vector<Group> groups_a = groups_of(a);
  const std::vector<Group> groups_b = groups_of(b);
  Comparison comparison;
  comparison.warnings = differences_of(a.info, b.info);
  comparison.same_sensor = same_sensor(a.info, b.info);
  comparison.time_spread = spread_of(groups_a, groups_b, seconds_of);
  const RunSpread watts_spread = spread_of(groups_a, groups_b, watts_of);
  const RunSpread joules_spread = spread_of(groups_a, groups_b, joules_of);
  const EnergyComparison energies(a.info, b.info);

  std::vector<bool> taken(groups_b.size(), false);
  for (const Group& group : groups_a) {
    const auto other = std::find_if(groups_b.begin(), groups_b.end(), [&](const Group& candidate) {
      return candidate.identity == group.identity;
    });
    if (other == groups_b.end()) {
      comparison.only_a.push_back(group.identity);
      continue;
    }
    taken[static_cast<std::size_t>(other - groups_b.begin())] = true;
    const auto seconds_a = figures_of(group, seconds_of);
    const auto seconds_b = figures_of(*other, seconds_of);
    if (seconds_a.empty() || seconds_b.empty()) {
      comparison.warnings.push_back(configuration_name(group.identity) + " took no time");
      continue;
    }
    const auto triangles = [](const Group& of) {
      return configuration_value(of.rows.front()->configuration, "triangles");
    };
    if (triangles(group) != triangles(*other)) {
      comparison.warnings.push_back(fmt::format("{}: {} triangles in A, {} in B",
                                                configuration_name(group.identity),
                                                triangles(group), triangles(*other)));
    }
    comparison.matched.push_back(
        {group.identity, group.rows.size(), other->rows.size(),
         change_of(seconds_a, seconds_b, comparison.time_spread, tolerance),
         energies.change(group, *other, watts_of, watts_spread, std::nullopt),
         energies.change(group, *other, joules_of, joules_spread, tolerance)});
  }
  for (std::size_t i = 0; i < groups_b.size(); ++i) {
    if (!taken[i]) comparison.only_b.push_back(groups_b[i].identity);
  }
  return comparison;
}

}  // namespace encore::app
