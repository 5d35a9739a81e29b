#pragma once

#include "energy/attribution/fit_rows.h"
#include "energy/attribution/whitening.h"

#include <optional>
#include <vector>

namespace encore::energy {

/// A linear fit to rows whose errors are correlated.
struct ColouredFit {
  std::vector<double> x;
  std::vector<double> half_widths;  ///< of the 95 % intervals
  double durbin_watson = 0.0;       ///< of the residuals: of the cumulative form, or of the rows
};

/// Generalised least squares over a grid of guesses at the colour. Coefficients are means over the
/// grid, weighted with the restricted likelihood; the intervals include how much they differ over
/// it. They are consistent with errors of unequal size and with what correlation is left (Newey and
/// West 1987, prewhitened, bandwidth by Andrews 1991, critical values by Kiefer and Vogelsang 2005,
/// degrees of freedom by how few rows a coefficient rests on). Coefficients are not bounded.
/// Nothing if the columns depend on each other or there are not more rows than columns.
std::optional<ColouredFit> fit_coloured(const FitRows& rows, Colour colour);

/// The likeliest coefficients without slowly changing power, and how likely they are (to compare
/// different columns for the same values): quick.
struct FirstGuess {
  std::vector<double> x;
  double log_likelihood = 0.0;
};
std::optional<FirstGuess> guess(const FitRows& rows, Colour colour);

/// Which coefficients stop at 0 in a fit with the likeliest colour in which only those that are
/// `free` may be negative.
std::vector<bool> stopped_at_zero(const FitRows& rows, Colour colour,
                                  const std::vector<bool>& free);

/// Sets the rows' variances from a first guess: a counter's edge errors grow with the power there,
/// and power fluctuates more in some columns than in others.
void weigh(FitRows& rows, const std::vector<double>& x, double energy_step);

}  // namespace encore::energy
