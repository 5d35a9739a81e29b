#include "energy/attribution/attribution.h"

#include "energy/attribution/batches.h"
#include "energy/attribution/gauge_updates.h"
#include "energy/attribution/idle_baseline.h"
#include "energy/attribution/pure_windows.h"
#include "energy/attribution/regression.h"
#include "energy/attribution/windows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace encore::energy {

namespace {

/// A phase whose busy time fills so much of the windows is all that there is.
constexpr double kWholeShare = 0.95;
/// So much of a phase's time must lie outside of other phases' for it to be read at its edges.
constexpr double kPureShare = 0.95;
/// Read at its edges, a phase must be known at least so well, or the regression is asked.
constexpr double kGoodEdges = 0.2;
/// ... and seen for so much of its time.
constexpr double kGoodCover = 0.75;

/// The mean power of a gauge over windows in which phases took turns that it can resolve: phase by
/// phase, since the step between two of them is no scatter. Nothing unless they fill the windows.
std::optional<MeanPower> mean_by_phase(const AttributionInput& in,
                                       const std::vector<Window>& measured) {
  MeanPower mean;
  std::vector<Chance> chances;
  std::string why;
  for (std::size_t column = 0; column < in.busy->columns().size(); ++column) {
    const std::vector<Window> pure = pure_windows(*in.busy, column, measured);
    if (pure.empty()) continue;
    const auto phase = mean_power(*in.source, in.trace, pure, why);
    if (!phase) return std::nullopt;
    mean.watts += phase->watts * phase->length.value;
    mean.length += phase->length;
    mean.covered += phase->covered;
    mean.effective_samples += phase->effective_samples;
    chances.push_back(phase->realised.scaled(phase->length.value));
  }
  if (chances.size() < 2 || mean.length < length_of(measured) * kWholeShare) return std::nullopt;
  mean.watts /= mean.length.value;
  mean.realised = mean.long_run = combined(chances).scaled(1.0 / mean.length.value);
  mean.length = length_of(measured);
  return mean;
}

/// Finds one configuration's figures by one source, step by step.
class Attributor {
 public:
  explicit Attributor(const AttributionInput& input)
      : in_(input), source_(*input.source), measured_(join_windows(input.measured)) {}

  Attribution run() {
    out_.length = length_of(measured_);
    if (in_.busy) {
      for (const Window& w : measured_) out_.operations += in_.busy->operations(w.from, w.to);
    }
    find_totals();
    find_net();
    if (in_.busy) find_phases();
    find_remainder();
    return std::move(out_);
  }

 private:
  void find_totals() {
    std::string why;
    if (!source_.is_counter && in_.busy) total_ = mean_by_phase(in_, measured_);
    if (!total_) total_ = mean_power(source_, in_.trace, measured_, why);
    if (in_.cut_below && !source_.is_counter) cut();
    note_gaps();
    if (!total_) {
      out_.notes.push_back(why);
      return;
    }
    const double length = out_.length.value;
    const double gain = source_.gain_uncertainty;
    out_.watts = with_gain(total_->watts, total_->realised.half_width, gain);
    out_.gross = with_gain(total_->watts * length, total_->realised.half_width * length, gain);
    out_.effective_samples = total_->effective_samples;
    if (out_.operations <= 0) return;
    const double each = out_.gross->value / out_.operations;
    // A counter's batches hold both fluctuations, of power and of time an operation.
    const auto batches = source_.is_counter ? batches_of(source_, in_.trace, in_.busy, measured_)
                                            : time_batches_of(*in_.busy, measured_);
    Chance chance = total_->long_run.scaled(length / out_.operations);
    if (!batches) {
      out_.notes.push_back(
          "the windows are too short to tell how much the load fluctuates within "
          "them; repeats tell it");
    } else {
      const std::array<Chance, 2> parts{
          source_.is_counter ? total_->realised.scaled(length / out_.operations) : chance,
          batches->relative.scaled(each)};
      chance = combined(parts);
    }
    out_.per_operation = with_gain(each, chance.half_width, gain);
  }

