#include "energy/convergence/exponential_fit.h"

#include "energy/convergence/correlation.h"
#include "energy/statistics.h"
#include "energy/student_t.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace encore::energy {

namespace {

constexpr std::size_t kLeast = 8;
constexpr double kLeastEffective = 6.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The series about its mean, and fits of one shape to it.
class Projection {
 public:
  Projection(std::span<const double> times, std::span<const double> values);

  /// What a shape leaves of the series.
  struct Rest {
    double squares = 0.0;
    double slope = 0.0;  ///< of the series over the shape
    double shape_mean = 0.0;
  };
  /// e^(-t / tau) - 1; its limits are a straight line and a first value that stands alone.
  [[nodiscard]] Rest at(double log_tau) const;
  [[nodiscard]] Rest straight() const;
  [[nodiscard]] Rest first_alone() const;
  /// Of no shape: the mean alone.
  [[nodiscard]] double squares_about_mean() const { return squares_; }
  /// Squares that rounding alone can leave.
  [[nodiscard]] double rounding() const { return rounding_; }
  [[nodiscard]] double mean() const { return mean_; }
  /// What all of these are in units of.
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] std::vector<double> residuals(double log_tau) const;

 private:
  template <class Shape>
  Rest project(const Shape& shape) const;

  std::vector<double> since_;  ///< seconds since the first
  std::vector<double> off_;    ///< values about their mean
  double scale_ = 1.0;
  double mean_ = 0.0;
  double squares_ = 0.0;
  double rounding_ = 0.0;
  mutable std::vector<double> shape_;
};

Projection::Projection(std::span<const double> times, std::span<const double> values)
    : shape_(times.size()) {
  const auto n = static_cast<double>(values.size());
  double largest = 0.0;
  for (const double v : values) largest = std::max(largest, std::fabs(v));
  // Their squares neither overflow nor vanish.
  if (largest > 0.0) scale_ = largest;
  for (std::size_t i = 0; i < values.size(); ++i) {
    since_.push_back(times[i] - times[0]);
    off_.push_back(values[i] / scale_);
    mean_ += (off_[i] - mean_) / static_cast<double>(i + 1);
  }
  for (double& v : off_) {
    v -= mean_;
    squares_ += v * v;
  }
  constexpr double kUnit = std::numeric_limits<double>::epsilon();
  rounding_ = n * kUnit * kUnit;
}

template <class Shape>
Projection::Rest Projection::project(const Shape& shape) const {
  Rest rest;
  const std::size_t n = since_.size();
  for (std::size_t i = 0; i < n; ++i) {
    shape_[i] = shape(i);
    rest.shape_mean += (shape_[i] - rest.shape_mean) / static_cast<double>(i + 1);
  }
  double own = 0.0;
  double both = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double s = shape_[i] - rest.shape_mean;
    own += s * s;
    both += s * off_[i];
  }
  rest.slope = own > 0.0 ? both / own : 0.0;
  // By the residuals, not by the difference of large squares.
  for (std::size_t i = 0; i < n; ++i) {
    const double left = off_[i] - rest.slope * (shape_[i] - rest.shape_mean);
    rest.squares += left * left;
  }
  return rest;
}

Projection::Rest Projection::at(double log_tau) const {
  const double tau = std::exp(log_tau);
  return project([&](std::size_t i) { return std::expm1(-since_[i] / tau); });
}

Projection::Rest Projection::straight() const {
  return project([&](std::size_t i) { return -since_[i] / since_.back(); });
}

Projection::Rest Projection::first_alone() const {
  return project([&](std::size_t i) { return i == 0 ? 0.0 : -1.0; });
}

std::vector<double> Projection::residuals(double log_tau) const {
  const Rest rest = at(log_tau);
  std::vector<double> left(off_);
  for (std::size_t i = 0; i < left.size(); ++i) {
    left[i] -= rest.slope * (shape_[i] - rest.shape_mean);
  }
  return left;
}

