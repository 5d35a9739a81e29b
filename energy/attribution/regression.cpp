#include "energy/attribution/regression.h"

#include "energy/attribution/coloured_fit.h"
#include "energy/attribution/identifiability.h"
#include "energy/attribution/windows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace encore::energy {

namespace {

/// Fewer updates than this a column (idle included) do not make a fit.
constexpr std::size_t kLeastRowsEach = 20;
/// Time without a phase below this share of all is none: idle power cannot be seen.
constexpr double kLeastIdleShare = 0.01;

/// An interaction below this share of the largest coefficient matters to nobody.
constexpr double kLeastInteraction = 1e-3;

/// Whether an interaction is there and matters.
bool is_certain(const ColouredFit& fit, std::size_t column) {
  double largest = 0.0;
  for (const double x : fit.x) largest = std::max(largest, std::fabs(x));
  const double size = std::fabs(fit.x[column]);
  return size > fit.half_widths[column] && size > kLeastInteraction * largest;
}

/// Without the sensor's gain.
Uncertain by_chance(double value, double half_width) {
  return {.value = value, .half_width = half_width, .statistical = half_width};
}

/// The fit of one source while it is being made.
class Regression {
 public:
  Regression(const SourceInfo& info, const TraceView& trace, const BusyTimeline& timeline,
             const std::vector<Window>& idle, const std::vector<Window>& loaded);
  PhaseFit run();

 private:
  void choose_lag();
  void choose_kernel();
  [[nodiscard]] FitRows rows_of(const std::vector<Activity>& activities) const;
  [[nodiscard]] bool has_enough_rows();
  void drop_unseen();
  [[nodiscard]] bool judge();
  [[nodiscard]] bool merge(const std::vector<std::size_t>& alike);
  [[nodiscard]] bool idle_is_unseen() const;
  void refuse(const std::string& why);
  void weigh_rows();
  void try_interactions();
  void fit();
  void store(const ColouredFit& all, const std::vector<bool>& stopped);

