#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace encore::energy {

/// A mean and how well it is known.
struct Estimate {
  std::size_t samples = 0;
  double mean = 0.0;
  std::optional<double> standard_deviation;  ///< of the samples; needs two
  std::optional<double> effective_samples;   ///< independent samples that would tell as much
  std::optional<double> ci95_half_width;     ///< of the mean: mean +- this; needs two samples
};

/// The mean of a series in the order of time, with a 95 % confidence interval that stays honest
/// when neighbours are alike. `weights` (empty: all 1) says how many operations each value is the
/// mean of; the mean is then the one over all operations.
///
/// The interval is mean +- t(n_eff - 1) s / sqrt(n_eff) with n_eff = n / tau. The inflation tau is
/// the larger of Sokal's self-windowing estimate of the integrated autocorrelation time,
/// 1 + 2 sum rho_k up to the first lag k >= 5 tau, and the one that 20 batch means imply (from 40
/// samples on); at least 1. Below 20 samples no correlation can be told and tau is 1. With unequal
/// weights the same is done to the linearised residuals of the ratio sum(w v) / sum(w).
Estimate estimate_mean(std::span<const double> values, std::span<const double> weights = {});

/// The value below which a share `q` in [0, 1] of the values lies, linear between neighbours in
/// order; nothing for no values.
std::optional<double> percentile(std::span<const double> values, double q);
inline std::optional<double> median(std::span<const double> values) {
  return percentile(values, 0.5);
}

}  // namespace encore::energy
