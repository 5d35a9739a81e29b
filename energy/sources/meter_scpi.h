#pragma once

#include "energy/sources/meter.h"

namespace encore::energy {

/// The number that begins an answer ("+1.23E-01", "0.5,ADC"); nothing if there is none. SCPI's
/// marks for overload and "not a number" (magnitudes from 9.9E37) come back as they are.
std::optional<double> parse_scpi_number(std::string_view line);

/// A meter that answers SCPI queries with one number a line. A multimeter shows current or voltage:
/// the user vouches for the other, which `includes` says.
class ScpiProtocol final : public MeterProtocol {
 public:
  /// Uses volts, amps and query. Throws SensorError if both volts and amps are given or one of them
  /// is not positive.
  explicit ScpiProtocol(const MeterSettings& settings);

  [[nodiscard]] MeterFacts facts() const override;
  [[nodiscard]] unsigned usual_baud() const override { return 9600; }
  /// Asks for the meter's name and sets the quantity, unless the user gave a query.
  void greet(SerialPort& port, Seconds timeout) override;
  [[nodiscard]] std::string request() const override { return query_ + "\n"; }
  std::vector<MeterSample> take(std::span<const std::uint8_t> bytes, Seconds time) override;
  [[nodiscard]] std::string complaint() const override { return complaint_; }

 private:
  std::optional<MeterSample> sample_of(std::string_view line, Seconds time);

  std::optional<double> volts_;
  std::optional<double> amps_;
  std::string query_;
  bool user_query_ = false;
  std::string product_ = "SCPI meter";
  std::string pending_;
  std::string complaint_;
};

}  // namespace encore::energy
