#include "app/model_session.h"

#include "app/session_input.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace encore::app {

namespace {

using energy::KeyValue;
using energy::ModelObservation;
using energy::Phase;
using energy::SummaryRow;

/// A configuration of one repeat as one text.
std::string run_key(const std::vector<KeyValue>& configuration) {
  std::string key;
  for (const KeyValue& part : configuration) {
    if (part.key != "triangles") key += part.key + '=' + part.value + '\n';
  }
  return key;
}

/// Mean time from one operation's start to the next one's, by frames.csv: gaps between phases
/// included. Of configurations with at least two rows that follow each other.
class Periods {
 public:
  explicit Periods(const std::vector<energy::FrameRow>& rows) {
    std::string before_key;
    const energy::FrameRow* before = nullptr;
    for (const energy::FrameRow& row : rows) {
      std::string key = run_key(row.configuration);
      if (before != nullptr && key == before_key) {
        Sum& sum = sums_[key];
        sum.seconds += row.time.value - before->time.value;
        sum.operations += static_cast<double>(before->operations);
      }
      before_key = std::move(key);
      before = &row;
    }
  }

  [[nodiscard]] std::optional<double> of(const std::vector<KeyValue>& configuration) const {
    const auto found = sums_.find(run_key(configuration));
    if (found == sums_.end() || !(found->second.operations > 0.0)) return std::nullopt;
    return found->second.seconds / found->second.operations;
  }

 private:
  struct Sum {
    double seconds = 0.0;
    double operations = 0.0;
  };
  std::map<std::string, Sum> sums_;
};

/// Names rates as they come up.
class RateNames {
 public:
  explicit RateNames(std::vector<std::string>& names) : names_(names) {}
  std::size_t of(const std::string& name) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found != names_.end()) return static_cast<std::size_t>(found - names_.begin());
    names_.push_back(name);
    return names_.size() - 1;
  }

 private:
  std::vector<std::string>& names_;
};

std::string rate_name(Phase phase, const std::string& device, RateGrouping grouping,
                      bool update_alone) {
  if (phase == Phase::transfer) return "transfer";
  // A device draws, and updates the copy that it has; all else is the CPU's work.
  const bool on_device = device != "cpu" && (phase == Phase::render || phase == Phase::update);
  if (grouping == RateGrouping::processor) return on_device ? device : "cpu";
  if (phase == Phase::render) return "render (" + device + ")";
  if (phase == Phase::update && on_device) return "update (" + device + ")";
  if (phase == Phase::update && update_alone) return "update";
  return "build";
}

bool is_dynamic(const SummaryRow& row) {
  return configuration_value(row.configuration, "test") == "dynamic";
}

/// Whether a test that calibrates consists of updates by the CPU.
bool tests_update_alone(const energy::Session& session) {
  return std::any_of(session.summaries.begin(), session.summaries.end(), [](const SummaryRow& row) {
    return !is_dynamic(row) && row.joules && row.shares[Phase::update].value_or(0.0) > 0.5 &&
           configuration_value(row.configuration, "device") == "cpu";
  });
}

ModelObservation observation_of(const energy::SessionInfo& info, const Periods& periods,
                                const SummaryRow& row, RateGrouping grouping, bool update_alone,
                                RateNames& names) {
  ModelObservation seen;
  seen.name = configuration_name(row.configuration);
  seen.calibrates = !is_dynamic(row);
  const double relative = row.ci95 && row.mean.value > 0.0 ? row.ci95->value / row.mean.value : 0.0;
  const std::string device = configuration_value(row.configuration, "device");
  double busy = 0.0;
  for (const Phase phase : energy::kPhases) {
    const double seconds = row.mean.value * row.shares[phase].value_or(0.0);
    if (!(seconds > 0.0)) continue;
    seen.work.push_back({std::string(to_string(phase)),
                         {seconds, seconds * relative},
                         names.of(rate_name(phase, device, grouping, update_alone))});
    busy += seconds;
  }
  const double period = std::max(periods.of(row.configuration).value_or(busy), busy);
  seen.seconds = {period, period * relative};
  seen.joules.value = row.joules->value;
  if (row.joules_ci95_without_gain) {
    seen.joules.half_width = row.joules_ci95_without_gain->value;
  } else if (row.joules_ci95) {
    seen.joules.half_width = without_gain(info, row.joules->value, row.joules_ci95->value);
  }
  return seen;
}

