#pragma once

#include "energy/sources/power_source.h"
#include "energy/sources/serial_port.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace encore::energy {

/// What an external meter showed. Meters differ in what they tell.
struct MeterSample {
  Seconds time;  ///< when its last byte came in
  std::optional<double> volts;
  std::optional<double> amps;
  std::optional<Watts> power;
  std::optional<Joules> energy;  ///< the meter's own count, from whenever that began
};

/// What a protocol knows of its meter.
struct MeterFacts {
  std::string name;      ///< "um25c"
  std::string product;   ///< "RDTech UM25C", or what the meter called itself
  std::string includes;  ///< as in SourceInfo
  Seconds update_period{0.1};
  std::optional<Watts> power_step;
  double gain_uncertainty = 0.01;
  /// Each answer is a measurement of its own, even if it repeats the value before.
  bool answers_are_new = false;
};

/// One kind of meter: how to ask it and how to understand it. It sees bytes only, so that recorded
/// streams test it.
class MeterProtocol {
 public:
  virtual ~MeterProtocol() = default;
  /// Complete once the first sample was taken.
  [[nodiscard]] virtual MeterFacts facts() const = 0;
  [[nodiscard]] virtual unsigned usual_baud() const = 0;
  /// Sets the meter up after it was opened. Throws SensorError.
  virtual void greet(SerialPort& /*port*/, Seconds /*timeout*/) {}
  /// The bytes that ask for one sample.
  [[nodiscard]] virtual std::string request() const = 0;
  /// Takes bytes in whatever pieces they come; the samples that are complete with them. What is no
  /// sample is skipped.
  virtual std::vector<MeterSample> take(std::span<const std::uint8_t> bytes, Seconds time) = 0;
  /// The last thing that was understood and is no value ("overload"); empty if there is none.
  [[nodiscard]] virtual std::string complaint() const { return {}; }
};

/// The meters that can be named.
enum class MeterKind {
  um,    ///< RDTech UM24C, UM25C, UM34C; the frames tell which
  scpi,  ///< a bench multimeter or power meter that speaks SCPI
};

struct MeterSettings {
  MeterKind kind = MeterKind::um;
  std::string device;            ///< "/dev/rfcomm0"
  std::optional<unsigned> baud;  ///< empty: the meter's usual one
  /// SCPI: what the meter measures and what the user vouches for. Volts given: it measures amperes;
  /// amps given: it measures volts; none: it measures watts.
  std::optional<double> volts;
  std::optional<double> amps;
  std::string query;     ///< SCPI: what asks for a value; empty: by the meter's answer to *IDN?
  Seconds timeout{3.0};  ///< for an answer
};

/// Opens an external meter and waits for its first sample. A gauge of domain `system`. Throws
/// SensorError: no such device, no permission, no answer, an answer that makes no sense.
std::unique_ptr<PowerSource> open_meter(const MeterSettings& settings);

}  // namespace encore::energy
