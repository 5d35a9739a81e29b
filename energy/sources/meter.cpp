#include "energy/sources/meter.h"

#include "energy/clock.h"
#include "energy/sources/discovery.h"
#include "energy/sources/gauge_integral.h"
#include "energy/sources/meter_scpi.h"
#include "energy/sources/meter_um25c.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace encore::energy {

namespace {

std::optional<Watts> power_of(const MeterSample& sample) {
  if (sample.power) return sample.power;
  if (sample.volts && sample.amps) return Watts(*sample.volts * *sample.amps);
  return std::nullopt;
}

/// Asks a meter, one request on the way at a time, without ever waiting for it.
class MeterSource final : public PowerSource {
 public:
  MeterSource(std::unique_ptr<SerialPort> port, std::unique_ptr<MeterProtocol> protocol,
              MeterSample first, Seconds timeout)
      : port_(std::move(port)), protocol_(std::move(protocol)), sample_(first), timeout_(timeout) {
    const MeterFacts facts = protocol_->facts();
    answers_are_new_ = facts.answers_are_new;
    longest_hold_ = std::min(timeout_, facts.update_period * 10);
    info_.name = "meter:" + facts.name;
    info_.kind = SourceKind::meter;
    info_.domain = Domain::system;
    info_.unit = port_->device();
    info_.includes = facts.includes;
    info_.place = fmt::format("{} ({})", port_->device(), facts.product);
    info_.provenance = {Origin::measured, "external meter " + facts.product};
    info_.is_counter = false;
    info_.update_period = facts.update_period;
    info_.poll_period = facts.update_period / 2;
    info_.power_step = facts.power_step;
    info_.gain_uncertainty = facts.gain_uncertainty;
  }

  [[nodiscard]] const SourceInfo& info() const override { return info_; }

  ReadResult read(Seconds now) override {
    const SerialPort::Received received = port_->receive();
    const std::vector<MeterSample> samples = protocol_->take(received.bytes, now);
    // The sample that opening took counts as new at the first reading.
    const bool answered = !samples.empty() || !last_answer_;
    if (!samples.empty()) sample_ = samples.back();
    if (answered) last_answer_ = now;
    if (received.gone) {
      return integral_.lost(info_.place + ": the meter is gone; check its cable or its radio link");
    }
    if (answered || now - asked_ > timeout_) {
      asked_ = now;
      if (!port_->send(protocol_->request())) {
        return integral_.failed(info_.place + ": the line takes no request; unplug and plug it in");
      }
    }
    return result(now, answered);
  }

 private:
  ReadResult result(Seconds now, bool answered) {
    // What it showed last holds for a few answers that fail to come, not for a broken link.
    if (now - *last_answer_ > longest_hold_) {
      const std::string complaint = protocol_->complaint();
      return integral_.failed(fmt::format("{}: no value for {:.1f} s{}; is it still on?",
                                          info_.place, (now - *last_answer_).value,
                                          complaint.empty() ? "" : ": " + complaint));
    }
    const std::optional<Watts> power = power_of(sample_);
    if (!power) return integral_.failed(info_.place + ": " + protocol_->complaint());
    if (power->value < 0) {
      return integral_.failed(
          fmt::format("{}: shows {:.3f} W; swap its leads, so that power flows "
                      "into the machine",
                      info_.place, power->value));
    }
    return integral_.add(now, *power, answered && answers_are_new_);
  }

  SourceInfo info_;
  std::unique_ptr<SerialPort> port_;
  std::unique_ptr<MeterProtocol> protocol_;
  GaugeIntegral integral_;
  MeterSample sample_;
  Seconds timeout_;
  Seconds longest_hold_;
  Seconds asked_;
  std::optional<Seconds> last_answer_;
  bool answers_are_new_ = false;
};

/// Asks until a sample comes. Throws SensorError with what came instead.
MeterSample first_sample(SerialPort& port, MeterProtocol& protocol, const MeterSettings& settings,
                         unsigned baud) {
  const SteadyClock clock;
  const Seconds end = clock.now() + settings.timeout;
  std::size_t count = 0;
  Bytes head;
  if (!port.send(protocol.request())) {
    throw SensorError(port.device() + ": the line takes no request; unplug and plug it in");
  }
  for (Seconds left = settings.timeout; left.value > 0; left = end - clock.now()) {
    const SerialPort::Received received = port.wait(left);
    if (received.gone)
      throw SensorError(port.device() + ": the meter went away while it was asked");
    count += received.bytes.size();
    if (head.size() < 16) {
      head.insert(head.end(), received.bytes.begin(), received.bytes.end());
      head.resize(std::min<std::size_t>(head.size(), 16));
    }
    const auto samples = protocol.take(received.bytes, Seconds(0));
    if (!samples.empty()) return samples.back();
  }
  if (count == 0) {
    throw SensorError(fmt::format(
        "{}: no answer within {:.1f} s; is the meter on, and is it the right device and speed ({} "
        "baud)?",
        port.device(), settings.timeout.value, baud));
  }
  const std::string complaint = protocol.complaint();
  throw SensorError(fmt::format(
      "{}: {} bytes came that are no sample{} (they begin with '{}'); is it the right meter and "
      "speed ({} baud)?",
      port.device(), count, complaint.empty() ? "" : ": " + complaint, printable(head), baud));
}

std::unique_ptr<MeterProtocol> make_protocol(const MeterSettings& settings) {
  if (settings.kind == MeterKind::scpi) return std::make_unique<ScpiProtocol>(settings);
  return std::make_unique<Um25cProtocol>();
}

}  // namespace

std::unique_ptr<PowerSource> open_meter(const MeterSettings& settings) {
  auto protocol = make_protocol(settings);
  const unsigned baud = settings.baud.value_or(protocol->usual_baud());
  auto port = std::make_unique<SerialPort>(settings.device, baud);
  protocol->greet(*port, settings.timeout);
  const MeterSample first = first_sample(*port, *protocol, settings, baud);
  return std::make_unique<MeterSource>(std::move(port), std::move(protocol), first,
                                       settings.timeout);
}

}  // namespace encore::energy