/// Whether a build or static test belongs to a dynamic one.
bool belongs(const std::vector<KeyValue>& test, const std::vector<KeyValue>& dynamic,
             const char* kind) {
  const auto same = [&](const char* key) {
    return configuration_value(test, key) == configuration_value(dynamic, key);
  };
  if (configuration_value(test, "test") != kind || !same("group") || !same("scene") ||
      !same("structure") || !same("memory")) {
    return false;
  }
  if (std::string_view(kind) == "build") {
    // Structures are built where it says, and updated where they are.
    const bool updates = configuration_value(dynamic, "policy") == "refit" ||
                         configuration_value(dynamic, "build_on") == "device";
    const std::string builder = updates ? configuration_value(dynamic, "device") : "cpu";
    return configuration_value(test, "device") == builder && same("policy") && same("update_case");
  }
  return same("device") && same("build_on") && same("width") && same("height");
}

/// Mean of a figure over the tests that belong to a dynamic one (its repeats).
std::optional<double> mean_watts(const ModelData& data, const std::vector<KeyValue>& dynamic,
                                 const char* kind) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < data.observations.size(); ++i) {
    if (!belongs(data.configurations[i], dynamic, kind)) continue;
    sum += data.measured_watts[i];
    count += 1.0;
  }
  if (!(count > 0.0)) return std::nullopt;
  return sum / count;
}

}  // namespace

ModelData model_data(const energy::Session& session, RateGrouping grouping) {
  ModelData data;
  RateNames names(data.rates);
  const bool update_alone = tests_update_alone(session);
  const Periods periods(session.frames);
  for (const SummaryRow& row : session.summaries) {
    if (!row.joules || !(row.joules->value > 0.0) || !(row.mean.value > 0.0)) continue;
    ModelObservation seen =
        observation_of(session.info, periods, row, grouping, update_alone, names);
    if (seen.work.empty()) continue;
    data.measured_watts.push_back(row.watts ? row.watts->value
                                            : seen.joules.value / seen.seconds.value);
    data.observations.push_back(std::move(seen));
    data.configurations.push_back(row.configuration);
  }
  return data;
}

std::optional<energy::Uncertain> idle_watts(const energy::Session& session) {
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (const SummaryRow& row : session.summaries) {
    if (!row.idle_watts) continue;
    sum += row.idle_watts->value;
    const double half = without_gain(session.info, row.idle_watts->value,
                                     row.idle_watts_ci95.value_or(energy::Watts(0)).value);
    squares += half * half;
    count += 1.0;
  }
  if (!(count > 0.0)) return std::nullopt;
  return energy::Uncertain{sum / count, std::sqrt(squares) / count};
}

std::vector<OwnTests> predict_from_own_tests(const ModelData& data) {
  std::vector<OwnTests> predictions;
  for (std::size_t i = 0; i < data.observations.size(); ++i) {
    const ModelObservation& seen = data.observations[i];
    if (seen.calibrates) continue;
    const auto build = mean_watts(data, data.configurations[i], "build");
    const auto fixed = mean_watts(data, data.configurations[i], "static");
    if (!build || !fixed) continue;
    double build_seconds = 0.0;
    double render_seconds = 0.0;
    double busy = 0.0;
    for (const energy::FrameWork& work : seen.work) {
      busy += work.seconds.value;
      if (work.name == "build" || work.name == "update") build_seconds += work.seconds.value;
      if (work.name == "render") render_seconds += work.seconds.value;
    }
    if (!(build_seconds + render_seconds > 0.0)) continue;
    OwnTests own;
    own.observation = i;
    own.watts =
        (*build * build_seconds + *fixed * render_seconds) / (build_seconds + render_seconds);
    own.joules = own.watts * busy;
    own.error = own.joules / seen.joules.value - 1.0;
    const double measured = data.measured_watts[i];
    own.outside = measured < std::min(*build, *fixed) || measured > std::max(*build, *fixed);
    predictions.push_back(own);
  }
  return predictions;
}

energy::ModelErrors errors_of(const std::vector<OwnTests>& predictions) {
  std::vector<double> errors;
  for (const OwnTests& own : predictions) errors.push_back(own.error);
  return energy::sum_errors(errors);
}

}  // namespace encore::app
