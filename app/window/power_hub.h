#pragma once

#include "app/window/power_monitor.h"
#include "app/window/power_point.h"

#include <atomic>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace encore::app {

/// What the threads of a PowerMonitor share: readings go in, news and states come out.
class PowerHub {
 public:
  PowerHub(const energy::Clock& clock, energy::Seconds start) : clock_(clock), start_(start) {}

  [[nodiscard]] const energy::Clock& clock() const { return clock_; }
  [[nodiscard]] energy::Seconds start() const { return start_; }

  /// Makes `set` the one that is read: readings of others are passed over from now on.
  void install(const std::shared_ptr<const PowerSet>& set);
  [[nodiscard]] std::shared_ptr<const PowerSet> current() const;

  void reading(std::uint64_t generation, const energy::SourceInfo& info,
               const energy::ReadResult& result);
  /// The same message of one source is told once a minute.
  void event(const energy::SamplerEvent& event);
  void set_sink(energy::SamplerSink sink);

  void set_cost(const energy::SamplerCost& cost);
  void set_opening(bool opening);
  void set_error(std::string error);
  [[nodiscard]] PowerState state() const;
  PowerNews drain();

  /// When a listener last read sources at a phase's edge.
  std::atomic<double> last_edge{-1.0};

 private:
  struct Series {
    MonitoredSource source;
    std::vector<PowerPoint> pending;
    bool ever = false;   ///< it had a point, of this set or one before
    bool fresh = false;  ///< this set has not read it yet
    std::optional<double> watts;
  };
  Series* series_of(const energy::SourceInfo& info);

  const energy::Clock& clock_;
  energy::Seconds start_;
  mutable std::mutex mutex_;
  std::shared_ptr<const PowerSet> current_;
  std::vector<Series> series_;
  PowerPoints points_;
  std::vector<MonitorEvent> events_;
  std::map<std::pair<std::string, std::string>, energy::Seconds> told_;
  std::uint64_t dropped_ = 0;
  energy::SamplerCost cost_;
  bool opening_ = false;
  std::string error_;
  std::mutex sink_mutex_;
  energy::SamplerSink sink_;
};

}  // namespace encore::app
