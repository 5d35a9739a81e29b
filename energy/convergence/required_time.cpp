#include "energy/convergence/required_time.h"

#include "energy/student_t.h"

#include <cmath>
#include <limits>

namespace encore::energy {

namespace {

/// 97.5 % quantile of the normal distribution.
const double kSqrt6 = std::sqrt(6.0);

/// Square of the relative half-width times the time: what scatter contributes.
double scatter(const Pilot& pilot) {
  return pilot.spacing.value * pilot.inflation * std::pow(kNormal95 * pilot.relative_sd, 2);
}

}  // namespace

std::optional<Pilot> pilot_of(const Estimate& estimate, Seconds length) {
  if (!estimate.effective_samples || !estimate.ci95_half_width || estimate.mean == 0.0) {
    return std::nullopt;
  }
  const auto samples = static_cast<double>(estimate.samples);
  const double effective = *estimate.effective_samples;
  Pilot pilot;
  pilot.spacing = length / samples;
  pilot.inflation = samples / effective;
  // The scatter that the interval rests on: with unequal weights it is not that of the samples.
  pilot.relative_sd = *estimate.ci95_half_width / student_t_quantile(0.975, effective - 1.0) *
                      std::sqrt(effective) / std::fabs(estimate.mean);
  return pilot;
}

double edge_error(Seconds update_period, Seconds window) {
  return update_period / window / kSqrt6;
}

Seconds edge_bound(Seconds update_period, double relative) {
  return update_period / (relative * kSqrt6);
}

Seconds required_time(const Pilot& pilot, double target) {
  const double left = target * target - std::pow(kNormal95 * pilot.floor, 2);
  if (!(target > 0.0) || !(left > 0.0)) return Seconds(std::numeric_limits<double>::infinity());
  // left = scatter / T + edges^2 / T^2.
  const double a = scatter(pilot) / left;
  const double b = kNormal95 * edge_bound(pilot.edge, std::sqrt(left)).value;
  return Seconds(0.5 * (a + std::sqrt(a * a + 4.0 * b * b))) + pilot.settle;
}

double expected_half_width(const Pilot& pilot, Seconds window) {
  const Seconds used = window - pilot.settle;
  if (!(used.value > 0.0)) return std::numeric_limits<double>::infinity();
  const double sensor = kNormal95 * std::hypot(edge_error(pilot.edge, used), pilot.floor);
  return std::sqrt(scatter(pilot) / used.value + sensor * sensor);
}

}  // namespace encore::energy
