#include "app/power_sources.h"

#include "app/exit_code.h"
#include "app/model_constants.h"
#include "energy/sources/choose_total.h"
#include "energy/sources/csv_replay.h"
#include "energy/sources/discover.h"
#include "energy/sources/model_spec.h"
#include "energy/sources/simulated.h"
#include "energy/sources/source_spec.h"

#include <fmt/format.h>

#include <algorithm>

namespace encore::app {

namespace {

using energy::Finding;
using energy::LiveBusyTime;
using energy::PowerSource;
using energy::SensorError;

constexpr std::string_view kModelPrefix = "model:";
constexpr std::string_view kSimulatedPrefix = "simulated:";

/// The sensors of the machine, looked for once and only if somebody asks.
class Sensors {
 public:
  explicit Sensors(const std::string& root) : root_(root) {}
  const std::vector<Finding>& all() {
    if (!looked_) findings_ = energy::discover(energy::SensorRoot(root_));
    looked_ = true;
    return findings_;
  }

 private:
  std::string root_;
  bool looked_ = false;
  std::vector<Finding> findings_;
};

energy::PowerModel constants_of(const std::string& spec) {
  try {
    if (const auto constants = model_constants(spec)) return *constants;
  } catch (const energy::PowerModelError& error) {
    throw UsageError(fmt::format("--model: {}", error.what()));
  }
  throw UsageError(
      "--model: a simulated sensor needs a power for each phase, such as idle=12,build=18,"
      "render=20, not one for full load");
}

std::unique_ptr<PowerSource> open_model(const std::string& spec, const LiveBusyTime& live) {
  try {
    const energy::ModelSpec model = energy::parse_model_spec(spec);
    if (const auto* constants = std::get_if<energy::PowerModel>(&model)) {
      return energy::make_model_source(*constants, [&live](energy::Seconds now) {
        return energy::BusyTimes{live.busy(now), {}};
      });
    }
    const energy::SensorRoot root;
    return energy::make_utilisation_source(std::get<energy::UtilisationModel>(model), root,
                                           energy::load_scope(root));
  } catch (const energy::PowerModelError& error) {
    throw UsageError(fmt::format("--model: {}", error.what()));
  }
}

/// A simulated sensor that watches the work as a machine with known constants would draw power, so
/// that what is measured can be compared with the truth.
std::unique_ptr<PowerSource> open_simulated(const std::string& preset, const std::string& truth,
                                            const LiveBusyTime& live) {
  const std::vector<std::string> presets = energy::simulated_presets();
  if (std::find(presets.begin(), presets.end(), preset) == presets.end()) {
    throw UsageError(
        fmt::format("--source simulated:{}: there are {}", preset, fmt::join(presets, ", ")));
  }
  energy::SimulatedSettings settings = energy::simulated_preset(preset);
  energy::PowerModel model = constants_of(truth.empty() ? "thesis-laptop" : truth);
  // A machine draws something whatever it does: a phase without a constant (the thesis has none for
  // transfer) is as hard as rendering.
  for (std::optional<energy::Watts>& delta : model.delta) {
    if (!delta) delta = model.delta[energy::Phase::render].value_or(energy::Watts(0));
  }
  settings.energy_until = [&live, model](energy::Seconds time) {
    const energy::BusyTimes busy{live.busy(time), {}};
    return energy::modelled_energy(model, time, busy).value_or(energy::Joules(0));
  };
  settings.info.gain_uncertainty = 0.0;  // its truth is known
  settings.info.provenance.detail =
      "a simulated sensor on a simulated machine: " + energy::describe(model);
  return std::make_unique<energy::SimulatedSource>(std::move(settings));
}

/// What stands between the user and this sensor, in one line.
std::string obstacle_text(const Finding& finding) {
  std::string text = finding.obstacle->reason;
  if (!finding.obstacle->fix.empty()) text += "; " + finding.obstacle->fix;
  return text;
}

/// Opens the sensors that a word names: one by its name, or all of a kind.
void open_found(const std::string& word, const energy::SourceSpec& spec, Sensors& sensors,
                PowerSources& opened) {
  std::string why;
  std::size_t matches = 0;
  std::size_t usable = 0;
  for (const Finding& finding : sensors.all()) {
    if (!spec.names(finding.info)) continue;
    // A kind means those that one would take; a name means just that one.
    if (spec.unit.empty() && !finding.set_aside.empty() && !finding.obstacle) continue;
    ++matches;
    if (finding.obstacle) {
      why = obstacle_text(finding);
      continue;
    }
    opened.sources.push_back(finding.open());
    ++usable;
  }
  if (matches == 0) {
    throw SensorError(
        fmt::format("--source {}: this machine has none; 'encore doctor' lists what it has", word));
  }
  if (usable == 0) throw SensorError(fmt::format("--source {}: {}", word, why));
}

void open_named(const std::string& word, Sensors& sensors, PowerSources& opened) {
  energy::SourceSpec spec;
  try {
    spec = energy::parse_source_spec(word);
  } catch (const energy::SourceSpecError& error) {
    throw UsageError(fmt::format("--source: {}", error.what()));
  }
  if (spec.meter) {
    opened.sources.push_back(energy::open_meter(*spec.meter));
  } else if (spec.replay) {
    opened.sources.push_back(
        energy::open_replay(energy::load_recording(spec.replay->file), spec.replay->offset));
  } else {
    open_found(word, spec, sensors, opened);
  }
}

/// Opens every usable sensor that is not set aside; those that fail now are left out.
std::string open_all(Sensors& sensors, PowerSources& opened) {
  std::string why;
  for (const Finding& finding : sensors.all()) {
    if (finding.obstacle) {
      if (why.empty()) why = finding.obstacle->reason;
      continue;
    }
    if (!finding.set_aside.empty()) continue;
    try {
      opened.sources.push_back(finding.open());
    } catch (const SensorError& error) {
      if (why.empty()) why = error.what();
    }
  }
  return why;
}

void choose(PowerSources& opened) {
  std::vector<energy::SourceInfo> infos;
  for (const auto& source : opened.sources) infos.push_back(source->info());
  opened.total = energy::choose_total(infos);
  if (opened.total.empty()) return;
  opened.provenance = infos[opened.total.front()].provenance;
  if (opened.total.size() == 1) return;
  // A sum is as good as its weakest part.
  opened.provenance.detail.clear();
  for (const std::size_t i : opened.total) {
    opened.provenance.origin = std::max(opened.provenance.origin, infos[i].provenance.origin);
    if (!opened.provenance.detail.empty()) opened.provenance.detail += " + ";
    opened.provenance.detail += infos[i].name;
  }
}

}  // namespace

PowerSources open_power_sources(const MeasuringOptions& options, const LiveBusyTime& live) {
  PowerSources opened;
  Sensors sensors(options.sensor_root);
  std::string why;
  bool simulated = false;
  for (const std::string& word : options.sources) {
    if (word == "none") {
      why = "no power source was asked for (--source none)";
    } else if (word == "auto") {
      why = open_all(sensors, opened);
    } else if (word.starts_with(kModelPrefix)) {
      opened.sources.push_back(open_model(word.substr(kModelPrefix.size()), live));
    } else if (word.starts_with(kSimulatedPrefix)) {
      opened.sources.push_back(
          open_simulated(word.substr(kSimulatedPrefix.size()), options.model, live));
      simulated = true;
    } else {
      open_named(word, sensors, opened);
    }
  }
  if (options.sources.empty() && options.model.empty()) why = open_all(sensors, opened);
  // A simulated sensor looks at the model; it is no source beside it then.
  if (!options.model.empty() && !simulated) {
    opened.sources.push_back(open_model(options.model, live));
  }
  choose(opened);
  if (opened.total.empty()) {
    opened.provenance = {energy::Origin::unavailable, why + "; 'encore doctor' tells more"};
  }
  return opened;
}

std::optional<energy::PerPhase<double>> phase_watts(const MeasuringOptions& options) {
  try {
    return phase_watts(model_constants(options.model));
  } catch (const energy::PowerModelError& error) {
    throw UsageError(fmt::format("--model: {}", error.what()));
  }
}

std::string total_name(const PowerSources& sources) {
  std::string name;
  for (const std::size_t i : sources.total) {
    if (!name.empty()) name += " + ";
    name += sources.sources[i]->info().name;
  }
  return name;
}

}  // namespace encore::app
