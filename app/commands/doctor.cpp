#include "app/doctor.h"

#include "app/commands/commands.h"
#include "app/interrupt.h"
#include "energy/sources/discover.h"

#include <fmt/format.h>

#include <memory>

namespace encore::app {

namespace {

struct DoctorOptions {
  bool json = false;
  std::string sensor_root = "/";
  double seconds = 2.0;
  bool all = false;
};

}  // namespace

void add_doctor_command(CLI::App& app, ExitCode& result) {
  auto* command = app.add_subcommand("doctor",
                                     "Say which power sensors this machine has, what they include "
                                     "and what is in the way; and which "
                                     "OpenGL devices");
  const auto options = std::make_shared<DoctorOptions>();
  command->add_flag("--json", options->json, "Print the result as JSON on standard output");
  command->add_option("--seconds", options->seconds, "How long to observe the sensors (default 2)")
      ->check(CLI::Range(0.1, 3600.0));
  command->add_flag("--all", options->all,
                    "Also read sensors that are set aside because that may wake a GPU");
  command
      ->add_option("--sysfs-root", options->sensor_root,
                   "Folder that stands for / when sensors are looked for")
      ->check(CLI::ExistingDirectory);
  command->footer("Exit codes: 0 at least one sensor can be used, 4 none can.");
  command->callback([options, &result] {
    const energy::SensorRoot root(options->sensor_root);
    const energy::SteadyClock clock;
    Observation observation;
    observation.length = energy::Seconds(options->seconds);
    observation.all = options->all;
    DoctorReport report =
        examine(energy::read_host(root), energy::discover(root), observation, clock, interrupted);
    // Afterwards, for it may wake a GPU.
    if (!interrupted) report.opengl = examine_opengl();
    fmt::print("{}", options->json ? doctor_json(report) : doctor_text(report));
    result = report.any_usable() ? ExitCode::ok : ExitCode::no_sensor;
    if (interrupted) result = ExitCode::interrupted;
  });
}

}  // namespace encore::app