/// Log time constants from far below the first spacing to far beyond the record, and the squares
/// that each leaves.
struct Scan {
  std::vector<double> log_tau;
  std::vector<double> squares;
  [[nodiscard]] std::size_t best() const {
    return static_cast<std::size_t>(std::min_element(squares.begin(), squares.end()) -
                                    squares.begin());
  }
};

Scan scan(const Projection& series, double spacing, double length) {
  constexpr double kPointsPerE = 7.0;
  const double low = std::log(spacing / 40.0);
  const double high = std::log(length * 1e4);
  const auto count = static_cast<std::size_t>(std::ceil((high - low) * kPointsPerE)) + 2;
  Scan found;
  for (std::size_t i = 0; i < count; ++i) {
    const double log_tau =
        low + (high - low) * static_cast<double>(i) / static_cast<double>(count - 1);
    found.log_tau.push_back(log_tau);
    found.squares.push_back(series.at(log_tau).squares);
  }
  return found;
}

/// The minimum between two neighbours of the best of a scan, by golden sections.
double minimise(const Projection& series, double low, double high) {
  constexpr double kGolden = 0.6180339887498949;
  double a = high - kGolden * (high - low);
  double b = low + kGolden * (high - low);
  double at_a = series.at(a).squares;
  double at_b = series.at(b).squares;
  for (int i = 0; i < 90 && high - low > 1e-15 * std::max(1.0, std::fabs(a)); ++i) {
    if (at_a <= at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - kGolden * (high - low);
      at_a = series.at(a).squares;
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + kGolden * (high - low);
      at_b = series.at(b).squares;
    }
  }
  return at_a <= at_b ? a : b;
}

/// Where the squares pass `limit`, between one that is inside and one that is not.
double crossing(const Projection& series, double inside, double outside, double limit) {
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (inside + outside);
    (series.at(middle).squares <= limit ? inside : outside) = middle;
  }
  return outside;
}

/// How many deviations are worth one independent one.
double inflation_of(const std::vector<double>& residuals) {
  const auto n = static_cast<double>(residuals.size());
  const double tau = n / estimate_mean(residuals).effective_samples.value_or(n);
  return std::max({1.0, tau * (1.0 + 10.0 * (tau - 1.0) / n), first_lag_inflation(residuals, 3)});
}

/// Squares of a fit that one unknown more than the best would leave by chance, to the two-sided
/// probability `p` of Student's t.
double limit_of(double least, double freedom, double p) {
  const double t = student_t_quantile(p, freedom);
  return least * (1.0 + t * t / freedom);
}

std::string fault_of(std::span<const double> times, std::span<const double> values) {
  if (times.size() != values.size()) return "times and values differ in number";
  if (times.size() < kLeast) {
    return fmt::format("{} values are too few for a time constant: {} are needed", times.size(),
                       kLeast);
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || !std::isfinite(values[i])) return "a value is not finite";
    if (i > 0 && !(times[i] > times[i - 1])) return "the times do not rise";
  }
  return {};
}

/// The interval of log tau; infinite where it has no end.
struct Interval {
  double low = -kInfinity;
  double high = kInfinity;
};

Interval interval_of(const Projection& series, const Scan& scan, double best, double limit) {
  Interval found;
  // The outermost crossings: a likelihood of two hills gives one long interval.
  const auto is_inside = [&](double squares) { return squares <= limit; };
  const auto count = static_cast<std::ptrdiff_t>(scan.log_tau.size());
  const std::ptrdiff_t first =
      std::find_if(scan.squares.begin(), scan.squares.end(), is_inside) - scan.squares.begin();
  const std::ptrdiff_t last =
      count - 1 -
      (std::find_if(scan.squares.rbegin(), scan.squares.rend(), is_inside) - scan.squares.rbegin());
  const auto tau = [&](std::ptrdiff_t i) {
    return scan.log_tau[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, count - 1))];
  };
  // The interval may lie between two points of the scan.
  const std::ptrdiff_t above =
      std::upper_bound(scan.log_tau.begin(), scan.log_tau.end(), best) - scan.log_tau.begin();
  if (first > 0) {
    const bool seen = first < above;
    found.low =
        crossing(series, seen ? tau(first) : best, tau(seen ? first - 1 : above - 1), limit);
  }
  if (last < count - 1) {
    const bool seen = last >= above;
    found.high = crossing(series, seen ? tau(last) : best, tau(seen ? last + 1 : above), limit);
  }
  return found;
}

}  // namespace

