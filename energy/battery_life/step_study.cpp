#include "energy/battery_life/step_study.h"

#include "energy/battery_life/kinetic.h"
#include "energy/battery_life/thevenin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace encore::energy {

namespace {

constexpr double kHorizon = 36000.0;
constexpr std::array<double, 9> kSteps = {0.001, 0.01,  0.1,    1.0,    10.0,
                                          60.0,  600.0, 3600.0, 36000.0};
constexpr std::uint64_t kChecks = 60;  ///< moments at which a run is compared, at most

/// Steps `advance()` over the horizon and compares `value()` with `reference(time)`.
template <class Advance, class Value, class Reference>
StepRow run_row(double step, const Clock& clock, std::uint64_t most_steps, const Advance& advance,
                const Value& value, const Reference& reference) {
  StepRow row;
  row.step = Seconds(step);
  row.steps = static_cast<std::uint64_t>(std::llround(kHorizon / step));
  row.left_out = row.steps > most_steps;
  if (row.left_out) return row;
  const std::uint64_t stride = std::max<std::uint64_t>(1, row.steps / kChecks);
  std::vector<double> values;
  std::vector<std::uint64_t> when;
  const Seconds start = clock.now();
  for (std::uint64_t n = 1; n <= row.steps; ++n) {
    advance();
    if (n % stride == 0 || n == 1 || n == row.steps) {
      when.push_back(n);
      values.push_back(value());
    }
  }
  row.run_time = clock.now() - start;
  double worst = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const long double exact = reference(static_cast<long double>(when[i]) * step);
    const double error = static_cast<double>(std::fabs((values[i] - exact) / exact));
    // A comparison with NaN is false: keep it in view.
    worst = error <= worst ? worst : error;
  }
  if (std::isfinite(worst)) row.error = worst;
  return row;
}

/// Charge at hand after t from rest, by the modes of the system: the sum and the wells' difference.
long double kinetic_reference(const KineticBattery& b, double soc, double amperes, long double t) {
  const long double all = static_cast<long double>(b.coulombs) * soc - amperes * t;
  const long double x = b.rate_per_s * t;
  const long double reached = x > 0 ? -std::expm1(-x) / x : 1.0L;
  const long double heights_apart = amperes / static_cast<long double>(b.c) * t * reached;
  return b.c * all - b.c * (1.0L - b.c) * heights_apart;
}

void study_kinetic(const Battery& battery, const Clock& clock, std::uint64_t most_steps,
                   std::vector<StepTable>& tables) {
  const KineticBattery wells = kinetic_battery(battery);
  const double amperes = 0.5 * battery.coulombs / kHorizon;
  const KineticState rest = kinetic_rest(wells, 1.0);
  const std::string measure = "charge at hand against the closed form";
  StepTable exact{"kinetic, exact steps", measure, {}};
  StepTable euler{"kinetic, explicit Euler", measure, {}};
  const auto reference = [&](long double t) { return kinetic_reference(wells, 1.0, amperes, t); };
  for (const double step : kSteps) {
    KineticState state = rest;
    const auto value = [&] { return state.available; };
    exact.rows.push_back(run_row(
        step, clock, most_steps,
        [&] { state = kinetic_step(wells, state, amperes, Seconds(step)); }, value, reference));
    state = rest;
    const double k = wells.rate_per_s;
    euler.rows.push_back(run_row(
        step, clock, most_steps,
        [&] {
          const double flow = k * (wells.c * state.bound - (1.0 - wells.c) * state.available);
          state.available += step * (flow - amperes);
          state.bound -= step * flow;
        },
        value, reference));
    euler.rows.back().stable = step * k < 2.0;
  }
  tables.push_back(std::move(exact));
  tables.push_back(std::move(euler));
}

/// Terminal voltage after t at a constant current from rest.
long double thevenin_reference(const PackCircuit& circuit, double amperes, long double t) {
  const long double soc = 1.0L - amperes * t / circuit.coulombs;
  long double volts = circuit.open_volts(static_cast<double>(soc)) - amperes * circuit.r0_ohms;
  for (const RcBranch& branch : circuit.branches) {
    const long double tau = static_cast<long double>(branch.ohms) * branch.farads;
    volts -= branch.ohms * amperes * (tau > 0 ? -std::expm1(-t / tau) : 1.0L);
  }
  return volts;
}

