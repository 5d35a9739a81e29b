#include "energy/model/model_fit.h"

#include "energy/model/least_squares.h"
#include "energy/student_t.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace encore::energy {

namespace {

constexpr double kDoubtfulCondition = 30.0;
constexpr double kRefusedCondition = 100.0;

/// The linear system of a fit: one row an observation, divided by its joules.
struct System {
  std::vector<std::size_t> columns;  ///< the rate of each column; rates.size() stands for idle
  std::vector<std::vector<double>> rows;
  std::vector<double> given;
  std::vector<double> half_widths;  ///< of `given`
};

System build_system(std::size_t rates, std::span<const ModelObservation> observations,
                    IdleTerm idle_term, Uncertain idle) {
  System system;
  std::vector<bool> used(rates, false);
  for (const ModelObservation& seen : observations) {
    for (const FrameWork& work : seen.work) {
      if (seen.calibrates && work.seconds.value > 0.0) used.at(work.rate) = true;
    }
  }
  for (std::size_t k = 0; k < rates; ++k) {
    if (used[k]) system.columns.push_back(k);
  }
  if (idle_term == IdleTerm::fit) system.columns.push_back(rates);

  for (const ModelObservation& seen : observations) {
    if (!(seen.joules.value > 0.0)) {
      throw std::invalid_argument(seen.name + ": the joules are not above 0");
    }
    if (!seen.calibrates) continue;
    std::vector<double> seconds(rates + 1, 0.0);
    for (const FrameWork& work : seen.work) seconds[work.rate] += work.seconds.value;
    seconds[rates] = seen.seconds.value;
    std::vector<double> row;
    for (const std::size_t k : system.columns) row.push_back(seconds[k] / seen.joules.value);
    system.rows.push_back(std::move(row));
    const double idle_joules = idle_term == IdleTerm::given ? idle.value * seen.seconds.value : 0.0;
    const double idle_half =
        idle_term == IdleTerm::given ? idle.half_width * seen.seconds.value : 0.0;
    system.given.push_back(1.0 - idle_joules / seen.joules.value);
    system.half_widths.push_back(std::hypot(seen.joules.half_width, idle_half) / seen.joules.value);
  }
  return system;
}

/// Half-width of coefficient `k`: the larger of what scatter and what measurement imply.
double half_width_of(const LeastSquares& solution, const System& system, std::size_t k) {
  double pulls = 0.0;
  double measured = 0.0;
  for (std::size_t i = 0; i < system.rows.size(); ++i) {
    const double pull = solution.sensitivity[k][i];
    pulls += pull * pull;
    measured += pull * pull * system.half_widths[i] * system.half_widths[i];
  }
  double scatter = 0.0;
  if (const auto deviation = solution.residual_deviation()) {
    scatter = student_t_quantile(0.975, static_cast<double>(solution.degrees_of_freedom)) *
              *deviation * std::sqrt(pulls);
  }
  return std::max(scatter, std::sqrt(measured));
}

/// Why the solution cannot be used; empty if it can.
std::string refusal(const std::optional<LeastSquares>& solution, const System& system,
                    std::span<const std::string> names) {
  const std::size_t idle = names.size();
  if (system.columns.empty() || system.rows.size() < system.columns.size()) {
    return fmt::format("{} configurations are too few for {} rates", system.rows.size(),
                       system.columns.size());
  }
  if (!solution || solution->condition > kRefusedCondition) {
    return fmt::format(
        "the rates cannot be told apart{}; {}",
        solution ? fmt::format(" (condition number {:.0f})", solution->condition) : "",
        std::find(system.columns.begin(), system.columns.end(), idle) != system.columns.end()
            ? "work fills every operation, so idle power has to be given"
            : "measure tests that mix the work differently");
  }
  for (std::size_t c = 0; c < system.columns.size(); ++c) {
    if (solution->coefficients[c] < 0.0) {
      return fmt::format(
          "the fit makes the rate of {} negative ({:.3g} W): the configurations do "
          "not follow this model",
          system.columns[c] == idle ? "idle" : names[system.columns[c]], solution->coefficients[c]);
    }
  }
  return {};
}

/// What the fitted rates say of one observation; nothing if none of its work has a rate.
std::optional<ModelCheck> check_one(const RateFit& fit, const ModelObservation& seen) {
  ModelInput input;
  for (const auto& rate : fit.rates) input.rates.push_back(rate.value_or(Uncertain{}));
  double known = 0.0;
  double known_joules = 0.0;
  double busy = 0.0;
  for (const FrameWork& work : seen.work) {
    busy += work.seconds.value;
    if (!fit.rates.at(work.rate)) continue;
    known += work.seconds.value;
    known_joules += work.seconds.value * fit.rates[work.rate]->value;
  }
  if (!(known > 0.0)) return std::nullopt;
  // The mean of the rest stands in for rates that no calibrating observation shows.
  for (std::size_t k = 0; k < fit.rates.size(); ++k) {
    if (!fit.rates[k]) input.rates[k].value = known_joules / known;
  }
  input.work = seen.work;

  ModelCheck check;
  check.assumed_share = 1.0 - known / busy;
  check.prediction = fit.idle_watts ? predict_overlapping(*fit.idle_watts, seen.seconds, input)
                                    : predict_sequential(input);
  check.error = check.prediction.joules.value / seen.joules.value - 1.0;
  return check;
}

}  // namespace

