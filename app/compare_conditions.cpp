#include "app/compare.h"
#include "app/session_input.h"

#include <fmt/format.h>

#include <algorithm>

namespace encore::app {

namespace {

/// Collects what differs, as "processor: x in A, y in B".
class Differences {
 public:
  void compare(const std::string& what, const std::string& a, const std::string& b) {
    if (a == b) return;
    const auto shown = [](const std::string& text) {
      return text.empty() ? std::string("unknown") : "'" + text + "'";
    };
    sentences_.push_back(fmt::format("{}: {} in A, {} in B", what, shown(a), shown(b)));
  }
  void compare(const std::string& what, const std::optional<std::string>& a,
               const std::optional<std::string>& b) {
    compare(what, a.value_or(""), b.value_or(""));
  }
  void compare(const std::string& what, std::optional<std::uint64_t> a,
               std::optional<std::uint64_t> b) {
    compare(what, a ? std::to_string(*a) : "", b ? std::to_string(*b) : "");
  }
  void add(std::string sentence) { sentences_.push_back(std::move(sentence)); }
  [[nodiscard]] std::vector<std::string> take() { return std::move(sentences_); }

 private:
  std::vector<std::string> sentences_;
};

/// All values of a setting (--set may stand several times), in order.
std::string setting_of(const energy::SessionInfo& info, const std::string& key) {
  std::string values;
  for (const energy::KeyValue& setting : info.settings) {
    if (setting.key != key) continue;
    if (!values.empty()) values += ", ";
    values += setting.value;
  }
  return values;
}

void compare_settings(Differences& differences, const energy::SessionInfo& a,
                      const energy::SessionInfo& b) {
  std::vector<std::string> keys;
  for (const energy::SessionInfo* info : {&a, &b}) {
    for (const energy::KeyValue& setting : info->settings) {
      if (std::find(keys.begin(), keys.end(), setting.key) == keys.end()) {
        keys.push_back(setting.key);
      }
    }
  }
  for (const std::string& key : keys) {
    differences.compare("setting " + key, setting_of(a, key), setting_of(b, key));
  }
}

void check_session(Differences& differences, const energy::SessionInfo& info, const char* name) {
  if (info.state != energy::SessionState::complete) {
    differences.add(fmt::format("session {} is not complete ({})", name, to_string(info.state)));
  }
  if (info.machine.build_type != "Release") {
    differences.add(
        fmt::format("session {} was measured with a {} build, not Release", name,
                    info.machine.build_type.empty() ? "plain" : info.machine.build_type));
  }
}

}  // namespace

bool same_sensor(const energy::SessionInfo& a, const energy::SessionInfo& b) {
  return a.sensor.origin == b.sensor.origin && sensor_name(a) == sensor_name(b) &&
         a.machine.cpu_model == b.machine.cpu_model;
}

std::vector<std::string> differences_of(const energy::SessionInfo& a,
                                        const energy::SessionInfo& b) {
  Differences differences;
  const energy::Machine& x = a.machine;
  const energy::Machine& y = b.machine;
  differences.compare("processor", x.cpu_model, y.cpu_model);
  differences.compare("hardware threads", x.logical_cores, y.logical_cores);
  differences.compare("main memory in bytes", x.memory_bytes, y.memory_bytes);
  differences.compare("operating system", x.operating_system, y.operating_system);
  differences.compare("kernel", x.kernel, y.kernel);
  differences.compare("frequency governor", x.governor, y.governor);
  differences.compare("compiler", x.compiler, y.compiler);
  differences.compare("build type", x.build_type, y.build_type);
  differences.compare("program", a.program, b.program);
  compare_settings(differences, a, b);
  check_session(differences, a, "A");
  check_session(differences, b, "B");

  // Energies: of the same origin, of the same sensor?
  if (a.sensor.origin != b.sensor.origin) {
    differences.add(fmt::format("energy is {} in A and {} in B, so it is not compared",
                                to_string(a.sensor.origin), to_string(b.sensor.origin)));
  } else if (a.sensor.origin != energy::Origin::unavailable && !same_sensor(a, b)) {
    differences.compare("power source", sensor_name(a), sensor_name(b));
    differences.add(
        "the power sources are not the same, so their gain errors do not cancel: intervals of "
        "watts and joules are wider for it");
  } else if (a.sensor.origin == energy::Origin::modelled) {
    differences.add("energy is modelled in both: its differences are those of the times");
  }
  return differences.take();
}

}  // namespace encore::app