  const SourceInfo& info_;
  const TraceView& trace_;
  std::vector<Window> windows_;
  Colour colour_;
  std::vector<std::string> all_names_;
  std::vector<std::size_t> columns_;  ///< of the timeline, those that ran
  std::vector<std::string> names_;    ///< of the fit's columns, "idle" last
  /// Of `columns_`, those that are one column of the fit since nothing tells them apart; empty:
  /// each stands alone.
  std::vector<std::vector<std::size_t>> groups_;
  std::vector<Activity> activities_;  ///< of the fit's columns but idle
  double lag_ = 0.0;
  GaugeKernel kernel_;
  double period_ = 0.0;  ///< of a gauge's updates
  bool with_idle_ = true;
  FitRows rows_;
  PhaseFit result_;
};

Regression::Regression(const SourceInfo& info, const TraceView& trace, const BusyTimeline& timeline,
                       const std::vector<Window>& idle, const std::vector<Window>& loaded)
    : info_(info),
      trace_(trace),
      colour_(info.is_counter ? Colour::edges_and_walk : Colour::autoregressive),
      all_names_(timeline.columns()) {
  windows_ = idle;
  windows_.insert(windows_.end(), loaded.begin(), loaded.end());
  windows_ = join_windows(std::move(windows_));
  result_.phases.resize(all_names_.size());
  for (std::size_t c = 0; c < all_names_.size(); ++c) {
    Seconds busy;
    for (const Window& w : windows_) busy += timeline.busy(c, w.from, w.to);
    if (!(busy.value > 0.0)) {
      result_.phases[c].reason = all_names_[c] + " did not run";
      continue;
    }
    columns_.push_back(c);
    names_.push_back(all_names_[c]);
    // Also what ran before the first window: a slow sensor still shows it.
    activities_.push_back(timeline.pieces(c, Seconds(-INFINITY), windows_.back().to));
  }
  names_.emplace_back("idle");
}

FitRows Regression::rows_of(const std::vector<Activity>& activities) const {
  FitRows rows = info_.is_counter ? counter_rows(info_, trace_, activities, windows_, lag_)
                                  : gauge_rows(trace_, activities, windows_, kernel_,
                                               kernel_.settling(), period_);
  if (!with_idle_) {
    std::vector<bool> keep(rows.columns.columns(), true);
    keep.back() = false;
    rows.columns = rows.columns.select(keep);
    rows.timing = rows.timing.select(keep);
  }
  return groups_.empty() ? rows : merge_columns(rows, groups_);
}

void Regression::choose_lag() {
  // Sensors differ in whether a counter's value is fresh when it is read.
  std::optional<double> best;
  for (const double lag : {0.0, 0.5}) {
    const auto rows = counter_rows(info_, trace_, activities_, windows_, lag);
    const auto fit = guess(rows, colour_);
    if (!fit || (best && fit->log_likelihood <= *best)) continue;
    best = fit->log_likelihood;
    lag_ = lag;
  }
}

void Regression::choose_kernel() {
  const auto observed = trace_.observed_period();
  period_ = observed ? observed->median.value : info_.update_period.value;
  if (info_.smoothing.value > 0.0) {
    kernel_.smoothing = info_.smoothing.value;
    return;
  }
  std::vector<GaugeKernel> kernels;
  for (const double periods : {1.0, 0.25, 0.01}) kernels.push_back({.window = periods * period_});
  kernels.push_back({.window = info_.update_period.value});
  // Some graphics cards show the mean of a second, ten times a second.
  if (period_ < 0.2) kernels.push_back({.window = 1.0});
  for (const double periods : {1.0, 4.0}) kernels.push_back({.smoothing = periods * period_});
  kernel_ = kernels.front();
  // All are compared over the same updates.
  const double settling = kernels.back().settling();
  std::optional<double> best;
  for (const GaugeKernel& kernel : kernels) {
    const auto fit =
        guess(gauge_rows(trace_, activities_, windows_, kernel, settling, period_), colour_);
    if (!fit || (best && fit->log_likelihood <= *best)) continue;
    best = fit->log_likelihood;
    kernel_ = kernel;
  }
  if (!best) return;
  result_.notes.push_back(fmt::format(
      "the gauge's own averaging is not known: {} of {:.3g} s fits best",
      kernel_.smoothing > 0.0 ? "smoothing with a time constant" : "a mean over windows",
      kernel_.smoothing > 0.0 ? kernel_.smoothing : kernel_.window));
}

void Regression::refuse(const std::string& why) {
  result_.refused = true;
  result_.idle_watts.reset();
  result_.notes.push_back(why);
  for (const std::size_t c : columns_) result_.phases[c].reason = why;
}

bool Regression::has_enough_rows() {
  const std::size_t needed = kLeastRowsEach * names_.size();
  if (rows_.size() >= needed) return true;
  refuse(fmt::format(
      "{}: {} updates for {} unknowns are too few: measure for at least {} update periods ({:.3g} "
      "s)",
      info_.name, rows_.size(), names_.size(), needed,
      static_cast<double>(needed) *
          std::max(info_.update_period.value, info_.is_counter ? info_.poll_period.value : 0.0)));
  return false;
}

/// Takes out the columns that no row saw: they ran before the first update or after the last.
void Regression::drop_unseen() {
  for (std::size_t c = columns_.size(); c-- > 0;) {
    if (norm(rows_.columns.column(c)) > 0.0) continue;
    result_.phases[columns_[c]].reason =
        names_[c] + " ran only where no two updates of the sensor enclose it";
    const auto at = static_cast<std::ptrdiff_t>(c);
    columns_.erase(columns_.begin() + at);
    names_.erase(names_.begin() + at);
    activities_.erase(activities_.begin() + at);
  }
  rows_ = rows_of(activities_);
}

bool Regression::idle_is_unseen() const {
  const std::size_t idle = rows_.columns.columns() - 1;
  std::vector<double> outside(rows_.columns.column(idle).begin(), rows_.columns.column(idle).end());
  for (std::size_t c = 0; c < idle; ++c) {
    for (std::size_t i = 0; i < outside.size(); ++i) outside[i] -= rows_.columns(i, c);
  }
  return norm(outside) < kLeastIdleShare * norm(rows_.columns.column(idle));
}

/// Makes two phases one column, if some other phase then still stands alone.
bool Regression::merge(const std::vector<std::size_t>& alike) {
  auto groups = join_pair(groups_, columns_.size(), alike);
  if (!groups) return false;
  groups_ = std::move(*groups);
  const auto [a, b] = std::minmax(alike[0], alike[1]);
  names_[a] += " and " + names_[b];
  names_.erase(names_.begin() + static_cast<std::ptrdiff_t>(b));
  rows_ = rows_of(activities_);
  return true;
}

/// The gate. False if the fit was refused.
bool Regression::judge() {
  if (!columns_.empty() && idle_is_unseen()) {
    with_idle_ = false;
    names_.pop_back();
    rows_ = rows_of(activities_);
    result_.notes.emplace_back(
        "there was no time without a phase: idle power is part of the phases' watts");
  }
  const std::string way_out =
      "vary the mix of phases in blocks of five update periods or more, with idle time between";
  while (true) {
    Identifiability found = identifiability(rows_);
    result_.condition = found.condition;
    phases_first(found, groups_.empty() ? columns_.size() : groups_.size());
    const std::string why = refusal(found, names_);
    if (why.empty()) {
      for (const auto& set : found.alike) result_.notes.push_back(describe(set, names_, false));
      break;
    }
    const bool by_mix = !(found.condition <= kWorstCondition) && !found.alike.empty();
    if (by_mix && merge(found.alike.front())) {
      result_.notes.push_back(why);
      continue;
    }
    refuse(why);
    result_.notes.push_back(way_out);
    return false;
  }
  if (!groups_.empty()) result_.notes.push_back(way_out);
  if (result_.condition > kSoundCondition) {
    result_.notes.push_back(
        fmt::format("the mix of phases varied little (condition {:.0f}, sound below {:.0f}): "
                    "intervals are wide",
                    result_.condition, kSoundCondition));
  }
  return true;
}

void Regression::weigh_rows() {
  for (int round = 0; round < 2; ++round) {
    const auto first = guess(rows_, colour_);
    if (!first) return;
    weigh(rows_, first->x, info_.energy_step.value_or(Joules(0)).value);
  }
}

void Regression::try_interactions() {
  // Where phases are alike, so is what they do to each other.
  const std::size_t phases = groups_.empty() ? columns_.size() : 0;
  for (std::size_t a = 0; a < phases; ++a) {
    for (std::size_t b = a + 1; b < phases; ++b) {
      const Activity both = concurrent(activities_[a], activities_[b]);
      if (both.empty()) continue;
      std::vector<Activity> more = activities_;
      more.push_back(both);
      FitRows rows = rows_of(more);
      if (!(identifiability(rows).condition <= kSoundCondition)) continue;
      std::swap(rows_, rows);
      weigh_rows();
      const auto fit = fit_coloured(rows_, colour_);
      const std::size_t column = more.size() - 1;
      if (!fit || !is_certain(*fit, column)) {
        std::swap(rows_, rows);
        continue;
      }
      activities_ = std::move(more);
      names_.insert(names_.begin() + static_cast<std::ptrdiff_t>(column),
                    names_[a] + " with " + names_[b]);
      result_.notes.push_back(
          fmt::format("{} and {} at once draw {:.3g} +- {:.2g} W {} than each alone", names_[a],
                      names_[b], std::fabs(fit->x[column]), fit->half_widths[column],
                      fit->x[column] > 0 ? "more" : "less"));
    }
  }
}

/// Coefficients, those that stop at 0 taken out until none of the others is negative.
void Regression::fit() {
  const auto all = fit_coloured(rows_, colour_);
  if (!all) {
    refuse(info_.name + ": the phases depend on each other in time: cannot be told apart");
    return;
  }
  result_.durbin_watson = all->durbin_watson;
  if (info_.is_counter && all->durbin_watson < 1.0) {
    result_.notes.push_back(
        fmt::format("the power itself fluctuates (Durbin-Watson {:.2f}): the fit leans on the "
                    "differences between updates",
                    all->durbin_watson));
  }
  const std::size_t phases = groups_.empty() ? columns_.size() : groups_.size();
  std::vector<bool> stopped(rows_.columns.columns(), false);
  ColouredFit found = *all;
  const auto negative = [&] {
    for (std::size_t c = 0; c < phases; ++c) {
      if (!stopped[c] && found.x[c] < 0.0) return true;
    }
    return false;
  };
  if (negative()) {
    std::vector<bool> free(stopped.size(), true);
    std::fill_n(free.begin(), phases, false);
    stopped = stopped_at_zero(rows_, colour_, free);
  }
  while (true) {
    // The mean over colours can still be negative where the likeliest colour's fit is not.
    for (std::size_t c = 0; c < phases; ++c) stopped[c] = stopped[c] || found.x[c] < 0.0;
    const auto kept = static_cast<std::size_t>(std::count(stopped.begin(), stopped.end(), false));
    if (kept == stopped.size() || kept == 0) break;
    FitRows part = rows_;
    std::vector<bool> keep = stopped;
    keep.flip();
    part.columns = rows_.columns.select(keep);
    const auto bounded = fit_coloured(part, colour_);
    if (!bounded) break;
    std::size_t next = 0;
    for (std::size_t c = 0; c < stopped.size(); ++c) {
      found.x[c] = stopped[c] ? 0.0 : bounded->x[next];
      found.half_widths[c] = stopped[c] ? all->half_widths[c] : bounded->half_widths[next];
      if (!stopped[c]) ++next;
    }
    if (!negative()) break;
  }
  store(found, stopped);
}

void Regression::store(const ColouredFit& all, const std::vector<bool>& stopped) {
  if (groups_.empty()) {
    for (std::size_t c = 0; c < columns_.size(); ++c) groups_.push_back({c});
  }
  for (std::size_t c = 0; c < groups_.size(); ++c) {
    const double half_width = all.half_widths[c];
    for (const std::size_t member : groups_[c]) {
      PhaseCoefficient& phase = result_.phases[columns_[member]];
      if (groups_[c].size() > 1) {
        phase.reason = fmt::format(
            "{} always ran in the same proportion: cannot be told apart; together {:.3g} +- {:.2g} "
            "W{}",
            names_[c], stopped[c] ? 0.0 : all.x[c], half_width, with_idle_ ? " above idle" : "");
        continue;
      }
      phase.at_bound = stopped[c];
      phase.watts = by_chance(stopped[c] ? 0.0 : all.x[c], half_width);
      if (stopped[c]) {
        phase.reason = fmt::format("{} draws at most {:.3g} W above idle: nothing more can be seen",
                                   names_[c], half_width);
      }
    }
  }
  if (with_idle_) result_.idle_watts = by_chance(all.x.back(), all.half_widths.back());
}

PhaseFit Regression::run() {
  if (windows_.empty() || trace_.empty()) {
    refuse(info_.name + ": no readings inside the windows");
    return std::move(result_);
  }
  if (info_.is_counter) {
    choose_lag();
  } else {
    choose_kernel();
  }
  rows_ = rows_of(activities_);
  if (!has_enough_rows()) return std::move(result_);
  drop_unseen();
  if (!judge()) return std::move(result_);
  weigh_rows();
  try_interactions();
  fit();
  return std::move(result_);
}

}  // namespace

PhaseFit fit_phases(const SourceInfo& info, const TraceView& trace, const BusyTimeline& timeline,
                    const std::vector<Window>& idle, const std::vector<Window>& loaded) {
  return Regression(info, trace, timeline, idle, loaded).run();
}

}  // namespace encore::energy
