#pragma once

#include "app/model_session.h"
#include "energy/model/model_fit.h"
#include "energy/session.h"
#include "energy/sources/calibration.h"

#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// What the user adds to a session.
struct ModelOptions {
  std::optional<double> idle_watts = {};  ///< instead of the session's own baselines
  std::optional<double> battery_wh = {};  ///< for the number of frames a charge pays for
};

/// The energy models of one session, and how well they hold.
struct ModelReport {
  std::string folder;
  energy::SessionInfo info;
  std::optional<double> battery_wh;
  std::optional<energy::Uncertain> idle;
  bool idle_given = false;  ///< by the user
  ModelData by_processor;
  ModelData by_phase;
  energy::RateFit processor;  ///< thesis, section 6
  energy::RateFit phase;      ///< thesis, section 5.3.3
  energy::RateFit general;    ///< above idle, a rate a phase
  std::vector<OwnTests> own;
};

/// Fits the models to a session. Throws scene::InputError if it has no joules.
ModelReport make_model_report(const std::string& folder, const energy::Session& session,
                              const ModelOptions& options);

/// For people: the rates, predicted against measured for each configuration, the errors of each
/// model, and what they do not cover.
std::string model_text(const ModelReport& report);

/// The same as one JSON object; what does not exist is null.
std::string model_json(const ModelReport& report);

/// What the models do not cover in this session; one sentence each.
std::vector<std::string> model_caveats(const ModelReport& report);

/// The general model as constants for `encore profile --model`. Throws UsageError if there is no
/// such fit.
energy::Calibration calibration_of(const ModelReport& report);

}  // namespace encore::app
