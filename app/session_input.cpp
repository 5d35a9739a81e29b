#include "app/session_input.h"

#include "energy/session_csv.h"
#include "energy/student_t.h"
#include "scene/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace encore::app {

namespace {

/// What plain ray casting says of itself.
bool is_plain(const energy::KeyValue& part) {
  return (part.key == "intersection" && part.value == "precise") ||
         (part.key == "grouping" && part.value == "packets") ||
         (part.key == "rays" && part.value == "none") ||
         (part.key == "samples" && part.value == "1");
}

bool tells_apart(const energy::KeyValue& part) {
  return !part.value.empty() && part.key != "repeat" && part.key != "triangles" && !is_plain(part);
}

}  // namespace

energy::Session open_session(const std::string& folder) {
  try {
    return energy::read_session(folder);
  } catch (const energy::SessionError& error) {
    throw scene::InputError(
        fmt::format("{}; name a session folder that 'encore profile' wrote", error.what()));
  }
}

std::string configuration_value(const std::vector<energy::KeyValue>& configuration,
                                std::string_view key) {
  for (const energy::KeyValue& part : configuration) {
    if (part.key == key) return part.value;
  }
  return {};
}

std::optional<double> counter_value(const energy::SummaryRow& row, std::string_view name) {
  for (const energy::Counter& counter : row.counters) {
    if (counter.name == name) return counter.value;
  }
  return std::nullopt;
}

std::vector<energy::KeyValue> configuration_identity(
    const std::vector<energy::KeyValue>& configuration) {
  std::vector<energy::KeyValue> identity;
  std::copy_if(configuration.begin(), configuration.end(), std::back_inserter(identity),
               tells_apart);
  return identity;
}

std::string configuration_name(const std::vector<energy::KeyValue>& configuration) {
  const auto value = [&](std::string_view key) { return configuration_value(configuration, key); };
  std::string size = value("width");
  if (!size.empty()) size += "x" + value("height");
  std::string name;
  const auto add = [&](const std::string& part) {
    if (part.empty()) return;
    if (!name.empty()) name += ", ";
    name += part;
  };
  for (const char* key : {"group", "scene", "structure", "test", "policy"}) add(value(key));
  add(size);
  add(value("device"));
  // All else is shown with its key.
  for (const energy::KeyValue& part : configuration_identity(configuration)) {
    const auto known = {"group",  "scene", "structure", "test",
                        "policy", "width", "height",    "device"};
    const bool usual = part.key == "memory" && part.value == "pool";
    if (!usual && std::find(known.begin(), known.end(), part.key) == known.end()) {
      add(part.key + " " + part.value);
    }
  }
  return name;
}

std::string sensor_name(const energy::SessionInfo& info) {
  std::string name;
  for (const energy::SessionSource& source : info.sources) {
    if (!source.in_total) continue;
    if (!name.empty()) name += " + ";
    name += source.info.name;
  }
  return name.empty() ? info.sensor.detail : name;
}

double gain_uncertainty(const energy::SessionInfo& info) {
  double gain = 0.0;
  bool any = false;
  for (const energy::SessionSource& source : info.sources) {
    if (!source.in_total) continue;
    gain = std::max(gain, source.info.gain_uncertainty);
    any = true;
  }
  return any ? gain : energy::SourceInfo{}.gain_uncertainty;
}

double without_gain(const energy::SessionInfo& info, double value, double half_width) {
  std::optional<double> gain;
  for (const energy::SessionSource& source : info.sources) {
    if (source.in_total) gain = std::min(gain.value_or(1e9), source.info.gain_uncertainty);
  }
  const double part = energy::kNormal95 * gain.value_or(0.0) * value;
  return std::sqrt(std::max(0.0, half_width * half_width - part * part));
}

}  // namespace encore::app
