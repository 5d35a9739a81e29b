#pragma once

#include <limits>
#include <span>

namespace encore::energy {

/// What chance does to a figure.
struct Chance {
  double standard_error = 0.0;
  /// Degrees of freedom that the standard error rests on; infinite if it is known beforehand.
  double degrees = std::numeric_limits<double>::infinity();
  double half_width = 0.0;  ///< for 95 %

  /// The same for the figure times `factor`.
  [[nodiscard]] Chance scaled(double factor) const;
};

/// A standard error with Student's t for its degrees of freedom.
Chance student_chance(double standard_error, double degrees);

/// The chance of a sum of independent figures: standard errors in quadrature, degrees of freedom by
/// Welch and Satterthwaite. One part alone keeps its half-width.
Chance combined(std::span<const Chance> parts);

/// Adds up independent errors of which some are uniform, such as the age of a reading or its
/// rounding. One uniform error never leaves its range: 95 % of it are 1.645 standard deviations,
/// not 1.96; of the triangular sum of two, 1.902. Between these and the normal distribution the
/// factor follows the sum's excess kurtosis.
class ErrorSum {
 public:
  /// An error that is anything in a range of this length, all as likely; the length itself is
  /// known up to a relative standard deviation `spread`.
  void add_uniform(double range, double spread = 0.0);
  void add_normal(double variance) { variance_ += variance; }
  /// The errors of another sum, each times `factor`.
  void add(const ErrorSum& other, double factor);
  [[nodiscard]] double variance() const { return variance_; }
  [[nodiscard]] Chance chance() const;

 private:
  double variance_ = 0.0;
  double fourth_cumulant_ = 0.0;
};

}  // namespace encore::energy