void study_thevenin(const PackCircuit& circuit, const Clock& clock, std::uint64_t most_steps,
                    std::vector<StepTable>& tables) {
  const double amperes = 0.5 * circuit.coulombs / kHorizon;
  const std::string measure = "terminal voltage against the closed form";
  StepTable exact{"Thevenin at a constant current, exact steps", measure, {}};
  StepTable euler{"Thevenin at a constant current, explicit Euler", measure, {}};
  double fastest = std::numeric_limits<double>::infinity();
  for (const RcBranch& branch : circuit.branches) fastest = std::min(fastest, branch.tau());
  const auto reference = [&](long double t) { return thevenin_reference(circuit, amperes, t); };
  for (const double step : kSteps) {
    TheveninState state = thevenin_rest(circuit, 1.0);
    const auto value = [&] { return inner_volts(circuit, state) - amperes * circuit.r0_ohms; };
    const StepGains gains(circuit, Seconds(step));
    exact.rows.push_back(run_row(
        step, clock, most_steps, [&] { thevenin_step(circuit, state, amperes, gains); }, value,
        reference));
    state = thevenin_rest(circuit, 1.0);
    euler.rows.push_back(run_row(
        step, clock, most_steps,
        [&] {
          for (std::size_t j = 0; j < circuit.branches.size(); ++j) {
            const RcBranch& branch = circuit.branches[j];
            double& volts = state.branch_volts[j];
            volts += step * (amperes - volts / branch.ohms) / branch.farads;
          }
          state.soc -= amperes * step / circuit.coulombs;
        },
        value, reference));
    euler.rows.back().stable = step < 2.0 * fastest;
  }
  tables.push_back(std::move(exact));
  tables.push_back(std::move(euler));
}

/// Time to the end with steps of at most `longest`, or as forecasts choose them if that is
/// infinite.
DischargeEnd power_run(const PackCircuit& circuit, Watts load, double longest) {
  StepLimits limits;
  if (std::isfinite(longest)) {
    limits.longest = Seconds(longest);
    limits.most_soc = 1.0;
  }
  return discharge_constant_power(circuit, thevenin_rest(circuit, 1.0), load, limits);
}

StepTable study_power(const PackCircuit& circuit, Watts load, const Clock& clock,
                      std::uint64_t most_steps) {
  StepTable table{"Thevenin at a constant power, implicit midpoint steps",
                  "time to the end against the Richardson limit of small steps",
                  {}};
  constexpr double kByCharge = std::numeric_limits<double>::infinity();
  const double about = power_run(circuit, load, kByCharge).time.value;
  const double finest = std::min(2e6, static_cast<double>(most_steps));
  const double fine = std::max(about / finest, 1e-9);
  const double coarse_time = power_run(circuit, load, 2.0 * fine).time.value;
  const double fine_time = power_run(circuit, load, fine).time.value;
  const double exact = fine_time + (fine_time - coarse_time) / 3.0;
  std::vector<double> steps(kSteps.begin(), kSteps.end());
  steps.push_back(kByCharge);
  for (const double step : steps) {
    StepRow row;
    row.step = Seconds(step);
    row.left_out = about / step > static_cast<double>(most_steps);  // infinite steps never are
    if (!row.left_out) {
      const Seconds start = clock.now();
      const DischargeEnd end = power_run(circuit, load, step);
      row.run_time = clock.now() - start;
      row.steps = end.steps;
      if (exact > 0.0) row.error = std::fabs(end.time.value - exact) / exact;
    }
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace

std::vector<StepTable> study_steps(const Battery& battery, Watts load, const Clock& clock,
                                   std::uint64_t most_steps) {
  if (const std::string fault = battery_fault(battery); !fault.empty()) {
    throw std::invalid_argument("battery: " + fault);
  }
  std::vector<StepTable> tables;
  study_kinetic(battery, clock, most_steps, tables);
  const PackCircuit circuit = pack_circuit(battery);
  study_thevenin(circuit, clock, most_steps, tables);
  if (load.value > 0.0) tables.push_back(study_power(circuit, load, clock, most_steps));
  return tables;
}

}  // namespace encore::energy
