#pragma once

#include "energy/units.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace encore::energy {

using Bytes = std::vector<std::uint8_t>;

/// A serial line: 8 data bits, no parity, one stop bit, no flow control, every byte as it is.
/// Nothing waits unless it is told to.
class SerialPort {
 public:
  /// Opens a terminal device and claims it. `baud`: one of the usual speeds. Throws SensorError
  /// naming the device, what stands in the way and the way out.
  SerialPort(const std::string& device, unsigned baud);
  ~SerialPort();
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  [[nodiscard]] const std::string& device() const { return device_; }

  struct Received {
    Bytes bytes;
    bool gone = false;  ///< the device was removed, or its radio link broke
  };
  /// What has come in so far.
  Received receive();
  /// Waits for the first bytes, `timeout` at most, and returns them; none if nothing came.
  Received wait(Seconds timeout);
  /// Sends all of it; false if the line does not take it at once (it is gone or stuck).
  bool send(std::string_view bytes);
  /// Forgets what came in and was not received.
  void drain();

 private:
  std::string device_;
  int file_ = -1;
};

/// The text of these bytes for a message: printable ones as they are, others as "\xf0".
std::string printable(std::span<const std::uint8_t> bytes);

}  // namespace encore::energy