std::optional<Seconds> ExponentialFit::settled_to(double share) const {
  if (!tau || !(share > 0.0)) return std::nullopt;
  return Seconds(std::max(0.0, -std::log(share)) * tau->value);
}

ExponentialFit fit_exponential(std::span<const double> times, std::span<const double> values) {
  ExponentialFit fit;
  fit.tau_high = Seconds(kInfinity);
  fit.reason = fault_of(times, values);
  if (!fit.reason.empty()) return fit;
  fit.start = Seconds(times.front());
  const Projection series(times, values);
  const double length = times.back() - times.front();
  const Scan found = scan(series, times[1] - times[0], length);
  const std::size_t at = found.best();
  const std::size_t last = found.log_tau.size() - 1;
  const double best =
      minimise(series, found.log_tau[at > 0 ? at - 1 : 0], found.log_tau[std::min(last, at + 1)]);

  const auto n = static_cast<double>(times.size());
  const Projection::Rest rest = series.at(best);
  // What is left of an exact curve is rounding, which is correlated, too.
  const bool exact = rest.squares <= 1e-20 * series.squares_about_mean();
  const double inflation = exact ? 1.0 : inflation_of(series.residuals(best));
  fit.effective_samples = n / inflation;
  fit.deviation = series.scale() * std::sqrt(rest.squares / std::max(1.0, n - 3.0));
  if (fit.effective_samples < kLeastEffective) {
    fit.reason = "the values wander too slowly to tell a time constant: a longer record is needed";
    return fit;
  }
  const double freedom = fit.effective_samples - 3.0;
  const double least = std::max(rest.squares, 100.0 * series.rounding());
  const double limit = limit_of(least, freedom, 0.975);
  // Of many time constants some fit chance better than none: a stricter limit (Davies 1987).
  if (series.squares_about_mean() <= limit_of(least, freedom, 0.9995)) {
    fit.reason = "nothing changes that is more than chance: no time constant can be seen";
    return fit;
  }
  const Interval interval = interval_of(series, found, best, limit);
  // What chance only just bends would give a time constant that is far too short: a stricter limit.
  const double strict = limit_of(least, freedom, 0.9999);
  const bool too_short = series.straight().squares <= strict;
  const bool too_coarse = series.first_alone().squares <= strict;
  fit.tau_low = Seconds(too_coarse ? 0.0 : std::exp(interval.low));
  fit.tau_high = Seconds(too_short ? kInfinity : std::exp(interval.high));
  if (too_short || too_coarse) {
    fit.reason =
        too_short && too_coarse ? "the record is too short and too coarse to tell a time constant"
        : too_short             ? fmt::format(
                                      "the record of {:.3g} s is too short to tell its time constant, "
                                                  "which is at least {:.3g} s: the change is straight",
                                      length, fit.tau_low.value)
                    : fmt::format(
                          "the record's spacing of {:.3g} s is too coarse to tell its time "
                          "constant, which is at most {:.3g} s",
                          times[1] - times[0], fit.tau_high.value);
    return fit;
  }
  fit.tau = Seconds(std::exp(best));
  fit.change = series.scale() * rest.slope;
  fit.end = series.scale() * (series.mean() - rest.slope * (rest.shape_mean + 1.0));
  return fit;
}

}  // namespace encore::energy
