#pragma once

#include "energy/attribution/fit_rows.h"

#include <vector>

namespace encore::energy {

/// How the errors of neighbouring rows hang together.
enum class Colour {
  /// A counter: independent errors of the edges (which each row shares with the next one), plus
  /// power that fluctuates (errors of a row's own), plus power that changes slowly. How much of
  /// each is estimated: edge errors alone give the fit to the cumulative energy, fluctuation alone
  /// the one to its differences.
  edges_and_walk,
  /// A gauge: each error is a share of the one before plus news; the share is estimated.
  autoregressive,
};

/// One guess at how errors hang together.
struct Shade {
  double share = 0.0;   ///< in [0, 1]: of fluctuation in a counter's error, or of a gauge's error
                        ///< that is left at the next update
  double swing = 0.0;   ///< variance of power that changes slowly, times the mean row's length
  double memory = 0.0;  ///< and how long it lasts, in mean rows
  double prior = 1.0;
};

/// Rows whose errors are independent and of equal size.
struct White {
  DenseMatrix columns;
  std::vector<double> values;
  double log_determinant = 0.0;  ///< of the covariance that was taken out
};

/// Takes a guess at the errors' correlation out of rows: a Kalman filter for a counter, news
/// against the update before for a gauge.
White whiten(const FitRows& rows, Colour colour, const Shade& shade);

}  // namespace encore::energy
