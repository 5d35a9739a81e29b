#include "app/battery_report.h"
#include "app/commands/commands.h"
#include "app/common_options.h"
#include "app/time_constant_report.h"
#include "energy/battery_life/battery_toml.h"
#include "energy/battery_life/present.h"
#include "energy/session_csv.h"
#include "scene/diagnostics.h"
#include "scene/text_suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace encore::app {

namespace {

struct BatteryOptions : CommonOptions {
  std::string watts;
  std::optional<double> joules;
  std::string session;
  std::string file;
  std::string preset;
  std::string model = "all";
  std::string sensor_root = "/";
  bool steps = false;
  std::string csv;
  std::string plot;
};

/// "30", "30±1" or "30+-1": watts, with the half-width of their interval.
energy::BatteryLoad parse_load(const std::string& text) {
  const auto wrong = [&]() -> UsageError {
    return UsageError(
        fmt::format("--watts: '{}' is not a load such as 30 or 30±1 (watts, 0 or more)", text));
  };
  const auto number = [&](std::string_view word) {
    word.remove_prefix(std::min(word.find_first_not_of(' '), word.size()));
    word = word.substr(0, word.find_last_not_of(' ') + 1);
    // Through CLI11, which reads numbers the same way everywhere in the program.
    double value = 0.0;
    if (word.empty() || !CLI::detail::lexical_cast(std::string(word), value)) throw wrong();
    if (!std::isfinite(value) || value < 0.0) throw wrong();
    return energy::Watts(value);
  };
  for (const std::string_view sign : {"±", "+-", "+/-"}) {
    const std::size_t at = text.find(sign);
    if (at == std::string::npos) continue;
    const std::string_view all = text;
    return {number(all.substr(0, at)), number(all.substr(at + sign.size()))};
  }
  return {number(text), std::nullopt};
}

std::vector<energy::BatteryModel> parse_models(const std::string& word) {
  if (word == "all") return {energy::kBatteryModels.begin(), energy::kBatteryModels.end()};
  if (const auto model = energy::parse_battery_model(word)) return {*model};
  std::vector<std::string_view> names{"all"};
  for (const auto model : energy::kBatteryModels) names.push_back(energy::to_string(model));
  throw UsageError(fmt::format("--model: unknown model '{}'; there are {}{}", word,
                               fmt::join(names, ", "), scene::did_you_mean(word, names)));
}

energy::Battery preset_battery(const std::string& name) {
  if (auto battery = energy::battery_preset(name)) return *battery;
  const auto names = energy::battery_presets();
  throw UsageError(fmt::format("--preset: unknown battery '{}'; there are {}{}", name,
                               fmt::join(names, ", "), scene::did_you_mean(name, names)));
}

energy::Battery chosen_battery(const BatteryOptions& options, Terminal& terminal) {
  if (!options.file.empty()) return energy::read_battery_toml(options.file);
  if (!options.preset.empty()) return preset_battery(options.preset);
  const auto state = energy::read_battery_state(energy::SensorRoot(options.sensor_root));
  if (!state) {
    throw UsageError(
        fmt::format("this machine has no battery; give --preset NAME ({}) or "
                    "--battery FILE.toml (docs/battery-life.md)",
                    fmt::join(energy::battery_presets(), ", ")));
  }
  if (state->on_mains.value_or(false)) {
    terminal.warning(state->name + " is being charged; the forecast is for unplugging it now");
  }
  return energy::battery_present(*state);
}

std::vector<BatteryCase> chosen_loads(const BatteryOptions& options, Terminal& terminal) {
  if (!options.session.empty()) {
    const energy::Session session = energy::read_session(options.session);
    std::size_t without = 0;
    std::vector<BatteryCase> cases = session_cases(session, without);
    if (cases.empty()) {
      throw scene::InputError(
          fmt::format("{}: no row has watts ({}: {}); give the load with "
                      "--watts",
                      options.session, energy::to_string(session.info.sensor.origin),
                      session.info.sensor.detail));
    }
    if (without > 0) {
      terminal.warning(fmt::format("{}: {} of {} rows have no watts and are left out",
                                   options.session, without, without + cases.size()));
    }
    return cases;
  }
  BatteryCase load;
  load.load = parse_load(options.watts);
  if (options.joules) load.each = energy::Joules(*options.joules);
  load.origin = {energy::Origin::modelled, "given with --watts"};
  return {load};
}

ExitCode print_battery(const BatteryOptions& options) {
  const bool has_load = !options.watts.empty() || !options.session.empty();
  if (!has_load && !options.steps) {
    throw UsageError(
        "battery: what is the load? encore battery --watts W[±w] | --session DIR "
        "[--preset NAME | --battery FILE.toml]; or --steps");
  }
  Terminal terminal(options.quiet);
  BatteryReport report;
  report.models = parse_models(options.model);
  if (has_load) report.cases = chosen_loads(options, terminal);
  report.battery = chosen_battery(options, terminal);
  StepStudy study;
  if (options.steps) {
    // Without a load, one that takes about two hours.
    const energy::Watts load = has_load ? report.cases.front().load.watts
                                        : energy::Watts(report.battery.full.value / 7200.0);
    study.battery = energy::study_steps(report.battery, load, energy::SteadyClock());
    study.time_constants = energy::study_time_constants(energy::SteadyClock());
  }
  if (!options.csv.empty()) write_step_csv(options.csv, study);
  if (!options.plot.empty()) write_plots_svg(options.plot, step_plots(study));
  if (options.json) {
    fmt::print("{{\n  {}{}\n}}\n", battery_json(report),
               options.steps ? fmt::format(",\n  {},\n  {}", step_json(study.battery),
                                           time_constant_json(study.time_constants))
                             : "");
  } else {
    fmt::print("{}", battery_text(report));
    if (options.steps) {
      fmt::print("\n{}\n{}", step_text(study.battery), time_constant_text(study.time_constants));
    }
  }
  return ExitCode::ok;
}

}  // namespace

