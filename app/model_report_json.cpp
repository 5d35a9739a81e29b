#include "app/json_text.h"
#include "app/model_report.h"
#include "app/session_input.h"

#include <fmt/format.h>

namespace encore::app {

namespace {

using energy::ModelErrors;
using energy::RateFit;
using energy::Uncertain;

std::string json_optional(std::optional<double> value) {
  return value ? json_number(*value) : "null";
}

std::string json_uncertain(const std::optional<Uncertain>& value, bool half_width_known) {
  if (!value) return "null";
  return fmt::format("{{\"value\": {}, \"ci95\": {}}}", json_number(value->value),
                     half_width_known ? json_number(value->half_width) : "null");
}

std::string json_errors(const ModelErrors& errors) {
  if (errors.count == 0) return "null";
  return fmt::format("{{\"count\": {}, \"mean\": {}, \"rms\": {}, \"worst\": {}}}", errors.count,
                     json_number(errors.mean), json_number(errors.rms), json_number(errors.worst));
}

std::string json_fit(const RateFit& fit, const ModelData& data) {
  std::string rates;
  for (std::size_t k = 0; k < data.rates.size(); ++k) {
    rates += fmt::format("{}{}: {}", k > 0 ? ", " : "", json_text(data.rates[k]),
                         json_uncertain(fit.rates[k], fit.half_widths_known));
  }
  return fmt::format(
      "{{\"fitted_to\": {}, \"idle_watts\": {}, \"idle_fitted\": {}, \"watts\": {{{}}}, "
      "\"residual\": {}, \"condition\": {}, \"problem\": {}, \"dynamic_errors\": {}}}",
      fit.calibrating, json_uncertain(fit.idle_watts, true), fit.idle_fitted, rates,
      json_optional(fit.residual), json_optional(fit.condition),
      fit.problem.empty() ? "null" : json_text(fit.problem),
      json_errors(energy::errors_of(fit, data.observations, false)));
}

/// What one model says of one observation.
std::string json_prediction(const RateFit& fit, std::size_t observation) {
  for (const energy::ModelCheck& check : fit.checks) {
    if (check.observation != observation) continue;
    return fmt::format(
        "{{\"joules\": {}, \"watts\": {}, \"operations_per_joule\": {}, \"error\": {}, "
        "\"assumed_share\": {}}}",
        json_uncertain(check.prediction.joules, fit.half_widths_known),
        json_uncertain(check.prediction.watts, fit.half_widths_known),
        json_uncertain(check.prediction.frames_per_joule, fit.half_widths_known),
        json_number(check.error), json_number(check.assumed_share));
  }
  return "null";
}

std::string json_own(const std::vector<OwnTests>& own, std::size_t observation) {
  for (const OwnTests& prediction : own) {
    if (prediction.observation != observation) continue;
    return fmt::format("{{\"joules\": {}, \"watts\": {}, \"error\": {}, \"outside\": {}}}",
                       json_number(prediction.joules), json_number(prediction.watts),
                       json_number(prediction.error), prediction.outside);
  }
  return "null";
}

std::string json_row(const ModelReport& report, std::size_t i) {
  const ModelData& data = report.by_phase;
  const energy::ModelObservation& seen = data.observations[i];
  std::string configuration;
  for (const energy::KeyValue& part : data.configurations[i]) {
    configuration += fmt::format("{}{}: {}", configuration.empty() ? "" : ", ", json_text(part.key),
                                 json_text(part.value));
  }
  double busy = 0.0;
  for (const energy::FrameWork& work : seen.work) busy += work.seconds.value;
  return fmt::format(
      "{{\"configuration\": {{{}}}, \"held_back\": {}, \"seconds\": {}, \"busy_share\": {}, "
      "\"watts\": {}, \"joules\": {}, \"operations_a_charge\": {}, \"one_rate_a_processor\": {}, "
      "\"one_rate_a_phase\": {}, \"own_tests\": {}, \"above_idle\": {}}}",
      configuration, !seen.calibrates, json_number(seen.seconds.value),
      json_number(busy / seen.seconds.value), json_number(data.measured_watts[i]),
      json_uncertain(seen.joules, seen.joules.half_width > 0.0),
      report.battery_wh ? json_number(*report.battery_wh * 3600.0 / seen.joules.value) : "null",
      json_prediction(report.processor, i), json_prediction(report.phase, i),
      json_own(report.own, i), json_prediction(report.general, i));
}

}  // namespace

std::string model_json(const ModelReport& report) {
  std::string rows;
  for (std::size_t i = 0; i < report.by_phase.observations.size(); ++i) {
    rows += (i > 0 ? ",\n    " : "\n    ") + json_row(report, i);
  }
  std::string caveats;
  for (const std::string& caveat : model_caveats(report)) {
    caveats += (caveats.empty() ? "\n    " : ",\n    ") + json_text(caveat);
  }
  return fmt::format(
      "{{\n  \"session\": {},\n  \"energy\": {{\"provenance\": {}, \"source\": {}}},\n  "
      "\"idle_watts\": {},\n  \"one_rate_a_processor\": {},\n  \"one_rate_a_phase\": {},\n  "
      "\"own_tests\": {{\"dynamic_errors\": {}}},\n  \"above_idle\": {},\n  \"configurations\": "
      "[{}\n  ],\n  \"caveats\": [{}\n  ]\n}}\n",
      json_text(report.folder), json_text(to_string(report.info.sensor.origin)),
      json_text(sensor_name(report.info)), json_uncertain(report.idle, !report.idle_given),
      json_fit(report.processor, report.by_processor), json_fit(report.phase, report.by_phase),
      json_errors(errors_of(report.own)), json_fit(report.general, report.by_phase), rows, caveats);
}

}  // namespace encore::app
