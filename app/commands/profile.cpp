#include "app/commands/commands.h"
#include "app/interrupt.h"
#include "app/profile_run.h"
#include "app/ray_options.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>

namespace encore::app {

namespace {

void add_profile_options(CLI::App& command, ProfileOptions& options,
                         std::optional<int>& gl_device) {
  add_scene_options(command, options, true);
  add_structure_options(command, options, true);
  command
      .add_option(
          "--policy,-p", options.policies,
          "What a moving scene does to the structure: rebuild, refit, auto (refit until it has "
          "decayed), static; several separated by commas; default: the scene's own, else "
          "rebuild")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      .add_option(
          "--test", options.tests,
          "build (a loop of builds, of updates with --policy refit), static (one build, "
          "then frames), dynamic (animate, build or update, render), forced (the same though "
          "nothing moves); several separated by commas; default: the first three that apply")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--size", options.size, "Picture: a side or WIDTHxHEIGHT (default 256)");
  add_plan_options(command, options.measuring);
  add_source_options(command, options.measuring);
  command.add_option("--out,-o", options.out,
                     "New or empty folder for the session; default: one in "
                     "$XDG_DATA_HOME/encore/sessions (~/.local/share)");
  command.add_option("--build-on", options.build_on,
                     "Where a tree for device gpu is built every frame: auto (default: on a real "
                     "GPU where it can), cpu, device (bvh-sah, preset fast, policy rebuild)");
  command.add_option("--update-case", options.update_case,
                     "Leaves that a refit treats as changed: real (default), best (none), average "
                     "(60 %), worst (all)");
  command
      .add_option("--device", options.devices,
                  "Who draws: cpu, gpu (traces rays in OpenGL compute shaders), raster (OpenGL's "
                  "own pipeline, without structure); several separated by commas, such as "
                  "cpu,gpu,raster, are measured one after another into one session; default: the "
                  "scene's own, else cpu")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_gl_device_option(command, gl_device);
  add_thread_option(command, options);
  add_ray_options(command, options);
  add_output_options(command, options);
}

}  // namespace

void add_profile_command(CLI::App& app, ExitCode& result) {
  auto* command = app.add_subcommand(
      "profile", "Measure what structures cost to build, update and trace, and save the session");
  const auto options = std::make_shared<ProfileOptions>();
  const auto gl_device = std::make_shared<std::optional<int>>();
  add_profile_options(*command, *options, *gl_device);
  command->footer(
      "Before a structure is measured, a sample of its hits is compared with brute force; exit\n"
      "code 6 if they differ. Without OpenGL 4.3 the devices gpu and raster end with exit code 5\n"
      "before anything is measured. Ctrl+C keeps and prints what was measured so far (exit code "
      "130).\n"
      "The session folder holds session.toml and CSV files; see docs/session-format.md. Joules "
      "come\n"
      "from the sensors that 'encore doctor' lists; how far to trust them: docs/measuring.md.");
  command->callback([options, gl_device, &result] {
    Terminal terminal(options->quiet);
    const WorkloadTools tools = standard_tools(std::make_shared<GpuContext>(*gl_device));
    const ProfileResult profile = run_profile(*options, tools, interrupted, terminal);
    fmt::print("{}", profile.output);
    std::fflush(stdout);
    result = profile.code;
  });
}

}  // namespace encore::app