void add_battery_command(CLI::App& app, ExitCode& result) {
  auto* command =
      app.add_subcommand("battery", "How long a battery lasts at a load: minutes and frames left");
  const auto options = std::make_shared<BatteryOptions>();
  auto* watts = command->add_option("--watts,-w", options->watts,
                                    "The load: 30, or 30±1 (also 30+-1) with its 95 % interval");
  auto* session = command->add_option(
      "--session", options->session,
      "The loads, and the joules of a frame, of a session folder that profile wrote");
  watts->excludes(session);
  command
      ->add_option("--joules", options->joules,
                   "With --watts: joules of one frame, to count frames")
      ->needs(watts)
      ->check(CLI::PositiveNumber);
  auto* file = command->add_option("--battery", options->file,
                                   "A TOML file with a table [battery] (docs/battery-life.md)");
  command
      ->add_option("--preset", options->preset,
                   fmt::format("A known battery: {}; without it and --battery, the one present",
                               fmt::join(energy::battery_presets(), ", ")))
      ->excludes(file);
  command->add_option("--model,-m", options->model,
                      "all (default), constant, peukert, kinetic or thevenin");
  auto* steps = command->add_flag(
      "--steps", options->steps,
      "Also show error against step size (1 ms to 10 h) and run time of the models, and of gauge "
      "filters and drift fits with time constants from 1 ms to 1e6 s");
  command->add_option("--csv", options->csv, "With --steps: write every combination to this file")
      ->needs(steps);
  command
      ->add_option("--plot", options->plot,
                   "With --steps: draw error against step size and run time, an SVG picture")
      ->needs(steps);
  command->add_option("--sysfs-root", options->sensor_root,
                      "Look for the battery below this folder instead of /");
  add_output_options(*command, *options);
  command->callback([options, &result] {
    try {
      result = print_battery(*options);
    } catch (const energy::BatteryError& error) {
      throw scene::InputError(error.what());
    } catch (const energy::SessionError& error) {
      throw scene::InputError(error.what());
    }
  });
}

}  // namespace encore::app
