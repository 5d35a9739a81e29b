#include "energy/attribution/chance.h"

#include "energy/student_t.h"

#include <algorithm>
#include <cmath>

namespace encore::energy {

namespace {

double student95(double degrees) {
  return degrees < 1e6 ? student_t_quantile(0.975, degrees) : kNormal95;
}

}  // namespace

Chance Chance::scaled(double factor) const {
  return {standard_error * std::fabs(factor), degrees, half_width * std::fabs(factor)};
}

Chance student_chance(double standard_error, double degrees) {
  return {standard_error, degrees, standard_error * student95(degrees)};
}

Chance combined(std::span<const Chance> parts) {
  double squares = 0.0;
  double fourths = 0.0;
  const Chance* only = nullptr;
  int counted = 0;
  for (const Chance& part : parts) {
    const double square = part.standard_error * part.standard_error;
    if (square == 0) continue;
    squares += square;
    fourths += square * square / part.degrees;
    only = &part;
    ++counted;
  }
  if (counted == 0) return {};
  if (counted == 1) return *only;
  const double degrees =
      fourths > 0 ? squares * squares / fourths : std::numeric_limits<double>::infinity();
  return student_chance(std::sqrt(squares), degrees);
}

void ErrorSum::add_uniform(double range, double spread) {
  // Moments of a uniform number times a normal one with mean 1 and standard deviation `spread`.
  const double square = range * range;
  const double r2 = spread * spread;
  const double second = square * (1 + r2) / 12.0;
  const double fourth = square * square * (1 + 6 * r2 + 3 * r2 * r2) / 80.0;
  variance_ += second;
  fourth_cumulant_ += fourth - 3 * second * second;
}

void ErrorSum::add(const ErrorSum& other, double factor) {
  const double square = factor * factor;
  variance_ += other.variance_ * square;
  fourth_cumulant_ += other.fourth_cumulant_ * square * square;
}

Chance ErrorSum::chance() const {
  if (variance_ <= 0) return {};
  // The parabola through the exact factors for kurtosis 0, -0.6 (triangular) and -1.2 (uniform).
  const double k = std::max(0.0, -fourth_cumulant_ / (variance_ * variance_));
  const double triangular = (2.0 - std::sqrt(0.2)) * std::sqrt(1.5);
  const double uniform = 0.95 * std::sqrt(3.0);
  const double near = (triangular - kNormal95) / 0.6;
  const double far = (uniform - kNormal95) / 1.2;
  const double factor = kNormal95 + k * (near + (far - near) * (k - 0.6) / 0.6);
  Chance chance;
  chance.standard_error = std::sqrt(variance_);
  chance.half_width = factor * chance.standard_error;
  return chance;
}

}  // namespace encore::energy
