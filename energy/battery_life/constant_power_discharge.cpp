#include "energy/battery_life/constant_power.h"
#include "energy/battery_life/exponential.h"
#include "energy/battery_life/thevenin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace encore::energy {

namespace {

/// The inner voltage at which a constant power ends, and why. On the branch of the root in use the
/// terminals stand at the cut-off Vc when E = Vc + R0 P / Vc; below E = 2 sqrt(R0 P) there is no
/// root. Which comes first depends on Vc only.
struct Threshold {
  double inner_volts = 0.0;
  EndReason reason = EndReason::brown_out;
};

Threshold threshold_of(const PackCircuit& circuit, Watts load) {
  const double breakdown = std::sqrt(circuit.r0_ohms) * std::sqrt(load.value);
  const double cutoff = circuit.cutoff_volts;
  if (cutoff > breakdown) {
    return {cutoff + breakdown * (breakdown / cutoff), EndReason::cut_off};
  }
  return {2.0 * breakdown, EndReason::brown_out};
}

/// Tries steps of constant power.
class PowerStepper {
 public:
  PowerStepper(const PackCircuit& circuit, Watts load)
      : circuit_(circuit),
        load_(load),
        threshold_(threshold_of(circuit, load)),
        whole_(circuit, Seconds(0.0)),
        half_(circuit, Seconds(0.0)) {}

  /// Why `state` can give the power no longer; nothing if it can.
  [[nodiscard]] std::optional<EndReason> ended(const TheveninState& state) const {
    if (state.soc <= 0.0) return EndReason::empty;
    if (!(inner_volts(circuit_, state) > threshold_.inner_volts)) return threshold_.reason;
    return std::nullopt;
  }

  /// Moves `state` by one step; if the end lies in it, leaves it alone and says why it ends.
  std::optional<EndReason> advance(TheveninState& state, Seconds dt) {
    prepare(dt);
    const auto amperes = current_at_half(state);
    if (!amperes) return threshold_.reason;
    next_ = state;
    thevenin_step(circuit_, next_, *amperes, whole_);
    if (const auto reason = ended(next_)) return reason;
    std::swap(state, next_);
    return std::nullopt;
  }

 private:
  void prepare(Seconds dt) {
    if (whole_.dt() == dt) return;
    whole_ = StepGains(circuit_, dt);
    half_ = StepGains(circuit_, dt / 2.0);
  }

  /// The current I that gives the power in the middle of a step that starts at `state`. There the
  /// branches are a fixed voltage less a resistance times I, which joins R0 in the quadratic: fast
  /// branches need no iteration. Only the OCV, which the charge moves slowly, does.
  [[nodiscard]] std::optional<double> current_at_half(const TheveninState& state) const {
    double resistance = circuit_.r0_ohms;
    double held_volts = 0.0;
    for (std::size_t j = 0; j < circuit_.branches.size(); ++j) {
      resistance += circuit_.branches[j].ohms * half_[j];
      held_volts += state.branch_volts[j] * (1.0 - half_[j]);
    }
    const double soc_per_ampere = half_.dt().value / circuit_.coulombs;
    double amperes = 0.0;
    constexpr int kRounds = 60;
    for (int round = 0; round < kRounds; ++round) {
      const double open = circuit_.open_volts(state.soc - amperes * soc_per_ampere);
      const auto better = current_for_power(open - held_volts, resistance, load_);
      if (!better) return std::nullopt;
      const double change = std::fabs(*better - amperes);
      amperes = *better;
      if (change <= 1e-15 * amperes) break;
    }
    return amperes;
  }

  const PackCircuit& circuit_;
  Watts load_;
  Threshold threshold_;
  StepGains whole_;
  StepGains half_;
  TheveninState next_;
};

}  // namespace

DischargeEnd discharge_constant_power(const PackCircuit& circuit, const TheveninState& state,
                                      Watts load, const StepLimits& limits) {
  DischargeEnd end;
  end.state = state;
  end.reason = EndReason::never;
  if (!(load.value > 0.0)) return end;
  PowerStepper stepper(circuit, load);
  // The time as a sum of very many small steps: what rounding drops is carried along.
  double dropped = 0.0;
  double bracket = std::numeric_limits<double>::infinity();  // the end is nearer than about this
  while (true) {
    if (const auto reason = stepper.ended(end.state)) {
      end.reason = *reason;
      return end;
    }
    const auto amperes = current_for_power(inner_volts(circuit, end.state), circuit.r0_ohms, load);
    const double soc_step =
        amperes ? limits.most_soc * (circuit.coulombs / *amperes) : limits.longest.value;
    const double dt = std::min({limits.longest.value, soc_step, bracket});
    if (!std::isfinite(dt)) return end;
    if (const auto reason = stepper.advance(end.state, Seconds(dt))) {
      end.reason = *reason;
      bracket = dt / 2.0;
      const double least = std::max(1e-12 * end.time.value, 1e-18 * soc_step);
      if (!(bracket > least)) return end;
      continue;
    }
    ++end.steps;
    const double step = dt - dropped;
    const double sum = end.time.value + step;
    dropped = (sum - end.time.value) - step;
    end.time = Seconds(sum);
  }
}

}  // namespace encore::energy
