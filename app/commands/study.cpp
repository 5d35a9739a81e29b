#include "app/commands/commands.h"
#include "app/interrupt.h"
#include "app/study_run.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>

namespace encore::app {

void add_study_command(CLI::App& app, ExitCode& result) {
  auto* command = app.add_subcommand(
      "study", "Measure a whole study that a file describes, into one session; can be resumed");
  const auto options = std::make_shared<StudyOptions>();
  const auto quiet = std::make_shared<bool>(false);
  const auto gl_device = std::make_shared<std::optional<int>>();
  command
      ->add_option(
          "study", options->file,
          "The study's file (.toml), or one that ships: quick, thesis; see docs/studies.md")
      ->required();
  command->add_flag("--dry-run", options->dry_run,
                    "Check everything, tell how many tests and how long, and measure nothing");
  auto* out = command->add_option("--out,-o", options->out,
                                  "New or empty folder for the session; default: one in "
                                  "$XDG_DATA_HOME/encore/sessions (~/.local/share)");
  command
      ->add_option("--resume", options->resume,
                   "Go on with the session in this folder: what it holds is not repeated")
      ->excludes(out);
  add_plan_options(*command, options->measuring);
  add_source_options(*command, options->measuring);
  add_gl_device_option(*command, *gl_device);
  command->add_flag("--json", options->json, "Print the result as JSON on standard output");
  command->add_flag("--quiet,-q", *quiet, "No progress, information or warnings");
  command->footer(
      "Options of plan and source go before what the file says. Ctrl+Z pauses after the test that\n"
      "runs (fg goes on); Ctrl+C ends and keeps what was measured (exit code 130), --resume goes\n"
      "on from there, also after a crash. Tests of the devices gpu and raster are left out, with "
      "a\n"
      "word, where there is no OpenGL 4.3.");
  command->callback([options, quiet, gl_device, &result] {
    Terminal terminal(*quiet);
    install_pause_handler();
    const PausePoint pause = [&terminal] { return pause_if_asked(terminal); };
    const WorkloadTools tools = standard_tools(std::make_shared<GpuContext>(*gl_device));
    const StudyResult study = run_study(*options, tools, interrupted, pause, terminal);
    fmt::print("{}", study.output);
    std::fflush(stdout);
    result = study.code;
  });
}

}  // namespace encore::app