  /// Puts the cut mean in the place of the settled one, and tells both.
  void cut() {
    std::vector<Window> windows = measured_;
    windows.insert(windows.end(), in_.idle.begin(), in_.idle.end());
    windows = join_windows(std::move(windows));
    auto mean = mean_of_updates(source_, gauge_period(source_, in_.trace),
                                cut_updates(source_, in_.trace, windows, *in_.cut_below));
    if (!mean) {
      out_.notes.push_back(fmt::format("{} has too few updates of at least {:.4g} W for the cut",
                                       source_.name, in_.cut_below->value));
      return;
    }
    mean->length = length_of(measured_);
    const std::string settled =
        total_ ? fmt::format("{:.4g} ± {:.2g} W", total_->watts, total_->realised.half_width)
               : std::string("unknown");
    out_.notes.push_back(fmt::format(
        "{}: {:.4g} ± {:.2g} W by the cut below {:.4g} W, which is biased; by settled updates {}",
        source_.name, mean->watts, mean->realised.half_width, in_.cut_below->value, settled));
    total_ = mean;
  }

  void note_gaps() {
    const std::vector<TracePoint>& points = in_.trace.points();
    Seconds gaps;
    for (const Window& w : measured_) {
      for (std::size_t i = std::max<std::size_t>(1, in_.trace.first_at_or_after(w.from));
           i < points.size() && points[i - 1].time < w.to; ++i) {
        if (!points[i].starts_stretch) continue;
        gaps += std::min(points[i].time, w.to) - std::max(points[i - 1].time, w.from);
      }
      // A source that came late or was lost.
      if (points.empty()) continue;
      const Seconds usual = source_.poll_period * 2.0 + source_.update_period;
      const Seconds late = points.front().time - w.from;
      const Seconds lost = w.to - points.back().time;
      for (const Seconds missing : {late, lost}) {
        if (missing > usual) gaps += std::min(missing, w.to - w.from);
      }
    }
    if (gaps.value > 0) {
      out_.notes.push_back(fmt::format(
          "{} gave no value in {:.3g} s of the measured windows; the power of the rest is "
          "taken for them",
          source_.name, gaps.value));
    }
  }

  void find_net() {
    if (measured_.empty()) return;
    std::string why;
    const Seconds middle = (measured_.front().from + measured_.back().to) * 0.5;
    idle_ = idle_baseline(source_, in_.trace, in_.idle, middle, why);
    if (!idle_) {
      out_.notes.push_back("no net energy: " + why);
      return;
    }
    out_.idle = idle_->baseline;
    if (out_.idle->drifted) {
      out_.notes.push_back(fmt::format(
          "idle power drifted by {:+.3g} W from before to after, more than chance explains; let "
          "the machine warm up first, or measure in shorter pairs of idle and load",
          out_.idle->drift->value));
    }
    if (!out_.gross) return;
    const double length = out_.length.value;
    out_.net =
        with_gain(out_.gross->value - out_.idle->watts.value * length,
                  above_idle(total_->realised).half_width * length, source_.gain_uncertainty);
  }

  [[nodiscard]] Chance above_idle(const Chance& power) const {
    const std::array<Chance, 2> parts{power, idle_->chance};
    return combined(parts);
  }

