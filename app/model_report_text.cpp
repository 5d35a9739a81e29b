#include "app/model_report.h"
#include "app/profile_report.h"
#include "app/profile_table.h"
#include "app/session_input.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace encore::app {

namespace {

using energy::ModelCheck;
using energy::ModelErrors;
using energy::RateFit;
using energy::Uncertain;
using Align = TextTable::Align;

std::string watts_text(const Uncertain& watts, bool known) {
  return with_uncertainty(watts.value, known ? std::optional(watts.half_width) : std::nullopt) +
         " W";
}

std::string fit_text(const std::string& title, const RateFit& fit,
                     const std::vector<std::string>& names) {
  std::string text = title;
  if (!fit.fitted()) return text + fmt::format(": no fit; {}\n", fit.problem);
  text += fmt::format(" ({} configurations", fit.calibrating);
  if (fit.residual) text += fmt::format(", residual {:.1f} %", 100.0 * *fit.residual);
  text += ")\n";
  if (fit.idle_watts) {
    text += fmt::format("  {:<14} {}{}\n", "idle", watts_text(*fit.idle_watts, true),
                        fit.idle_fitted ? " (fitted)" : "");
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    text += fmt::format("  {:<14} {}\n", names[k],
                        fit.rates[k] ? watts_text(*fit.rates[k], fit.half_widths_known)
                                     : std::string("no test isolates it"));
  }
  if (!fit.problem.empty()) text += "  " + fit.problem + "\n";
  return text;
}

/// Errors by observation.
using ErrorMap = std::map<std::size_t, double>;

ErrorMap errors_by_observation(const RateFit& fit) {
  ErrorMap errors;
  for (const ModelCheck& check : fit.checks) errors[check.observation] = check.error;
  return errors;
}

ErrorMap errors_by_observation(const std::vector<OwnTests>& own) {
  ErrorMap errors;
  for (const OwnTests& prediction : own) errors[prediction.observation] = prediction.error;
  return errors;
}

/// "+1.2 %", and never "-0.0 %".
std::string signed_percent(double share) {
  return fmt::format("{:+.1f} %", std::round(1000.0 * share) / 10.0 + 0.0);
}

std::string error_text(const ErrorMap& errors, std::size_t observation) {
  const auto found = errors.find(observation);
  return found == errors.end() ? "" : signed_percent(found->second);
}

/// "19,000": large counts without decimals, small ones with three digits.
std::string number_text(double value) {
  return value >= 100.0 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

std::string check_table(const ModelReport& report) {
  TextTable table;
  table.add_column("configuration", Align::left);
  table.add_column("used", Align::left);
  for (const char* title : {"operations/s", "W", "J ± 95 % CI", "operations/J", "a charge", "busy",
                            "one rate a processor", "one a phase", "own tests", "above idle"}) {
    table.add_column(title);
  }
  const ErrorMap processor = errors_by_observation(report.processor);
  const ErrorMap phase = errors_by_observation(report.phase);
  const ErrorMap own = errors_by_observation(report.own);
  const ErrorMap general = errors_by_observation(report.general);
  for (std::size_t i = 0; i < report.by_phase.observations.size(); ++i) {
    const energy::ModelObservation& seen = report.by_phase.observations[i];
    double busy = 0.0;
    for (const energy::FrameWork& work : seen.work) busy += work.seconds.value;
    const double joules = seen.joules.value;
    table.add_row(
        {seen.name, seen.calibrates ? "to fit" : "to check", number_text(1.0 / seen.seconds.value),
         number_text(report.by_phase.measured_watts[i]),
         with_uncertainty(joules, seen.joules.half_width > 0.0
                                      ? std::optional(seen.joules.half_width)
                                      : std::nullopt),
         number_text(1.0 / joules),
         report.battery_wh ? number_text(*report.battery_wh * 3600.0 / joules) : "",
         fmt::format("{:.0f} %", 100.0 * busy / seen.seconds.value), error_text(processor, i),
         error_text(phase, i), error_text(own, i), error_text(general, i)});
  }
  return table.text();
}

std::string errors_text(const char* title, const ModelErrors& errors) {
  if (errors.count == 0) return {};
  return fmt::format("  {:<22} mean {}, rms {:.1f} %, worst {} of {}\n", title,
                     signed_percent(errors.mean), 100.0 * errors.rms, signed_percent(errors.worst),
                     errors.count);
}

}  // namespace

std::string model_text(const ModelReport& report) {
  std::string text =
      fmt::format("Session: {}\nEnergy: {} ({})\nIdle: {}\n\nRates\n", report.folder,
                  to_string(report.info.sensor.origin), sensor_name(report.info),
                  report.idle ? watts_text(*report.idle, !report.idle_given) +
                                    (report.idle_given ? ", given" : ", from its baselines")
                              : std::string("not measured; give it with --idle"));
  text += fit_text("one rate a processor, work after work (thesis, section 6)", report.processor,
                   report.by_processor.rates);
  text += fit_text("one rate a phase, work after work (thesis, section 5.3.3)", report.phase,
                   report.by_phase.rates);
  text += fit_text("above idle, one rate a phase, gaps and overlap allowed", report.general,
                   report.by_phase.rates);

  text += "\nPredicted joules an operation against measured\n" + check_table(report);
  const auto& observations = report.by_phase.observations;
  const std::string held_back =
      errors_text("one rate a processor",
                  energy::errors_of(report.processor, observations, false)) +
      errors_text("one rate a phase", energy::errors_of(report.phase, observations, false)) +
      errors_text("own build and static", errors_of(report.own)) +
      errors_text("above idle", energy::errors_of(report.general, observations, false));
  if (!held_back.empty()) text += "\nErrors on dynamic tests, which no fit saw\n" + held_back;

  text += "\n";
  for (const std::string& caveat : model_caveats(report)) text += "- " + caveat + "\n";
  return text;
}

}  // namespace encore::app
