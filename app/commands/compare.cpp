#include "app/commands/commands.h"
#include "app/compare_report.h"
#include "app/measuring_options.h"
#include "app/session_input.h"
#include "app/terminal.h"
#include "scene/diagnostics.h"

#include <fmt/format.h>

#include <memory>

namespace encore::app {

namespace {

struct CompareOptions {
  std::string a;
  std::string b;
  std::string tolerance;
  bool json = false;
  bool quiet = false;
};

ExitCode compare(const CompareOptions& options) {
  CompareReport report;
  if (!options.tolerance.empty()) {
    report.tolerance = parse_share(options.tolerance, "--tolerance");
  }
  const energy::Session a = open_session(options.a);
  const energy::Session b = open_session(options.b);
  report.folder_a = options.a;
  report.folder_b = options.b;
  report.info_a = a.info;
  report.info_b = b.info;
  report.comparison = compare_sessions(a, b, report.tolerance);
  if (report.comparison.matched.empty()) {
    throw scene::InputError(fmt::format(
        "{} and {} have no configuration in common; compare sessions of the same scenes, "
        "structures, tests and sizes",
        options.a, options.b));
  }

  Terminal terminal(options.quiet);
  if (!options.json) {
    for (const std::string& warning : report.comparison.warnings) terminal.warning(warning);
  }
  fmt::print("{}", options.json ? compare_json(report) : compare_text(report));
  return report.comparison.regressions() > 0 ? ExitCode::regression : ExitCode::ok;
}

}  // namespace

void add_compare_command(CLI::App& app, ExitCode& result) {
  auto* command = app.add_subcommand(
      "compare", "Compare two sessions: what got faster, what takes less energy");
  const auto options = std::make_shared<CompareOptions>();
  command->add_option("A", options->a, "Session folder to compare with")->required();
  command->add_option("B", options->b, "Session folder to compare")->required();
  command->add_option("--tolerance", options->tolerance,
                      "Exit with 7 if B takes more time or energy than A by surely more than this, "
                      "such as 5%");
  command->add_flag("--json", options->json, "Print the result as JSON on standard output");
  command->add_flag("--quiet,-q", options->quiet, "No warnings");
  command->footer(
      "Configurations match by scene, device, structure, policy, test and size; repeats are taken\n"
      "together. A difference counts if the 95 % interval of the ratio leaves out 1. A regression\n"
      "needs more: the whole interval of time or energy an operation must lie above 1 plus the\n"
      "tolerance; power alone is none. Watts and joules are compared only if both were measured,\n"
      "or both modelled; the gain error of the power source cancels only if both used the same.");
  command->callback([options, &result] { result = compare(*options); });
}

}  // namespace encore::app
