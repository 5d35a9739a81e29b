#include "energy/sources/source_spec.h"

#include "energy/csv.h"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <map>

namespace encore::energy {

namespace {

using Options = std::map<std::string, std::string, std::less<>>;

constexpr SourceKind kKinds[] = {
    SourceKind::rapl,   SourceKind::perf_energy, SourceKind::battery,
    SourceKind::hwmon,  SourceKind::nvml,        SourceKind::meter,
    SourceKind::replay, SourceKind::model,       SourceKind::simulated};

[[noreturn]] void refuse(std::string_view text, const std::string& what) {
  throw SourceSpecError(fmt::format("source '{}': {}", text, what));
}

/// Adds a word to a list for people.
void listed(std::string& list, std::string_view word) {
  if (!list.empty()) list += ", ";
  list += word;
}

/// Where the last ":name=" of a known option begins.
std::size_t last_option(std::string_view rest, std::initializer_list<std::string_view> known) {
  std::size_t last = std::string_view::npos;
  for (const std::string_view name : known) {
    const std::size_t at = rest.rfind(fmt::format(":{}=", name));
    if (at != std::string_view::npos && (last == std::string_view::npos || at > last)) last = at;
  }
  return last;
}

/// Takes the options off the end of `rest`.
Options take_options(std::string_view text, std::string_view& rest,
                     std::initializer_list<std::string_view> known) {
  Options options;
  for (std::size_t at = 0; (at = last_option(rest, known)) != std::string_view::npos;) {
    const std::string_view option = rest.substr(at + 1);
    const std::size_t equals = option.find('=');
    const std::string name(option.substr(0, equals));
    const std::string value(option.substr(equals + 1));
    if (value.empty()) refuse(text, fmt::format("the option {} has no value", name));
    if (!options.emplace(name, value).second) {
      refuse(text, fmt::format("the option {} stands twice", name));
    }
    rest = rest.substr(0, at);
  }
  // "…:volt=5" would else become part of the file's name and be missed there.
  const std::size_t colon = rest.rfind(':');
  const std::string_view tail =
      colon == std::string_view::npos ? std::string_view() : rest.substr(colon + 1);
  const std::size_t equals = tail.find('=');
  if (equals != std::string_view::npos && tail.find('/') == std::string_view::npos) {
    std::string names;
    for (const std::string_view name : known) listed(names, name);
    refuse(text, fmt::format("no option '{}' here; there are {}", tail.substr(0, equals), names));
  }
  return options;
}

std::optional<double> number_of(std::string_view text, const Options& options,
                                std::string_view name) {
  const auto option = options.find(name);
  if (option == options.end()) return std::nullopt;
  const auto number = parse_csv_number(option->second);
  if (!number || !std::isfinite(*number)) {
    refuse(text, fmt::format("{}={} is no number", name, option->second));
  }
  return number;
}

std::optional<unsigned> baud_of(std::string_view text, const Options& options) {
  const auto baud = number_of(text, options, "baud");
  if (!baud) return std::nullopt;
  if (*baud < 50 || *baud > 4e6 || *baud != std::floor(*baud)) {
    refuse(text, fmt::format("baud={} is no speed of a serial line", *baud));
  }
  return static_cast<unsigned>(*baud);
}

MeterSettings parse_meter(std::string_view text, std::string_view rest) {
  const std::size_t colon = rest.find(':');
  const std::string_view type = rest.substr(0, colon);
  const bool um = type == "um24c" || type == "um25c" || type == "um34c";
  if (!um && type != "scpi") {
    refuse(text, fmt::format("unknown meter '{}'; there are um24c, um25c, um34c and scpi, as in "
                             "meter:um25c:/dev/rfcomm0",
                             type));
  }
  rest = colon == std::string_view::npos ? std::string_view() : rest.substr(colon + 1);
  const Options options = um ? take_options(text, rest, {"baud"})
                             : take_options(text, rest, {"volts", "amps", "query", "baud"});
  MeterSettings meter;
  meter.kind = um ? MeterKind::um : MeterKind::scpi;
  meter.device = rest;
  if (meter.device.empty()) {
    refuse(text, fmt::format("no device; name it, as in meter:{}:/dev/{}", type,
                             um ? "rfcomm0" : "ttyUSB0:volts=19.5"));
  }
  meter.baud = baud_of(text, options);
  meter.volts = number_of(text, options, "volts");
  meter.amps = number_of(text, options, "amps");
  if (meter.volts && meter.amps) {
    refuse(text,
           "volts= and amps= exclude each other: the meter measures the one that is not given");
  }
  for (const auto& constant : {meter.volts, meter.amps}) {
    if (constant && !(*constant > 0)) refuse(text, "volts= and amps= must be above 0");
  }
  if (const auto query = options.find("query"); query != options.end()) {
    meter.query = query->second;
  }
  return meter;
}

ReplaySettings parse_replay(std::string_view text, std::string_view rest) {
  const Options options = take_options(text, rest, {"offset"});
  ReplaySettings replay;
  replay.file = rest;
  if (replay.file.empty()) refuse(text, "no file; name it, as in replay:recording.csv");
  if (const auto offset = number_of(text, options, "offset")) replay.offset = Seconds(*offset);
  return replay;
}

}  // namespace

bool SourceSpec::names(const SourceInfo& info) const {
  if (info.kind != kind) return false;
  return unit.empty() || info.name == fmt::format("{}:{}", to_string(kind), unit);
}

SourceSpec parse_source_spec(std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::string_view word = text.substr(0, colon);
  const std::string_view rest =
      colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1);
  for (const SourceKind kind : kKinds) {
    if (word != to_string(kind)) continue;
    SourceSpec spec;
    spec.kind = kind;
    if (kind == SourceKind::meter) {
      spec.meter = parse_meter(text, rest);
    } else if (kind == SourceKind::replay) {
      spec.replay = parse_replay(text, rest);
    } else if (colon != std::string_view::npos && rest.empty()) {
      refuse(text, fmt::format("no name behind the colon; '{}' alone means all of them", word));
    } else {
      spec.unit = rest;
    }
    return spec;
  }
  std::string kinds;
  for (const SourceKind kind : kKinds) listed(kinds, to_string(kind));
  refuse(text, fmt::format("unknown kind '{}'; there are {}", word, kinds));
}

}  // namespace encore::energy