RateFit fit_rates(std::span<const std::string> names,
                  std::span<const ModelObservation> observations, IdleTerm idle_term,
                  Uncertain idle_watts) {
  RateFit fit;
  fit.rates.resize(names.size());
  const System system = build_system(names.size(), observations, idle_term, idle_watts);
  const auto solution = solve_least_squares(system.rows, system.given);
  if (solution) fit.condition = solution->condition;
  fit.problem = refusal(solution, system, names);
  if (!fit.problem.empty()) return fit;

  fit.calibrating = system.rows.size();
  fit.residual = solution->residual_deviation();
  const auto measured = [](double half) { return half > 0.0; };
  fit.half_widths_known =
      solution->degrees_of_freedom > 0 ||
      std::all_of(system.half_widths.begin(), system.half_widths.end(), measured);
  if (idle_term == IdleTerm::given) fit.idle_watts = idle_watts;
  for (std::size_t c = 0; c < system.columns.size(); ++c) {
    const Uncertain rate{solution->coefficients[c], half_width_of(*solution, system, c)};
    if (system.columns[c] < names.size()) {
      fit.rates[system.columns[c]] = rate;
    } else {
      fit.idle_watts = rate;
      fit.idle_fitted = true;
    }
  }
  if (*fit.condition > kDoubtfulCondition) {
    fit.problem =
        fmt::format("the rates are hard to tell apart (condition number {:.0f})", *fit.condition);
  }
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (auto check = check_one(fit, observations[i])) {
      check->observation = i;
      fit.checks.push_back(std::move(*check));
    }
  }
  return fit;
}

ModelErrors sum_errors(std::span<const double> errors) {
  ModelErrors sum;
  sum.count = errors.size();
  if (errors.empty()) return sum;
  const auto count = static_cast<double>(errors.size());
  for (const double error : errors) {
    sum.mean += error / count;
    sum.rms += error * error / count;
    if (std::fabs(error) > std::fabs(sum.worst)) sum.worst = error;
  }
  sum.rms = std::sqrt(sum.rms);
  return sum;
}

ModelErrors errors_of(const RateFit& fit, std::span<const ModelObservation> observations,
                      bool calibrates) {
  std::vector<double> errors;
  for (const ModelCheck& check : fit.checks) {
    if (observations[check.observation].calibrates == calibrates) errors.push_back(check.error);
  }
  return sum_errors(errors);
}

}  // namespace encore::energy
