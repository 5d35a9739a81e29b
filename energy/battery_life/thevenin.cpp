#include "energy/battery_life/thevenin.h"

#include "energy/battery_life/bisection.h"
#include "energy/battery_life/exponential.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace encore::energy {

namespace {

/// One stretch of constant current, looked into at any moment.
class Stretch {
 public:
  Stretch(const PackCircuit& circuit, const TheveninState& start, double amperes, double length,
          double least_inner_volts)
      : circuit_(circuit),
        start_(start),
        amperes_(amperes),
        length_(length),
        least_(least_inner_volts) {
    for (std::size_t j = 0; j < circuit.branches.size(); ++j) {
      falling_ = falling_ && circuit.branches[j].ohms * amperes >= start.branch_volts[j];
    }
  }

  /// The first moment at which the inner voltage is at its least or below.
  [[nodiscard]] std::optional<double> first_low() const {
    if (!(inner_at(0.0) > least_)) return 0.0;
    constexpr int kDepth = 48;
    return first_low(0.0, length_, kDepth);
  }

 private:
  [[nodiscard]] double branch_at(std::size_t j, double t) const {
    const RcBranch& branch = circuit_.branches[j];
    const double from = start_.branch_volts[j];
    return from + (branch.ohms * amperes_ - from) * approach(t, branch.tau());
  }
  [[nodiscard]] double soc_at(double t) const {
    return start_.soc - amperes_ * t / circuit_.coulombs;
  }
  [[nodiscard]] double inner_at(double t) const { return inner_bound(t, t); }

  /// The inner voltage stays above this from a to b: charge and branches each go one way only.
  [[nodiscard]] double inner_bound(double a, double b) const {
    double volts = circuit_.open_volts(std::min(soc_at(a), soc_at(b)));
    for (std::size_t j = 0; j < circuit_.branches.size(); ++j) {
      volts -= std::max(branch_at(j, a), branch_at(j, b));
    }
    return volts;
  }

  [[nodiscard]] std::optional<double> first_low(double a, double b, int depth) const {
    if (inner_bound(a, b) > least_) return std::nullopt;
    const bool low_at_end = !(inner_at(b) > least_);
    if (falling_ || depth == 0) {
      if (!low_at_end) return std::nullopt;
      return first_true(a, b, [&](double t) { return !(inner_at(t) > least_); });
    }
    const double middle = a + (b - a) / 2.0;
    const auto early = first_low(a, middle, depth - 1);
    return early ? early : first_low(middle, b, depth - 1);
  }

  const PackCircuit& circuit_;
  const TheveninState& start_;
  double amperes_;
  double length_;
  double least_;
  bool falling_ = true;  ///< every branch's voltage rises, so that the inner one only falls
};

}  // namespace

std::string_view to_string(EndReason reason) {
  switch (reason) {
    case EndReason::empty:
      return "empty";
    case EndReason::cut_off:
      return "cut-off";
    case EndReason::brown_out:
      return "brown-out";
    case EndReason::never:
      break;
  }
  return "never";
}

double PackCircuit::open_volts(double soc) const {
  if (soc <= ocv.front().soc) return ocv.front().volts;
  if (soc >= ocv.back().soc) return ocv.back().volts;
  const auto above = std::upper_bound(
      ocv.begin(), ocv.end(), soc, [](double s, const OcvPoint& point) { return s < point.soc; });
  const auto below = above - 1;
  const double share = (soc - below->soc) / (above->soc - below->soc);
  return below->volts + (above->volts - below->volts) * share;
}

PackCircuit pack_circuit(const Battery& battery) {
  const double in_series = battery.series;
  const double resistance = in_series / battery.parallel;
  PackCircuit circuit;
  circuit.coulombs = battery.coulombs;
  circuit.r0_ohms = battery.cell.r0_ohms * resistance;
  for (const RcBranch& branch : battery.cell.branches) {
    circuit.branches.push_back({branch.ohms * resistance, branch.farads / resistance});
  }
  for (const OcvPoint& point : battery.cell.ocv) {
    circuit.ocv.push_back({point.soc, point.volts * in_series});
  }
  circuit.cutoff_volts = battery.cutoff_volts;
  return circuit;
}

TheveninState thevenin_rest(const PackCircuit& circuit, double soc) {
  return {soc, std::vector<double>(circuit.branches.size(), 0.0)};
}

double inner_volts(const PackCircuit& circuit, const TheveninState& state) {
  double volts = circuit.open_volts(state.soc);
  for (const double branch : state.branch_volts) volts -= branch;
  return volts;
}

StepGains::StepGains(const PackCircuit& circuit, Seconds dt) : dt_(dt) {
  gains_.reserve(circuit.branches.size());
  for (const RcBranch& branch : circuit.branches) {
    gains_.push_back(approach(dt.value, branch.tau()));
  }
}

void thevenin_step(const PackCircuit& circuit, TheveninState& state, double amperes,
                   const StepGains& gains) {
  for (std::size_t j = 0; j < circuit.branches.size(); ++j) {
    double& volts = state.branch_volts[j];
    volts += (circuit.branches[j].ohms * amperes - volts) * gains[j];
  }
  state.soc -= amperes * gains.dt().value / circuit.coulombs;
}

std::optional<DischargeEnd> discharge_within(const PackCircuit& circuit, const TheveninState& state,
                                             double amperes, Seconds within) {
  const double empty_after = state.soc <= 0.0 ? 0.0
                             : amperes > 0.0  ? state.soc * (circuit.coulombs / amperes)
                                              : std::numeric_limits<double>::infinity();
  const double length = std::min(within.value, empty_after);
  const double least = circuit.cutoff_volts + amperes * circuit.r0_ohms;
  DischargeEnd end;
  end.steps = 1;
  if (const auto low = Stretch(circuit, state, amperes, length, least).first_low()) {
    end.reason = EndReason::cut_off;
    end.time = Seconds(*low);
  } else if (empty_after <= within.value) {
    end.time = Seconds(empty_after);
  } else {
    return std::nullopt;
  }
  end.state = state;
  thevenin_step(circuit, end.state, amperes, StepGains(circuit, end.time));
  return end;
}

}  // namespace encore::energy
