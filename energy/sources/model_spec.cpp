#include "energy/sources/model_spec.h"

#include "energy/sources/calibration.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <set>

namespace encore::energy {

namespace {

constexpr std::string_view kThesisLaptop = "thesis-laptop";

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    parts.push_back(trimmed(text.substr(start, end - start)));
    start = end + 1;
  }
  return parts;
}

std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<Phase> parse_phase(std::string_view name) {
  for (const Phase phase : kPhases) {
    if (to_string(phase) == name) return phase;
  }
  return std::nullopt;
}

/// "20", "20W" or "20 W".
Watts parse_watts(std::string_view key, std::string_view text) {
  std::string_view number = text;
  if (number.ends_with('W')) number = trimmed(number.substr(0, number.size() - 1));
  const auto value = parse_number(number);
  if (!value || !(*value >= 0.0 && *value <= kLargestModelPower)) {
    throw PowerModelError(
        fmt::format("power model: {} must be a number of watts from 0 to {}, not '{}'", key,
                    kLargestModelPower, text));
  }
  return Watts(*value);
}

/// "10%" or "0.1".
double parse_uncertainty(std::string_view text) {
  const bool percent = text.ends_with('%');
  const auto value = parse_number(percent ? trimmed(text.substr(0, text.size() - 1)) : text);
  const double share = value ? *value / (percent ? 100.0 : 1.0) : -1.0;
  if (!(share >= 0.0 && share <= 1.0)) {
    throw PowerModelError(fmt::format(
        "power model: uncertainty must be from 0% to 100%, such as 10%, not '{}'", text));
  }
  return share;
}

/// The keys as they are read; what they mean together is decided at the end.
struct Keys {
  PowerModel constants;
  std::optional<Watts> idle;
  std::optional<Watts> busy;
  std::optional<Watts> max;
  std::set<std::string, std::less<>> seen;
};

void read_key(std::string_view part, Keys& keys) {
  const std::size_t equals = part.find('=');
  if (equals == std::string_view::npos) {
    throw PowerModelError(fmt::format(
        "power model: '{}' is neither <name>=<watts> nor a preset ({}) nor a .toml file; for "
        "example idle=12,render=20,build=18",
        part, fmt::join(model_presets(), ", ")));
  }
  const std::string_view key = trimmed(part.substr(0, equals));
  const std::string_view value = trimmed(part.substr(equals + 1));
  if (!keys.seen.emplace(key).second) {
    throw PowerModelError(fmt::format("power model: {} is given twice", key));
  }
  if (key == "uncertainty") {
    keys.constants.uncertainty = parse_uncertainty(value);
  } else if (key == "idle") {
    keys.idle = parse_watts(key, value);
  } else if (key == "busy") {
    keys.busy = parse_watts(key, value);
  } else if (key == "max") {
    keys.max = parse_watts(key, value);
  } else if (key == "gpu") {
    keys.constants.gpu = parse_watts(key, value);
  } else if (const auto phase = parse_phase(key)) {
    keys.constants.delta[*phase] = parse_watts(key, value);
  } else {
    throw PowerModelError(
        fmt::format("power model: unknown name '{}'; known are idle, animate, build, update, "
                    "transfer, render, busy, gpu, uncertainty, and max for an estimate from load",
                    key));
  }
}

UtilisationModel utilisation_of(const Keys& keys) {
  for (const std::string& key : keys.seen) {
    if (key != "idle" && key != "max" && key != "uncertainty") {
      throw PowerModelError(
          fmt::format("power model: max asks for an estimate from load, which knows no {}; leave "
                      "one of the two "
                      "out",
                      key));
    }
  }
  UtilisationModel model;
  model.idle = *keys.idle;
  model.max = *keys.max;
  if (keys.constants.uncertainty) model.uncertainty = *keys.constants.uncertainty;
  model.detail = "idle and max given by the user";
  check(model);
  return model;
}

}  // namespace

std::vector<std::string> model_presets() {
  return {std::string(kThesisLaptop)};
}

PowerModel model_preset(std::string_view name) {
  if (name != kThesisLaptop) {
    throw PowerModelError(fmt::format("power model: no preset is called '{}'; there are: {}", name,
                                      fmt::join(model_presets(), ", ")));
  }
  // Totals of the whole laptop as the thesis reports them: 33.6 W in builds and updates
  // (5.1.5), 34.6 W in rendering on the processor and 40.2 W on the GPU (5.2.3), 34 W as its
  // processor at full load (6); about 19 W is where its discharge curve ends (figure 15). It gives
  // none for transfer.
  constexpr Watts kIdle(19.0);
  PowerModel model;
  model.idle = kIdle;
  model.delta[Phase::animate] = Watts(34.0) - kIdle;
  model.delta[Phase::build] = Watts(33.6) - kIdle;
  model.delta[Phase::update] = Watts(33.6) - kIdle;
  model.delta[Phase::render] = Watts(34.6) - kIdle;
  model.gpu = Watts(40.2) - kIdle;
  model.detail =
      "preset thesis-laptop: battery rates that the thesis reports of its 2005 laptop (1.6 GHz "
      "Pentium M, GeForce Go 6800, display on); another machine draws something else";
  // Its 63 build rates scatter by 1 W around 33.6 W.
  model.uncertainty = 0.03;
  return model;
}

ModelSpec parse_model_spec(std::string_view text) {
  text = trimmed(text);
  if (text.empty()) {
    throw PowerModelError("power model: nothing is given; for example idle=12,render=20,build=18");
  }
  if (text.ends_with(".toml")) return read_calibration(std::filesystem::path(text)).model;

  std::vector<std::string_view> parts = split(text);
  Keys keys;
  keys.constants.detail = "given by the user";
  const bool preset =
      parts.front().find('=') == std::string_view::npos && parts.front() == kThesisLaptop;
  if (preset) {
    keys.constants = model_preset(parts.front());
    keys.idle = keys.constants.idle;
    parts.erase(parts.begin());
    if (!parts.empty()) keys.constants.detail += "; changed by the user";
  }
  for (const std::string_view part : parts) read_key(part, keys);
  if (!keys.idle) {
    throw PowerModelError(
        "power model: idle is missing: the watts that the machine draws while nothing runs, such "
        "as idle=12");
  }
  if (keys.max) {
    if (preset) throw PowerModelError("power model: max does not go with a preset; leave one out");
    return utilisation_of(keys);
  }
  keys.constants.idle = *keys.idle;
  for (const Phase phase : kPhases) {
    auto& delta = keys.constants.delta[phase];
    if (!delta) delta = keys.busy;
  }
  check(keys.constants);
  return keys.constants;
}

}  // namespace encore::energy
