#pragma once

#include "app/window/live_attribution.h"
#include "app/window/power_monitor.h"
#include "app/workloads.h"
#include "energy/sources/discovery.h"
#include "energy/sources/simulated.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace encore::app {

/// A clock that goes on when it is told to.
class ManualClock final : public energy::Clock {
 public:
  [[nodiscard]] energy::Seconds now() const override { return energy::Seconds(now_); }
  void sleep_until(energy::Seconds time, const std::atomic<bool>&) const override {
    if (time.value > now_) now_ = time.value;
  }
  void go_on(energy::Seconds length) { now_ = now_ + length.value; }

 private:
  mutable std::atomic<double> now_{100.0};
};

/// A folder that goes with the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "encore-recording-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) std::abort();
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Waits for what another thread does; a minute is for ever.
inline bool eventually(const std::function<bool()>& condition) {
  for (int i = 0; i < 12000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

/// A machine whose power is known, a counter that sees it, and the window's measuring on top.
class RecordingWorld {
 public:
  explicit RecordingWorld(std::uint64_t seed = 1)
      : power_(std::make_shared<energy::StepPower>(clock_.now(), energy::Watts(20))),
        random_(seed),
        monitor_(setup(seed)),
        attribution_(
            monitor_,
            {.row = energy::Seconds(0.010), .every = energy::Seconds(1.0), .threaded = false}) {
    monitor_.choose({});
    monitor_.wait_until_open();
  }

  /// Time passes at so many watts; the counter is read 32 times a second.
  void pass(energy::Seconds length, double watts) {
    power_->add(clock_.now() + length, energy::Watts(watts));
    const energy::Seconds end = clock_.now() + length;
    while (clock_.now() < end) {
      clock_.go_on(std::min(energy::Seconds(0.03125), end - clock_.now()));
      monitor_.poll();
    }
  }
  void idle(double seconds) {
    attribution_.slot_began({});
    pass(energy::Seconds(seconds), 20.0);
    attribution_.slot_ended();
  }
  /// Frames of about `frame` seconds at about `watts`, for `seconds`.
  void load(const Slot& slot, double seconds, double frame, double watts,
            Device device = Device::cpu) {
    std::normal_distribution<double> normal;
    attribution_.slot_began(slot);
    const energy::Seconds end = clock_.now() + energy::Seconds(seconds);
    while (clock_.now() < end) {
      const energy::Seconds began = attribution_.begin_operation();
      monitor_.busy().begin(device, energy::Phase::render, began);
      pass(energy::Seconds(frame * (1.0 + 0.05 * normal(random_))),
           watts * (1.0 + 0.05 * normal(random_)));
      monitor_.busy().end(device, clock_.now());
      const energy::PhaseSpan span{energy::Phase::render, began, clock_.now()};
      attribution_.operation({&span, 1}, began, clock_.now());
    }
    attribution_.slot_ended();
  }

  ManualClock& clock() { return clock_; }
  PowerMonitor& monitor() { return monitor_; }
  LiveAttribution& attribution() { return attribution_; }

  static Slot slot_of(const char* device) {
    Slot slot;
    slot.idle = false;
    slot.configuration = {{"group", ""},
                          {"scene", "toys"},
                          {"device", device},
                          {"structure", "bvh-median"},
                          {"policy", "static"},
                          {"test", "static"},
                          {"width", "64"},
                          {"height", "32"},
                          {"memory", "pool"},
                          {"preset", ""},
                          {"build_on", ""},
                          {"update_case", ""},
                          {"intersection", "precise"},
                          {"grouping", "packets"},
                          {"rays", "none"},
                          {"samples", "1"},
                          {"depth", ""},
                          {"repeat", "1"},
                          {"triangles", "100"}};
    slot.rays = 64.0 * 32.0;
    return slot;
  }

  /// A counter of the world's power, by name.
  std::unique_ptr<energy::PowerSource> make_counter(const std::string& name, std::uint64_t seed) {
    energy::SimulatedSettings settings;
    settings.info.name = name;
    settings.info.domain = energy::Domain::package;
    settings.info.includes = "everything";
    settings.info.place = "a test";
    settings.info.update_period = energy::Seconds(0.001);
    settings.info.poll_period = energy::Seconds(0.03125);
    settings.info.gain_uncertainty = 0.0;
    settings.info.provenance.detail = "a test";
    settings.energy_until = [power = power_](energy::Seconds t) { return power->energy_until(t); };
    settings.seed = seed;
    return std::make_unique<energy::SimulatedSource>(std::move(settings));
  }

 private:
  PowerMonitor::Setup setup(std::uint64_t seed) {
    PowerMonitor::Setup setup;
    setup.clock = &clock_;
    setup.threaded = false;
    setup.boot = nullptr;
    setup.open = [this, seed](const MeasuringOptions& options, const energy::LiveBusyTime& live) {
      if (!options.model.empty()) return open_power_sources(options, live);
      const std::string name = options.sources.empty() ? "simulated:a" : options.sources.front();
      if (name == "broken") throw energy::SensorError("--source broken: no such sensor here");
      PowerSources opened;
      opened.sources.push_back(make_counter(name, seed));
      opened.total = {0};
      opened.provenance = opened.sources.front()->info().provenance;
      return opened;
    };
    return setup;
  }

  ManualClock clock_;
  std::shared_ptr<energy::StepPower> power_;
  std::mt19937_64 random_;
  PowerMonitor monitor_;
  LiveAttribution attribution_;
};

}  // namespace encore::app
