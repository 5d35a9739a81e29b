#include "app/commands/commands.h"
#include "app/model_report.h"
#include "app/session_input.h"
#include "app/terminal.h"

#include <fmt/format.h>

#include <memory>

namespace encore::app {

namespace {

struct ModelCommandOptions : ModelOptions {
  std::string session;
  std::string calibration;
  bool json = false;
  bool quiet = false;
};

ExitCode show_model(const ModelCommandOptions& options) {
  const energy::Session session = open_session(options.session);
  const ModelReport report = make_model_report(options.session, session, options);
  if (!options.calibration.empty()) {
    energy::write_calibration(options.calibration, calibration_of(report));
    Terminal(options.quiet).info("constants written to " + options.calibration);
  }
  fmt::print("{}", options.json ? model_json(report) : model_text(report));
  return ExitCode::ok;
}

}  // namespace

void add_model_command(CLI::App& app, ExitCode& result) {
  auto* command = app.add_subcommand(
      "model", "Fit energy models to a session and hold their predictions to what was measured");
  const auto options = std::make_shared<ModelCommandOptions>();
  command->add_option("session", options->session, "Session folder")->required();
  command
      ->add_option("--idle", options->idle_watts,
                   "Idle power in watts; default: the session's own baselines")
      ->check(CLI::Range(0.0, 1e5));
  command
      ->add_option("--battery", options->battery_wh,
                   "Capacity in Wh: how many operations does a charge pay for?")
      ->check(CLI::Range(0.001, 1e6));
  command->add_option("--save-calibration", options->calibration,
                      "Write the model above idle to a file of constants for a power model");
  command->add_flag("--json", options->json, "Print the result as JSON on standard output");
  command->add_flag("--quiet,-q", options->quiet, "No information");
  command->footer(
      "Rates are fitted to the build and static tests of the session. Dynamic tests are held "
      "back:\n"
      "their joules are predicted from those rates and their own times, and compared. The thesis'\n"
      "models take work to follow work without gaps; the model above idle allows gaps and\n"
      "overlap, and needs the idle power. Frames a joule is frames a second over watts.");
  command->callback([options, &result] { result = show_model(*options); });
}

}  // namespace encore::app
