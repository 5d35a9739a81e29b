#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace encore::energy {

/// The solution of an overdetermined linear system.
struct LeastSquares {
  std::vector<double> coefficients;
  std::vector<double> residuals;  ///< of the rows: given minus fitted
  /// coefficients = sensitivity x given: how much each row pulls at each coefficient.
  std::vector<std::vector<double>> sensitivity;
  /// Largest over smallest singular value, columns scaled to length 1 first.
  double condition = 1.0;
  std::size_t degrees_of_freedom = 0;  ///< rows minus coefficients

  /// Root of the residual variance, the square sum over the degrees of freedom; nothing without
  /// any.
  [[nodiscard]] std::optional<double> residual_deviation() const;
};

/// Minimises |rows x - given|. `rows`: all of one length, the number of coefficients, and at least
/// as many as that. Nothing if the columns are not independent (to 12 digits) or there are too few
/// rows. By one-sided Jacobi rotations (Hestenes 1958), accurate for small systems.
std::optional<LeastSquares> solve_least_squares(std::span<const std::vector<double>> rows,
                                                std::span<const double> given);

}  // namespace encore::energy
