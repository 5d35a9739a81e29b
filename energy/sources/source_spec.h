#pragma once

#include "energy/sources/meter.h"
#include "energy/sources/power_source.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace encore::energy {

/// A recording that is to be used, and what is known of its clock.
struct ReplaySettings {
  std::string file;
  std::optional<Seconds> offset;  ///< added to the recording's times; empty: found by aligning
};

/// What `--source` names.
struct SourceSpec {
  SourceKind kind = SourceKind::rapl;
  /// Of found sensors: the name behind the kind ("package-0" of "rapl:package-0"); empty: all of
  /// the kind.
  std::string unit;
  std::optional<MeterSettings> meter;    ///< kind meter
  std::optional<ReplaySettings> replay;  ///< kind replay

  /// Whether a found sensor of this kind and name ("rapl:package-0") is meant.
  [[nodiscard]] bool names(const SourceInfo& info) const;
};

/// A text that names no source. what() is one line with the way out.
class SourceSpecError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Understands
///   KIND or KIND:NAME      rapl, perf, battery, hwmon, nvml, model, simulated
///   meter:um24c:DEVICE     also um25c, um34c
///   meter:scpi:DEVICE:volts=19.5   (or amps=, or neither for a meter that shows watts;
///                                   query=MEAS1?, baud=115200)
///   replay:FILE            (offset=SECONDS)
/// Options stand at the end, each as ":name=value"; devices and files may hold colons. Throws
/// SourceSpecError.
SourceSpec parse_source_spec(std::string_view text);

}  // namespace encore::energy
