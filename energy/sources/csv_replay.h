#pragma once

#include "energy/sampling/trace.h"
#include "energy/sources/power_source.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace encore::energy {

/// What a meter recorded by itself, on its own clock.
struct Recording {
  std::string file;
  bool is_counter = false;  ///< its rows hold joules, not watts
  TraceView trace;          ///< its seconds; joules since its first row
  Seconds spacing;          ///< median time between rows
};

/// Reads a CSV recording: a header, then one row a reading. It needs a column of time and one of
/// energy or power, or of volts and amperes. Names may be written in many ways and carry a unit:
/// "time_s", "Time (ms)", "watts", "Power [mW]", "energy_wh", "Voltage(V)", "current_ma". Separated
/// by commas, semicolons or tabs (decimal commas with the last two); lines that begin with # are
/// skipped. Where several would do, joules are taken before watts, and watts before watt-hours. An
/// empty field, or a pause ten times longer than usual, is a gap. Throws SensorError "file:line:
/// what".
Recording load_recording(const std::filesystem::path& file);

/// What is known of a recording as a power source.
SourceInfo replay_info(const Recording& recording);

/// The recording on the session's clock: `offset` (sampling/align.h finds it) is added to its
/// times.
TraceView aligned_trace(const Recording& recording, Seconds offset);

/// Plays a recording as if it were measured now. Without an offset it begins with the first
/// reading. Past its end it is lost; in its gaps it fails.
std::unique_ptr<PowerSource> open_replay(Recording recording,
                                         std::optional<Seconds> offset = std::nullopt);

}  // namespace encore::energy
