#include "app/attach.h"

#include "app/commands/commands.h"
#include "app/profile_folder.h"
#include "app/session_input.h"
#include "app/terminal.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace encore::app {

namespace {

struct AttachCommandOptions {
  std::string session;
  std::string recording;
  std::string out;
  std::optional<double> offset;
  std::optional<double> near;
  double within = AttachOptions{}.within.value;
  bool json = false;
  bool quiet = false;
};

std::optional<energy::Seconds> seconds(std::optional<double> value, const char* option) {
  if (!value) return std::nullopt;
  if (!std::isfinite(*value)) throw UsageError(fmt::format("{}: {} is no time", option, *value));
  return energy::Seconds(*value);
}

ExitCode attach(const AttachCommandOptions& options) {
  const AttachOptions known{seconds(options.offset, "--offset"), seconds(options.near, "--near"),
                            energy::Seconds(options.within)};
  const energy::Session session = open_session(options.session);
  const energy::Recording recording = open_recording(options.recording);
  const Attached attached = attach_recording(options.session, session, recording, known);
  Terminal terminal(options.quiet);
  for (const std::string& warning : attached.warnings) terminal.warning(warning);

  const auto folder = make_session_folder(options.out, session.info.started_utc, "");
  write_attached(folder, options.session, attached);
  const ProfileReport report = attach_report(folder, attached);
  fmt::print("{}", options.json ? report_json(report) : report_text(report));
  return ExitCode::ok;
}

}  // namespace

void add_attach_command(CLI::App& app, ExitCode& result) {
  auto* command = app.add_subcommand(
      "attach", "Give a session the energies that a meter recorded meanwhile on its own clock");
  const auto options = std::make_shared<AttachCommandOptions>();
  command->add_option("session", options->session, "Session folder; it is not changed")->required();
  command->add_option("recording", options->recording, "The meter's CSV file")->required();
  command->add_option("--out", options->out, "Folder of the new session: new or empty")->required();
  auto* offset = command->add_option(
      "--offset", options->offset,
      "Seconds to add to the recording's times to get the session's; default: found by the steps "
      "of load");
  auto* near = command
                   ->add_option("--near", options->near,
                                "Roughly the offset, for a load that repeats itself")
                   ->excludes(offset);
  command
      ->add_option(
          "--within", options->within,
          "Seconds that the offset may lie from --near (default 5); less than half of what "
          "a configuration takes tells repeats apart")
      ->needs(near)
      ->check(CLI::Range(0.1, 1e6));
  command->add_flag("--json", options->json, "Print the result as JSON on standard output");
  command->add_flag("--quiet,-q", options->quiet, "No warnings");
  command->footer(
      "The recording needs a column of time in seconds and one of watts, joules or volts and\n"
      "amperes. It is aligned by the session's busy and idle times: record all of it, and let\n"
      "'encore profile' idle between configurations (--idle). What cannot be aligned surely is\n"
      "refused with exit code 3; docs/measuring.md tells more.");
  command->callback([options, &result] { result = attach(*options); });
}

}  // namespace encore::app
