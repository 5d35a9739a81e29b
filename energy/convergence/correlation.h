#pragma once

#include "energy/statistics.h"

#include <span>

namespace encore::energy {

/// How many values of a series are worth one independent one, if correlation decays exponentially:
/// (1 + phi) / (1 - phi) of the first lag; at least 1. `residuals`: about a fit of `terms` terms,
/// 1 a mean, 2 a line. A fit takes out slow wandering, which lowers the first lag by about
/// (terms + (terms + 2) phi) / n (Kendall 1954 for a mean); that is undone.
double first_lag_inflation(std::span<const double> residuals, int terms);

/// The same where fast scatter hides slow wandering: the largest over means of m = 1, 2, 4 ...
/// values, of which there are at least 32, of m var(means) / var(values) times the first lag's
/// inflation of the means. `residuals` are about their mean.
double scaled_inflation(std::span<const double> residuals);

/// estimate_mean() with the larger of its inflation and scaled_inflation(). Whoever stops when an
/// interval looks narrow catches the moments at which an estimate of correlation happens to come
/// out low; two that scatter differently, and the first lag's much less, seldom do so together.
Estimate cautious_mean(std::span<const double> values, std::span<const double> weights);

}  // namespace encore::energy
