#pragma once

#include "app/measuring_options.h"
#include "app/power_sources.h"
#include "app/window/busy_marks.h"
#include "app/window/power_point.h"
#include "app/window/power_set.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// A source as the window lists it. Reopened unchanged it keeps its id, with a gap; with other
/// constants or settings it is another series.
struct MonitoredSource {
  std::uint32_t id = 0;
  energy::SourceInfo info;
  bool in_total = false;
  bool active = false;  ///< is being read; false: only its history is left
  bool lost = false;
};

struct MonitorEvent {
  double time_s = 0.0;
  std::string source;  ///< empty: the machine or the monitor
  std::string message;
};

/// What came in since the last drain().
struct PowerNews {
  struct Points {
    std::uint32_t source = 0;  ///< MonitoredSource::id
    std::vector<PowerPoint> points;
  };
  std::vector<Points> points;  ///< only sources with new points
  std::vector<MonitorEvent> events;
  std::uint64_t dropped =
      0;  ///< points nobody asked for in time: of a source the oldest beyond 2^18 go
};

/// Where the monitor stands; cheap to ask every frame.
struct PowerState {
  std::vector<MonitoredSource> sources;  ///< all since the start, in the order of their ids
  /// Of the total: which sensors, or why there is nothing and the way out, as one line.
  energy::Provenance total;
  std::string total_name;
  bool opening = false;          ///< sources are being opened
  std::string error;             ///< why the last choice was refused; the old sources stay
  std::optional<double> watts;   ///< of the total: the latest of each of its sources
  energy::SamplerCost cost;      ///< of the sources being read
  std::uint64_t generation = 0;  ///< PowerSet's; 0 before the first set is open
};

class PowerHub;

/// Reads the machine's power sources for as long as it lives, and lets others be picked meanwhile.
/// Nothing here blocks for longer than a copy: sources are opened on a thread of the monitor's own,
/// and read on another one.
class PowerMonitor {
 public:
  /// What tests put in the place of the machine.
  struct Setup {
    std::function<PowerSources(const MeasuringOptions&, const energy::LiveBusyTime&)> open =
        open_power_sources;
    const energy::Clock* clock = nullptr;  ///< null: the steady clock; must outlive the monitor
    bool threaded = true;                  ///< false: poll() drives the sampler
    std::function<energy::Seconds()> boot = energy::boot_time;
  };
  PowerMonitor();
  explicit PowerMonitor(Setup setup);
  ~PowerMonitor();
  PowerMonitor(const PowerMonitor&) = delete;
  PowerMonitor& operator=(const PowerMonitor&) = delete;

  /// Opens these sources (only sources, model, poll and sensor_root are looked at) in the
  /// background and reads them in the place of those before. If that fails, the old ones stay and
  /// state().error says why. Of several calls in a row the last one counts.
  void choose(MeasuringOptions options);
  /// What was asked for last.
  [[nodiscard]] MeasuringOptions chosen() const;
  /// Blocks until nothing is being opened any more; for tests and the end of the program.
  void wait_until_open();

  [[nodiscard]] PowerState state() const;
  /// Every point and event since the last call, once. For one caller: the UI.
  PowerNews drain();

  /// Is told of phases by the threads that trace.
  [[nodiscard]] BusyMarks& busy();
  /// Also reads sources that update often enough right before and after long phases, as the
  /// command line does. One a tracing thread; the monitor must outlive it.
  [[nodiscard]] std::unique_ptr<energy::PhaseListener> listener(Device device);

  /// The sources that are being read; null before the first choice is open.
  [[nodiscard]] std::shared_ptr<const PowerSet> current() const;
  /// Whether a listener() has read sources at a phase's edges since then.
  [[nodiscard]] bool edges_read_since(energy::Seconds time) const;
  /// Reads all of them right now: at the edges of slots. On a thread that may wait for a sensor.
  void read_now(energy::Seconds slowest = energy::Seconds(0));
  /// Drives the sampler where nothing else does (Setup::threaded is false).
  void poll();

  /// Is told every reading and event from now on, on the thread that read, until it is replaced;
  /// none of the old one's calls is under way when this returns.
  void set_sink(energy::SamplerSink sink);

  [[nodiscard]] const energy::Clock& clock() const;
  /// The clock's time that time_s counts from.
  [[nodiscard]] energy::Seconds start() const;

 private:
  class Opener;
  std::shared_ptr<PowerHub> hub_;
  std::shared_ptr<BusyMarks> busy_;
  std::unique_ptr<Opener> opener_;
};

/// The constants "idle=12,busy=33" of a machine that draws so many watts when idle and when busy.
/// Throws UsageError unless 0 <= idle < busy.
std::string model_from_watts(double idle_watts, double busy_watts);

}  // namespace encore::app
