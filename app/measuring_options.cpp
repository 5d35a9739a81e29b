#include "app/measuring_options.h"

#include "app/exit_code.h"
#include "energy/csv.h"
#include "scene/text_suggestion.h"

#include <fmt/format.h>

#include <iterator>

namespace encore::app {

namespace {

constexpr double kLongest = 1e6;  ///< seconds: eleven days

energy::Plan named_plan(const std::string& name, bool has_sources) {
  if (name.empty()) return has_sources ? energy::settle_plan() : energy::quick_plan();
  if (const auto plan = energy::plan_by_name(name)) return *plan;
  const std::vector<std::string_view> names(std::begin(energy::kPlanNames),
                                            std::end(energy::kPlanNames));
  throw UsageError(fmt::format("unknown plan '{}'{}; there are {}", name,
                               scene::did_you_mean(name, names), fmt::join(names, ", ")));
}

}  // namespace

double parse_share(const std::string& text, const std::string& option) {
  std::string number = text;
  double scale = 1.0;
  if (number.ends_with('%')) {
    number.pop_back();
    scale = 0.01;
  }
  while (number.ends_with(' ')) number.pop_back();
  const auto value = energy::parse_csv_number(number);
  if (!value || !(*value * scale > 0.0) || !(*value * scale < 1.0)) {
    throw UsageError(
        fmt::format("{} {}: not a share between 0 and 100 %, such as 1%", option, text));
  }
  return *value * scale;
}

void add_plan_options(CLI::App& command, MeasuringOptions& options) {
  const auto seconds = CLI::Range(0.0, kLongest);
  command.add_option(
      "--plan", options.plan,
      "quick (seconds; the default without a power source), settle (as long as the sensor needs; "
      "the default with one), thesis (10 s idle, 180 s, 10 s idle, read at 1 Hz, cut below 24 W)");
  command
      .add_option("--seconds", options.seconds,
                  "Seconds to measure each configuration, at least three operations (default: the "
                  "plan's, quick 1.5); longer narrows the confidence intervals")
      ->check(seconds);
  command
      .add_option("--idle", options.idle, "Seconds of idling before and after, for the baseline")
      ->check(seconds);
  command.add_option("--warm-up", options.warm_up, "Seconds of operations that do not count")
      ->check(seconds);
  command
      .add_option("--mix", options.mix,
                  "Seconds of blocks that repeat single phases, to tell apart phases that are too "
                  "short for the sensor; 0: none")
      ->check(seconds);
  command
      .add_option("--cool-down", options.cool_down,
                  "Seconds to pause before each configuration, so that all start equally warm")
      ->check(seconds);
  command
      .add_option("--poll", options.poll,
                  "Seconds between readings of the power sources (default: as each needs)")
      ->check(CLI::Range(0.001, 3600.0));
  command.add_option(
      "--cut", options.cut,
      "Leave samples of a gauge below so many watts out, as the thesis did (biased); "
      "'none' turns it off");
  command.add_option("--until", options.until,
                     "Measure each configuration until its 95 % interval is within this share of "
                     "the mean, such as 1%");
  command
      .add_option("--until-limit", options.until_limit,
                  "Most seconds to spend on --until (default 600)")
      ->check(seconds);
  command.add_option("--repeats", options.repeats, "Measure every configuration so many times")
      ->check(CLI::Range(1U, 10000U));
  command.add_option("--order", options.order,
                     "listed (default), abba (every second repeat backwards), shuffled");
  command.add_option("--seed", options.seed, "Of the shuffled order and the mixed blocks");
}

void add_source_options(CLI::App& command, MeasuringOptions& options) {
  command
      .add_option("--source", options.sources,
                  "Power source: auto (default), none, a name or kind that 'encore doctor' lists "
                  "(rapl:package-0, battery), meter:..., replay:FILE.csv, model:CONSTANTS, "
                  "simulated:rapl|nvml|battery; repeat the option to read several together")
      ->allow_extra_args(false);
  command.add_option("--model", options.model,
                     "Constants for modelled energy where there is no sensor: idle=12,build=18,"
                     "render=20 (watts, above idle), thesis-laptop, or a calibration file; "
                     "with a simulated source, what that sensor sees");
  command.add_option("--sysfs-root", options.sensor_root,
                     "Folder that stands for / when sensors are looked for");
}

energy::Plan make_plan(const MeasuringOptions& options,
                       std::span<const energy::SourceInfo> sources) {
  using energy::Seconds;
  const energy::Plan named = named_plan(options.plan, !sources.empty());
  energy::Plan plan = energy::fit_to_sources(named, sources);
  if (options.seconds) plan.run = Seconds(*options.seconds);
  // Warming up longer than measuring would surprise whoever asked for a short run.
  if (options.seconds) plan.warm_up = std::min(plan.warm_up, plan.run);
  if (options.idle) plan.idle_before = plan.idle_after = Seconds(*options.idle);
  if (options.mix) plan.mix = Seconds(*options.mix);
  if (options.warm_up) plan.warm_up = Seconds(*options.warm_up);
  if (options.cool_down) plan.cool_down = Seconds(*options.cool_down);
  if (options.poll) plan.poll = Seconds(*options.poll);
  if (options.until_limit) plan.until_limit = Seconds(*options.until_limit);
  if (options.repeats) plan.repeats = *options.repeats;
  if (options.seed) plan.order_seed = plan.mix_seed = *options.seed;
  if (!options.until.empty()) plan.until = parse_share(options.until, "--until");
  if (options.cut == "none") {
    plan.cut_below.reset();
  } else if (!options.cut.empty()) {
    const auto watts = energy::parse_csv_number(options.cut);
    if (!watts || *watts < 0) {
      throw UsageError(fmt::format("--cut {}: not a number of watts, nor 'none'", options.cut));
    }
    plan.cut_below = energy::Watts(*watts);
  }
  if (!options.order.empty()) {
    const auto order = energy::parse_order(options.order);
    if (!order) {
      throw UsageError(
          fmt::format("unknown order '{}'; there are listed, abba, shuffled", options.order));
    }
    plan.order = *order;
  }
  return plan;
}

}  // namespace encore::app