  void find_phases() {
    double busy_sum = 0.0;
    for (std::size_t column = 0; column < in_.busy->columns().size(); ++column) {
      const Seconds busy = busy_in(*in_.busy, column, measured_);
      if (busy.value <= 0) continue;
      PhaseEnergy phase;
      phase.column = in_.busy->columns()[column];
      phase.busy = busy;
      phase.count = out_.operations;
      busy_sum += busy.value;
      columns_.push_back(column);
      out_.phases.push_back(std::move(phase));
    }
    if (out_.phases.empty()) return;
    const double share = share_ = busy_sum / out_.length.value;
    if (std::fabs(share - 1.0) > 0.05) {
      out_.notes.push_back(
          fmt::format("the phases' times sum to {:.3g} times the measured time: {}", share,
                      share > 1.0 ? "they overlap, so they are not shares of the time"
                                  : "some of it belongs to none of them"));
    }
    if (!total_) {
      for (PhaseEnergy& phase : out_.phases) phase.reason = "the total is not known";
      return;
    }
    const bool alone = out_.phases.size() == 1;
    if (alone && share >= kWholeShare) return take_whole(out_.phases[0]);
    bool all_good = true;
    for (std::size_t i = 0; i < out_.phases.size(); ++i) {
      good_edges_.push_back(read_at_edges(out_.phases[i], columns_[i]));
      all_good = all_good && good_edges_.back();
    }
    if (!all_good) fit();
    if (alone && out_.phases[0].method == AttributionMethod::none) {
      take_whole(out_.phases[0]);
      out_.phases[0].reason =
          fmt::format("the phase ran in {:.0f} % of the measured time; {}", 100 * share,
                      out_.net ? "the rest is taken for idle" : "what ran in the rest counts, too");
    }
  }

  void take_whole(PhaseEnergy& phase) {
    phase.method = AttributionMethod::whole;
    if (!out_.net) {
      phase.watts = out_.watts;
      phase.gross = out_.gross;
      return;
    }
    // All that is above idle is the phase's, and none of the idle time between its spans.
    const double busy = phase.busy.value;
    const double idle = out_.idle->watts.value;
    const double half_width = std::hypot(out_.idle->watts.statistical * (1 / share_ - 1),
                                         total_->realised.half_width / share_);
    phase.net = out_.net;
    phase.watts = with_gain(idle + out_.net->value / busy, half_width, source_.gain_uncertainty);
    phase.gross = with_gain(phase.watts->value * busy, half_width * busy, source_.gain_uncertainty);
  }

  /// True if the phase's energy is known well enough that no fit need be asked.
  bool read_at_edges(PhaseEnergy& phase, std::size_t column) {
    const std::vector<Window> pure = pure_windows(*in_.busy, column, measured_);
    if (length_of(pure).value < kPureShare * phase.busy.value) {
      phase.reason = "it ran beside other phases or in turns too short to be told apart";
      return false;
    }
    const auto power = mean_power(source_, in_.trace, pure, phase.reason);
    if (!power) return false;
    const double busy = phase.busy.value;
    const double gain = source_.gain_uncertainty;
    phase.method = AttributionMethod::windows;
    phase.reason.clear();
    phase.watts = with_gain(power->watts, power->realised.half_width, gain);
    phase.gross = with_gain(power->watts * busy, power->realised.half_width * busy, gain);
    if (out_.idle) set_net(phase, out_.idle->watts);
    const bool covered = !source_.is_counter || power->covered >= power->length * kGoodCover;
    const bool good = covered && power->realised.half_width <= kGoodEdges * power->watts;
    if (!good) phase.reason = "its spans are short against the time between updates";
    return good;
  }

  /// Asks the regression for the phases that could not be read well at their edges.
  void fit() {
    std::vector<Window> loaded = in_.mixed;
    loaded.insert(loaded.end(), measured_.begin(), measured_.end());
    const PhaseFit fitted =
        fit_phases(source_, in_.trace, *in_.busy, in_.idle, join_windows(loaded));
    if (std::isfinite(fitted.condition)) out_.condition = fitted.condition;
    for (const std::string& note : fitted.notes) out_.notes.push_back(note);
    std::optional<Uncertain> idle = fitted.idle_watts;
    if (idle) idle->statistical = idle->half_width;
    if (out_.idle) idle = out_.idle->watts;
    bool used = false;
    for (std::size_t i = 0; i < out_.phases.size(); ++i) {
      PhaseEnergy& phase = out_.phases[i];
      if (good_edges_[i] || columns_[i] >= fitted.phases.size()) continue;
      const PhaseCoefficient& own = fitted.phases[columns_[i]];
      if (fitted.refused || !own.watts) {
        if (!phase.watts && !own.reason.empty()) phase.reason = own.reason;
        continue;
      }
      take_fitted(phase, own, idle, fitted.idle_watts.has_value());
      used = true;
    }
    if (!used || !idle) return;
    if (fitted.idle_watts) fitted_idle_ = idle;
    // Without idle windows, the fit's own baseline serves the other phases, too.
    for (PhaseEnergy& phase : out_.phases) {
      if (phase.watts && !phase.net) set_net(phase, *idle);
    }
  }

