#pragma once

#include "energy/provenance.h"
#include "energy/units.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace encore::energy {

/// The technique behind a source.
enum class SourceKind {
  rapl,         ///< Linux powercap zones (Intel and AMD RAPL)
  perf_energy,  ///< the same counters through perf_event_open
  battery,      ///< the battery's gauge
  hwmon,        ///< sensors of the kernel's hwmon class
  nvml,         ///< NVIDIA's management library
  meter,        ///< an external power meter
  replay,       ///< a recording of a meter
  model,        ///< constants times busy time
  simulated,    ///< a test double; never chosen automatically
};
/// The words exactly as options and files hold them.
std::string_view to_string(SourceKind kind);
std::optional<SourceKind> parse_source_kind(std::string_view word);

/// What part of the machine a source sees. Domains nest: the system holds all others; the platform
/// holds package and memory; the package holds cores and integrated GPU. Package, memory and gpu
/// stand side by side.
enum class Domain {
  system,          ///< everything behind the plug or the battery
  platform,        ///< RAPL's psys: what the mainboard's maker wired to it
  package,         ///< a processor package: cores, caches, memory controller, integrated GPU
  cores,           ///< the cores of a package
  integrated_gpu,  ///< the GPU inside a package (RAPL's uncore)
  memory,          ///< memory modules (RAPL's dram)
  gpu,             ///< a discrete GPU's board
  socket,          ///< an APU as its GPU driver sees it: cores and GPU together
};
std::string_view to_string(Domain domain);
std::optional<Domain> parse_domain(std::string_view word);
/// Whether all that `inner` counts is counted by `outer`, too. A domain does not hold itself.
bool holds(Domain outer, Domain inner);

/// What is known of a source before it is read.
struct SourceInfo {
  /// Unique in a session, kind first: "rapl:package-0", "battery:BAT0", "nvml:0".
  std::string name;
  SourceKind kind = SourceKind::simulated;
  Domain domain = Domain::system;
  /// For sources of one domain that see different hardware: the socket, card or pack ("0",
  /// "0000:01:00.0"). Two sources of equal domain and unit are duplicates.
  std::string unit;
  /// One plain sentence: what the number includes and what it leaves out.
  std::string includes;
  /// The file, device or library that is read, for people.
  std::string place;
  Provenance provenance;
  /// A counter's joules come from the sensor; a gauge's watts are integrated here (trapezoids
  /// between readings).
  bool is_counter = true;
  /// Time between updates as documented; what is seen can differ (`encore doctor` measures it).
  Seconds update_period{0.001};
  /// How often to read it. Never so seldom that a counter could wrap twice.
  Seconds poll_period{0.05};
  /// Smallest step of the counter (J) or the gauge (W).
  std::optional<Joules> energy_step;
  std::optional<Watts> power_step;
  /// Standard uncertainty of the sensor's gain, relative. Cancels in ratios of one sensor.
  double gain_uncertainty = 0.05;
  /// Time constant of the sensor's own smoothing; 0: none known.
  Seconds smoothing{0.0};

  friend bool operator==(const SourceInfo&, const SourceInfo&) = default;
};

/// One reading of a source.
struct Reading {
  Seconds time;                ///< of the clock that was passed to read(): monotonic
  Joules energy;               ///< since the source was opened; never falls
  std::optional<Watts> power;  ///< what a gauge shows
  /// Whether the sensor's own value differs from the last reading's: a gauge repeats itself
  /// between updates. True for the first reading.
  bool changed = true;
};

/// How a reading went. Missing is never 0: a failed reading has no value.
enum class ReadState {
  ok,
  /// `reading` is good, but the energy since the reading before is unknown (counter reset, missed
  /// wrap, suspend, first reading after a failure): a new stretch of the trace begins with it.
  restarted,
  failed,  ///< no value now; may come back
  lost,    ///< will not come back (device removed, AC plugged in on a battery run)
};
struct ReadResult {
  ReadState state = ReadState::failed;
  Reading reading;      ///< only if ok or restarted
  std::string message;  ///< one line for people if not ok: place, what happened, way out
};

/// A sensor that counts joules. Each is read by one thread at a time. Destroying it closes it.
class PowerSource {
 public:
  virtual ~PowerSource() = default;
  [[nodiscard]] virtual const SourceInfo& info() const = 0;
  /// Reads the sensor; `now` is the monotonic clock's time right now. The first reading primes a
  /// counter: its energy is 0 and its state `ok`. Never throws for what a sensor can do.
  virtual ReadResult read(Seconds now) = 0;
};

}  // namespace encore::energy
