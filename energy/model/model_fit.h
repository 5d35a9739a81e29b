#pragma once

#include "energy/model/energy_model.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace encore::energy {

/// A measured configuration as the models see it: means an operation.
struct ModelObservation {
  std::string name;
  std::vector<FrameWork> work;  ///< busy times; `rate` is an index into the fit's rates
  Uncertain seconds;            ///< from one operation's start to the next one's
  Uncertain joules;             ///< measured; half-width 0: not known
  bool calibrates = true;       ///< false: held back, to see how well it is predicted
};

/// What a model says of an observation, beside what was measured.
struct ModelCheck {
  std::size_t observation = 0;
  ModelPrediction prediction;
  double error = 0.0;  ///< predicted over measured joules, minus 1
  /// Share of the busy time whose kind of work has no fitted rate. It is taken at the mean rate of
  /// the rest, as the thesis does with transfer (section 5.3.3).
  double assumed_share = 0.0;
};

/// Errors of several checks together.
struct ModelErrors {
  std::size_t count = 0;
  double mean = 0.0;  ///< signed: a bias
  double rms = 0.0;
  double worst = 0.0;  ///< the one furthest from 0, with its sign
};

/// Rates fitted to the observations that calibrate, and what they predict for all.
struct RateFit {
  /// Watts, one for each name that was asked for; nothing where no calibrating observation has
  /// such work, or where there is no fit.
  std::vector<std::optional<Uncertain>> rates;
  std::optional<Uncertain> idle_watts;  ///< as given or fitted; nothing in the sequential model
  bool idle_fitted = false;
  bool half_widths_known = false;   ///< else the rates' half-widths are 0 for want of any
  std::size_t calibrating = 0;      ///< observations that were fitted
  std::optional<double> condition;  ///< of the fit, columns scaled
  std::optional<double> residual;   ///< root of the relative residual variance
  std::string problem;              ///< why there is no fit, or what weakens it; one sentence
  std::vector<ModelCheck> checks;   ///< in the order of the observations; empty without a fit

  [[nodiscard]] bool fitted() const { return calibrating > 0; }
};

/// How the idle term is treated.
enum class IdleTerm {
  none,   ///< the thesis' model: gross rates, the frame's time is the sum of its work
  given,  ///< the general model with the idle power that the caller measured
  fit,    ///< the general model, idle power fitted as well
};

/// Fits watts by least squares over the observations that calibrate: sum_k P_k t_ik = E_i (- P_idle
/// T_i). Rows are divided by E_i, so that the relative errors are made small and long operations
/// weigh no more than short ones.
///
/// A rate's half-width is the larger of what the scatter about the fit and what the joules'
/// own half-widths imply. The fit is refused, and `problem` says why, if there are fewer
/// observations than rates, if the column-scaled condition number is above 100 (idle power beside
/// work that fills every frame), or if a rate comes out negative; from 30 on it is doubted.
/// Joules that are not positive make std::invalid_argument.
RateFit fit_rates(std::span<const std::string> names,
                  std::span<const ModelObservation> observations, IdleTerm idle_term,
                  Uncertain idle_watts = {});

ModelErrors sum_errors(std::span<const double> errors);
/// Of the checks of observations with this `calibrates`.
ModelErrors errors_of(const RateFit& fit, std::span<const ModelObservation> observations,
                      bool calibrates);

}  // namespace encore::energy