  void set_net(PhaseEnergy& phase, const Uncertain& idle) const {
    const double busy = phase.busy.value;
    phase.net = with_gain((phase.watts->value - idle.value) * busy,
                          std::hypot(phase.watts->statistical, idle.statistical) * busy,
                          source_.gain_uncertainty);
  }

  void take_fitted(PhaseEnergy& phase, const PhaseCoefficient& fitted,
                   const std::optional<Uncertain>& idle, bool above_idle) const {
    const double gain = source_.gain_uncertainty;
    double watts = fitted.watts->value;
    double half_width = fitted.watts->half_width;
    phase.method = AttributionMethod::regression;
    phase.reason = fitted.reason;
    phase.upper_bound_only = fitted.at_bound;
    phase.net.reset();
    if (above_idle) {
      phase.net = with_gain(watts * phase.busy.value, half_width * phase.busy.value, gain);
      watts += idle->value;
      half_width = std::hypot(half_width, idle->statistical);
    }
    phase.watts = with_gain(watts, half_width, gain);
    phase.gross = with_gain(watts * phase.busy.value, half_width * phase.busy.value, gain);
  }

  /// What phases and idle leave of the total, so that all parts sum to it exactly.
  void find_remainder() {
    if (!out_.gross || out_.phases.empty()) return;
    double rest = out_.gross->value;
    double squares = out_.gross->statistical * out_.gross->statistical;
    if (out_.phases[0].method == AttributionMethod::whole) {
      // The idle time between its spans.
      const double between = out_.gross->value - out_.phases[0].gross->value;
      const double own = out_.phases[0].gross->statistical;
      const bool none = std::fabs(between) <= 1e-12 * out_.gross->value;
      out_.remainder =
          none ? Uncertain{} : with_gain(between, own * (1 - share_), source_.gain_uncertainty);
      return;
    }
    if (fitted_idle_) {
      rest -= fitted_idle_->value * out_.length.value;
      const double half_width = fitted_idle_->statistical * out_.length.value;
      squares += half_width * half_width;
    }
    bool missing = false;
    for (const PhaseEnergy& phase : out_.phases) {
      const std::optional<Uncertain>& part = fitted_idle_ ? phase.net : phase.gross;
      missing = missing || !part;
      if (!part) continue;
      rest -= part->value;
      squares += part->statistical * part->statistical;
    }
    out_.remainder = with_gain(rest, std::sqrt(squares), source_.gain_uncertainty);
    if (missing) out_.notes.push_back("the remainder holds the phases that have no number");
  }

  const AttributionInput& in_;
  const SourceInfo& source_;
  std::vector<Window> measured_;
  Attribution out_;
  std::vector<bool> good_edges_;  ///< of out_.phases
  double share_ = 1.0;            ///< busy time by measured time, all phases together
  std::optional<MeanPower> total_;
  std::optional<IdleEstimate> idle_;
  std::vector<std::size_t> columns_;  ///< of out_.phases
  std::optional<Uncertain> fitted_idle_;
};

}  // namespace

std::string_view to_string(AttributionMethod method) {
  switch (method) {
    case AttributionMethod::whole:
      return "whole";
    case AttributionMethod::windows:
      return "windows";
    case AttributionMethod::regression:
      return "regression";
    case AttributionMethod::none:
      return "none";
  }
  return "";
}

Attribution attribute(const AttributionInput& input) {
  return Attributor(input).run();
}

}  // namespace encore::energy
