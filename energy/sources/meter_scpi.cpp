#include "energy/sources/meter_scpi.h"

#include "energy/clock.h"
#include "energy/sources/discovery.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace encore::energy {

namespace {

/// SCPI's numbers for overload and "not a number" begin here.
constexpr double kOverload = 9.9e37;
/// No answer is longer; more without an end of line is not SCPI.
constexpr std::size_t kLongestLine = 512;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// One line of an answer, without its end; nothing if it does not come in time.
std::optional<std::string> ask(SerialPort& port, std::string_view question, Seconds timeout) {
  if (!port.send(std::string(question) + "\n")) return std::nullopt;
  const SteadyClock clock;
  const Seconds end = clock.now() + timeout;
  std::string answer;
  while (true) {
    const Seconds left = end - clock.now();
    if (left.value <= 0) return std::nullopt;
    const SerialPort::Received received = port.wait(left);
    answer.append(received.bytes.begin(), received.bytes.end());
    if (received.gone || answer.size() > kLongestLine) return std::nullopt;
    if (answer.find('\n') == std::string::npos) continue;
    const std::string_view line = trimmed(std::string_view(answer).substr(0, answer.find('\n')));
    if (!line.empty()) return std::string(line);
    answer.erase(0, answer.find('\n') + 1);
  }
}

}  // namespace

std::optional<double> parse_scpi_number(std::string_view line) {
  line = trimmed(line);
  // from_chars knows no plus sign.
  if (line.size() > 1 && line[0] == '+' && line[1] != '-') line.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  // A unit or a further field may follow, but not the rest of a word or another number.
  const auto rest = line.substr(static_cast<std::size_t>(end - line.data()));
  if (!rest.empty() && (rest[0] == '.' || rest[0] == '+' || rest[0] == '-')) return std::nullopt;
  return value;
}

ScpiProtocol::ScpiProtocol(const MeterSettings& settings)
    : volts_(settings.volts),
      amps_(settings.amps),
      query_(settings.query.empty() ? "READ?" : settings.query),
      user_query_(!settings.query.empty()) {
  if (volts_ && amps_) {
    throw SensorError(
        "a SCPI meter measures volts or amperes: give the constant one of them, not both");
  }
  const double constant = volts_.value_or(amps_.value_or(1.0));
  if (!(constant > 0) || !std::isfinite(constant)) {
    throw SensorError("the constant volts or amperes of a SCPI meter must be above 0");
  }
}

MeterFacts ScpiProtocol::facts() const {
  MeterFacts facts;
  facts.name = "scpi";
  facts.product = product_;
  facts.includes = "everything behind the meter's terminals";
  if (volts_) {
    facts.includes += fmt::format(", as its amperes times {} V that the user vouches for", *volts_);
  }
  if (amps_) {
    facts.includes += fmt::format(", as its volts times {} A that the user vouches for", *amps_);
  }
  facts.update_period = Seconds(0.2);
  // A supply's voltage sags under load by a few percent, which a constant cannot show.
  facts.gain_uncertainty = volts_ || amps_ ? 0.02 : 0.01;
  facts.answers_are_new = true;
  return facts;
}

void ScpiProtocol::greet(SerialPort& port, Seconds timeout) {
  const auto name = ask(port, "*IDN?", timeout);
  if (!name) {
    throw SensorError(fmt::format(
        "{}: no answer to *IDN? within {:.1f} s; is the meter on, set to SCPI over this line, and "
        "is its speed right (option baud)?",
        port.device(), timeout.value));
  }
  product_ = *name;
  if (user_query_) return;
  // Some of its makers' models take remote commands on a serial line only after this one.
  const bool needs_remote = product_.starts_with("HEWLETT") || product_.starts_with("Agilent") ||
                            product_.starts_with("Keysight");
  if (needs_remote) port.send("SYST:REM\n");
  const bool owon = product_.starts_with("OWON");
  if (owon) query_ = "MEAS1?";
  if (volts_) port.send("CONF:CURR:DC\n");
  if (amps_) port.send("CONF:VOLT:DC\n");
  if (!volts_ && !amps_) query_ = "MEAS:POW?";
}

std::optional<MeterSample> ScpiProtocol::sample_of(std::string_view line, Seconds time) {
  MeterSample sample;
  sample.time = time;
  const auto number = parse_scpi_number(line);
  if (!number) {
    complaint_ = fmt::format("it answered '{}', which is no number", line);
    return std::nullopt;
  }
  if (std::fabs(*number) >= kOverload) {
    complaint_ = "overload; choose a larger range on the meter";
    return sample;
  }
  complaint_.clear();
  if (volts_) {
    sample.volts = volts_;
    sample.amps = *number;
  } else if (amps_) {
    sample.amps = amps_;
    sample.volts = *number;
  } else {
    sample.power = Watts(*number);
  }
  return sample;
}

std::vector<MeterSample> ScpiProtocol::take(std::span<const std::uint8_t> bytes, Seconds time) {
  pending_.append(bytes.begin(), bytes.end());
  std::vector<MeterSample> samples;
  for (std::size_t end = 0; (end = pending_.find('\n')) != std::string::npos;) {
    const std::string_view line = trimmed(std::string_view(pending_).substr(0, end));
    if (!line.empty()) {
      if (const auto sample = sample_of(line, time)) samples.push_back(*sample);
    }
    pending_.erase(0, end + 1);
  }
  if (pending_.size() > kLongestLine) {
    complaint_ = "its lines have no end";
    pending_.clear();
  }
  return samples;
}

}  // namespace encore::energy
