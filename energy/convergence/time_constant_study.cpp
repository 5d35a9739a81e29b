#include "energy/convergence/time_constant_study.h"

#include "energy/convergence/exponential_fit.h"
#include "energy/sampling/low_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace encore::energy {

namespace {

constexpr double kHorizon = 36000.0;
constexpr std::array<double, 9> kSteps = {0.001, 0.01,  0.1,    1.0,    10.0,
                                          60.0,  600.0, 3600.0, 36000.0};
constexpr std::array<double, 10> kTaus = {1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6};
constexpr std::uint64_t kChecks = 60;  ///< moments at which a run is compared, at most
constexpr double kLow = 20.0;          ///< W, of the load
constexpr double kHigh = 60.0;

/// Steps `advance(shown, n)` over the horizon and compares with `reference(time, tau)`.
template <class Advance, class Reference>
TimeConstantRow run_row(double tau, double step, const Clock& clock, std::uint64_t most_steps,
                        const Advance& advance, const Reference& reference) {
  TimeConstantRow row;
  row.tau = Seconds(tau);
  row.step = Seconds(step);
  row.steps = std::min(static_cast<std::uint64_t>(std::llround(kHorizon / step)), most_steps);
  const std::uint64_t stride = std::max<std::uint64_t>(1, row.steps / kChecks);
  std::vector<std::pair<std::uint64_t, double>> seen;
  const Seconds start = clock.now();
  double shown = kLow;
  for (std::uint64_t n = 0; n < row.steps; ++n) {
    shown = advance(shown, n);
    const std::uint64_t done = n + 1;
    if (done % stride == 0 || done == 1 || done == row.steps) seen.emplace_back(done, shown);
  }
  row.run_time = clock.now() - start;
  double worst = 0.0;
  for (const auto& [n, value] : seen) {
    const long double exact = reference(static_cast<long double>(n) * step, tau);
    const double error = static_cast<double>(std::fabs((value - exact) / exact));
    // A comparison with NaN is false: keep it in view.
    worst = error <= worst ? worst : error;
  }
  if (std::isfinite(worst)) row.error = worst;
  return row;
}

long double after_step(long double t, long double tau) {
  return kLow - (static_cast<long double>(kHigh) - kLow) * std::expm1(-t / tau);
}

/// A ramp from low to high over the horizon: the ramp, late by tau once it has settled.
long double along_ramp(long double t, long double tau) {
  const long double x = t / tau;
  // t - tau (1 - e^-x) cancels for a short t: its series there.
  long double late = 0.0L;
  if (x < 0.1L) {
    long double term = x / 2.0L;
    for (int n = 3; n < 30; ++n) {
      late += term;
      term *= -x / n;
    }
  } else {
    late = 1.0L + std::expm1(-x) / x;
  }
  return kLow + (static_cast<long double>(kHigh) - kLow) / kHorizon * t * late;
}

double ramp_at(double step, std::uint64_t n) {
  return kLow + (kHigh - kLow) * (static_cast<double>(n) * step / kHorizon);
}

void study_gauge(const Clock& clock, std::uint64_t most_steps,
                 std::vector<TimeConstantTable>& tables) {
  TimeConstantTable exact{
      "gauge filter after a step of load, exact steps", "watts shown against the closed form", {}};
  TimeConstantTable euler{"gauge filter after a step of load, explicit Euler", exact.measure, {}};
  TimeConstantTable ramp{"gauge filter along a ramp of load, exact steps", exact.measure, {}};
  for (const double tau : kTaus) {
    for (const double step : kSteps) {
      exact.rows.push_back(run_row(
          tau, step, clock, most_steps,
          [&](double shown, std::uint64_t) { return low_pass_step(shown, kHigh, step, tau); },
          after_step));
      euler.rows.push_back(run_row(
          tau, step, clock, most_steps,
          [&](double shown, std::uint64_t) { return shown + (kHigh - shown) * (step / tau); },
          after_step));
      euler.rows.back().stable = step < 2.0 * tau;
      ramp.rows.push_back(run_row(
          tau, step, clock, most_steps,
          [&](double shown, std::uint64_t n) {
            return low_pass_ramp(shown, ramp_at(step, n), ramp_at(step, n + 1), step, tau);
          },
          along_ramp));
    }
  }
  tables.push_back(std::move(exact));
  tables.push_back(std::move(euler));
  tables.push_back(std::move(ramp));
}

/// Normal numbers that are equal with every standard library (its distributions are not).
double normal(std::mt19937_64& random) {
  const auto uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
  const double radius = std::sqrt(-2.0 * std::log(uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

TimeConstantRow fit_row(double tau, double step, const Clock& clock, std::mt19937_64& random) {
  constexpr std::size_t kValues = 600;
  constexpr double kNoise = 0.01;
  TimeConstantRow row;
  row.tau = Seconds(tau);
  row.step = Seconds(step);
  row.steps = kValues;
  std::vector<double> times;
  std::vector<double> values;
  for (std::size_t i = 0; i < kValues; ++i) {
    times.push_back(static_cast<double>(i) * step);
    const double settled = -std::expm1(-times.back() / tau);
    values.push_back(kLow + (kHigh - kLow) * (settled + kNoise * normal(random)));
  }
  const Seconds start = clock.now();
  const ExponentialFit fit = fit_exponential(times, values);
  row.run_time = clock.now() - start;
  row.refused = fit.reason;
  row.low = fit.tau_low;
  row.high = fit.tau_high;
  if (!fit.tau) return row;
  row.error = std::fabs(fit.tau->value / tau - 1.0);
  row.fitted = fit.tau;
  return row;
}

}  // namespace

std::vector<TimeConstantTable> study_time_constants(const Clock& clock, std::uint64_t most_steps) {
  std::vector<TimeConstantTable> tables;
  study_gauge(clock, most_steps, tables);
  TimeConstantTable fits{"fit of a thermal drift, 600 values with 1 % noise",
                         "time constant against the true one",
                         {}};
  std::mt19937_64 random(1);
  for (const double tau : kTaus) {
    for (const double step : kSteps) fits.rows.push_back(fit_row(tau, step, clock, random));
  }
  tables.push_back(std::move(fits));
  return tables;
}

}  // namespace encore::energy
