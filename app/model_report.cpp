#include "app/model_report.h"

#include "app/exit_code.h"
#include "app/session_input.h"
#include "scene/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace encore::app {

namespace {

using energy::IdleTerm;
using energy::RateFit;

/// Fits above idle: with the idle power that is known, else by fitting it as well.
RateFit fit_general(const ModelReport& report) {
  const ModelData& data = report.by_phase;
  if (report.idle) {
    return energy::fit_rates(data.rates, data.observations, IdleTerm::given, *report.idle);
  }
  return energy::fit_rates(data.rates, data.observations, IdleTerm::fit);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// Names of rates that no build or static test shows although dynamic ones have such work.
std::vector<std::string> missing_rates(const ModelReport& report) {
  std::vector<std::string> missing;
  if (!report.phase.fitted()) return missing;
  for (std::size_t k = 0; k < report.phase.rates.size(); ++k) {
    if (!report.phase.rates[k]) missing.push_back(report.by_phase.rates[k]);
  }
  return missing;
}

}  // namespace

ModelReport make_model_report(const std::string& folder, const energy::Session& session,
                              const ModelOptions& options) {
  ModelReport report;
  report.folder = folder;
  report.info = session.info;
  report.battery_wh = options.battery_wh;
  report.by_processor = model_data(session, RateGrouping::processor);
  report.by_phase = model_data(session, RateGrouping::phase);
  if (report.by_phase.observations.empty()) {
    throw scene::InputError(
        fmt::format("{}: no configuration has joules ({}); profile with a power source or --model",
                    folder, session.info.sensor.detail));
  }
  report.idle = idle_watts(session);
  if (options.idle_watts) {
    report.idle = energy::Uncertain{*options.idle_watts, 0.0};
    report.idle_given = true;
  }
  report.processor = energy::fit_rates(report.by_processor.rates, report.by_processor.observations,
                                       IdleTerm::none);
  report.phase =
      energy::fit_rates(report.by_phase.rates, report.by_phase.observations, IdleTerm::none);
  report.general = fit_general(report);
  report.own = predict_from_own_tests(report.by_phase);
  return report;
}

std::vector<std::string> model_caveats(const ModelReport& report) {
  std::vector<std::string> caveats;
  if (report.info.sensor.origin == energy::Origin::modelled ||
      report.info.sensor.origin == energy::Origin::simulated) {
    caveats.push_back(fmt::format(
        "the joules are {}: agreement shows that the arithmetic is right, nothing of the machine",
        to_string(report.info.sensor.origin)));
  }
  const auto& observations = report.by_phase.observations;
  const auto held_back = [](const auto& seen) { return !seen.calibrates; };
  if (std::none_of(observations.begin(), observations.end(), held_back)) {
    caveats.emplace_back(
        "there is no dynamic test, so nothing was predicted that the fit had not seen; profile a "
        "moving scene with --test build,static,dynamic");
  }
  const auto loose =
      std::count_if(report.by_phase.observations.begin(), report.by_phase.observations.end(),
                    [](const energy::ModelObservation& seen) {
                      double busy = 0.0;
                      for (const energy::FrameWork& work : seen.work) busy += work.seconds.value;
                      return std::fabs(busy / seen.seconds.value - 1.0) > 0.05;
                    });
  if (loose > 0) {
    caveats.push_back(fmt::format(
        "in {} of {} configurations the phases fill less than 95 % of the time: the thesis' model "
        "does not hold there, only the one above idle",
        loose, observations.size()));
  }
  const auto outside = std::count_if(report.own.begin(), report.own.end(),
                                     [](const OwnTests& own) { return own.outside; });
  if (outside > 0) {
    caveats.push_back(
        fmt::format("{} of {} dynamic configurations draw more or less than both their build and "
                    "their static test: no mix of the two rates explains them",
                    outside, report.own.size()));
  }
  if (const auto missing = missing_rates(report); !missing.empty()) {
    caveats.push_back(fmt::format(
        "no test isolates {}: its power is taken as the mean of the rest, as the thesis does",
        joined(missing)));
  }
  if (report.info.sensor.origin == energy::Origin::measured) {
    caveats.push_back(fmt::format(
        "intervals leave out the gain error of the power source, ±{:.2g} % of all watts "
        "and joules alike",
        196.0 * gain_uncertainty(report.info)));
  }
  caveats.emplace_back(
      "rates hold for this machine, program and state of cooling; other scenes and structures "
      "need not follow them");
  return caveats;
}

energy::Calibration calibration_of(const ModelReport& report) {
  if (!report.general.fitted() || !report.general.idle_watts) {
    throw UsageError(fmt::format(
        "--save-calibration: there is no model above idle: {}",
        report.general.problem.empty() ? "idle power is not known" : report.general.problem));
  }
  energy::Calibration calibration;
  calibration.model.idle = energy::Watts(report.general.idle_watts->value);
  for (std::size_t k = 0; k < report.by_phase.rates.size(); ++k) {
    if (!report.general.rates[k]) continue;
    const energy::Watts watts(report.general.rates[k]->value);
    const std::string& name = report.by_phase.rates[k];
    auto& delta = calibration.model.delta;
    if (name == "build") {
      // Animation and updates without a test of their own were counted as builds.
      for (const energy::Phase phase :
           {energy::Phase::animate, energy::Phase::build, energy::Phase::update}) {
        if (!delta[phase]) delta[phase] = watts;
      }
    } else if (name == "update") {
      delta[energy::Phase::update] = watts;
    } else if (name == "transfer") {
      delta[energy::Phase::transfer] = watts;
    } else if (name == "render (cpu)") {
      delta[energy::Phase::render] = watts;
    } else {
      calibration.model.gpu = watts;
    }
  }

  // As sure as the sensor was, and as the fit is.
  const double scatter =
      std::max(report.general.residual.value_or(0.0),
               energy::errors_of(report.general, report.by_phase.observations, false).rms);
  calibration.model.uncertainty = std::min(1.0, std::hypot(gain_uncertainty(report.info), scatter));
  calibration.machine = report.info.machine.cpu_model.value_or("");
  calibration.measured_utc = report.info.started_utc;
  calibration.method = fmt::format(
      "encore model: least squares over {} build and static configurations of session {}, idle "
      "power {}",
      report.general.calibrating, report.folder,
      report.idle_given            ? "given"
      : report.general.idle_fitted ? "fitted"
                                   : "from its baselines");
  return calibration;
}

}  // namespace encore::app
