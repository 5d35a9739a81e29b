#include "app/window/power_monitor.h"

#include "app/exit_code.h"
#include "app/window/phase_edges.h"
#include "app/window/power_hub.h"
#include "app/window/watched_source.h"

#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <string_view>
#include <thread>
#include <utility>

namespace encore::app {

namespace {

constexpr std::string_view kCommandLineHint = "; 'encore doctor' tells more";

const energy::Clock& steady_clock() {
  static const energy::SteadyClock clock;
  return clock;
}

/// Why there is nothing, and the ways out that the window has.
std::string without_sensor(std::string why, const MeasuringOptions& options) {
  if (why.ends_with(kCommandLineHint)) why.resize(why.size() - kCommandLineHint.size());
  const bool refused = options.sources.size() == 1 && options.sources.front() == "none";
  if (refused) return "power is not measured, as was asked for; pick a sensor to measure it";
  return fmt::format(
      "this machine has no power sensor that can be read{}{}; run `encore doctor`, or enter idle "
      "and busy watts",
      why.empty() ? "" : ": ", why);
}

/// Messages are made for the command line: without its dashes they do for a window.
std::string for_window(std::string message) {
  return message.starts_with("--") ? message.substr(2) : message;
}

/// Keeps a sampler reading. It is told what that costs, which only this thread may wait for.
class Driver {
 public:
  Driver(std::shared_ptr<const PowerSet> set, std::shared_ptr<PowerHub> hub)
      : set_(std::move(set)), hub_(std::move(hub)), thread_([this](const std::stop_token& stop) {
          std::mutex mutex;
          std::condition_variable_any wake;
          while (!stop.stop_requested()) {
            const energy::Seconds next = set_->sampler->poll();
            hub_->set_cost(set_->sampler->cost());
            const double wait = (next - hub_->clock().now()).value;
            std::unique_lock lock(mutex);
            wake.wait_for(lock, stop, std::chrono::duration<double>(std::max(wait, 0.0)),
                          [] { return false; });
          }
        }) {}

 private:
  std::shared_ptr<const PowerSet> set_;
  std::shared_ptr<PowerHub> hub_;
  std::jthread thread_;
};

}  // namespace

/// Opens what is asked for, one request after the other, and puts it in the place of what is read.
class PowerMonitor::Opener {
 public:
  Opener(Setup setup, std::shared_ptr<PowerHub> hub, std::shared_ptr<BusyMarks> busy)
      : setup_(std::move(setup)),
        hub_(std::move(hub)),
        busy_(std::move(busy)),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  void ask(MeasuringOptions options) {
    {
      const std::lock_guard lock(mutex_);
      chosen_ = options;
      wanted_ = std::move(options);
    }
    hub_->set_opening(true);
    wake_.notify_all();
  }
  MeasuringOptions chosen() {
    const std::lock_guard lock(mutex_);
    return chosen_;
  }
  void wait() {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return !wanted_ && !busy_opening_; });
  }

 private:
  void run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (wake_.wait(lock, stop, [this] { return wanted_.has_value(); })) {
      const MeasuringOptions options = std::move(*wanted_);
      wanted_.reset();
      busy_opening_ = true;
      lock.unlock();
      std::string error;
      try {
        replace(open(options));
      } catch (const std::exception& failure) {
        error = for_window(failure.what());
      }
      lock.lock();
      busy_opening_ = false;
      hub_->set_error(error);
      hub_->set_opening(wanted_.has_value());
      wake_.notify_all();
    }
  }

  std::shared_ptr<PowerSet> open(const MeasuringOptions& options) {
    auto set = std::make_shared<PowerSet>();
    set->busy = busy_;
    PowerSources opened = setup_.open(options, busy_->live());
    set->generation = ++generation_;
    set->total = opened.total;
    set->total_name = total_name(opened);
    set->provenance = std::move(opened.provenance);
    if (set->total.empty()) {
      set->provenance.detail = without_sensor(std::move(set->provenance.detail), options);
    }
    std::optional<energy::Seconds> poll;
    if (options.poll) poll = energy::Seconds(*options.poll);
    std::vector<std::unique_ptr<energy::PowerSource>> sources;
    for (std::size_t i = 0; i < opened.sources.size(); ++i) {
      const bool in_total = std::find(set->total.begin(), set->total.end(), i) != set->total.end();
      sources.push_back(std::make_unique<WatchedSource>(std::move(opened.sources[i]), poll, busy_));
      set->sources.push_back({sources.back()->info(), in_total});
    }
    set->since = hub_->clock().now();
    if (sources.empty()) return set;
    // Not the set's own: sets outlive the monitor, which is told of readings.
    const std::weak_ptr<PowerHub> hub = hub_;
    energy::SamplerSink sink;
    sink.on_reading = [hub, generation = generation_](const auto& info, const auto& result) {
      if (const auto alive = hub.lock()) alive->reading(generation, info, result);
    };
    sink.on_event = [hub](const auto& event) {
      if (const auto alive = hub.lock()) alive->event(event);
    };
    set->sampler = std::make_unique<energy::Sampler>(std::move(sources), hub_->clock(),
                                                     std::move(sink), setup_.boot);
    return set;
  }

  void replace(const std::shared_ptr<PowerSet>& set) {
    driver_.reset();
    hub_->install(set);
    hub_->set_cost({});
    const std::string now = set->total.empty() ? set->provenance.detail : set->total_name;
    hub_->event({set->since, "", "power sources: " + now});
    if (set->sampler && setup_.threaded) driver_.emplace(set, hub_);
  }

  Setup setup_;
  std::shared_ptr<PowerHub> hub_;
  std::shared_ptr<BusyMarks> busy_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  MeasuringOptions chosen_;
  std::optional<MeasuringOptions> wanted_;
  bool busy_opening_ = false;
  std::uint64_t generation_ = 0;
  std::optional<Driver> driver_;
  std::jthread thread_;
};

PowerMonitor::PowerMonitor() : PowerMonitor(Setup{}) {}

PowerMonitor::PowerMonitor(Setup setup) : busy_(std::make_shared<BusyMarks>()) {
  const energy::Clock& clock = setup.clock != nullptr ? *setup.clock : steady_clock();
  hub_ = std::make_shared<PowerHub>(clock, clock.now());
  opener_ = std::make_unique<Opener>(std::move(setup), hub_, busy_);
}

PowerMonitor::~PowerMonitor() = default;

void PowerMonitor::choose(MeasuringOptions options) {
  opener_->ask(std::move(options));
}
MeasuringOptions PowerMonitor::chosen() const {
  return opener_->chosen();
}
void PowerMonitor::wait_until_open() {
  opener_->wait();
}
PowerState PowerMonitor::state() const {
  return hub_->state();
}
PowerNews PowerMonitor::drain() {
  return hub_->drain();
}
BusyMarks& PowerMonitor::busy() {
  return *busy_;
}
std::unique_ptr<energy::PhaseListener> PowerMonitor::listener(Device device) {
  return std::make_unique<PhaseEdges>(device, hub_, busy_);
}
std::shared_ptr<const PowerSet> PowerMonitor::current() const {
  return hub_->current();
}
bool PowerMonitor::edges_read_since(energy::Seconds time) const {
  return hub_->last_edge >= time.value;
}
void PowerMonitor::read_now(energy::Seconds slowest) {
  const auto set = hub_->current();
  if (set && set->sampler) set->sampler->read_now(slowest);
}
void PowerMonitor::poll() {
  const auto set = hub_->current();
  if (!set || !set->sampler) return;
  set->sampler->poll();
  hub_->set_cost(set->sampler->cost());
}
void PowerMonitor::set_sink(energy::SamplerSink sink) {
  hub_->set_sink(std::move(sink));
}
const energy::Clock& PowerMonitor::clock() const {
  return hub_->clock();
}
energy::Seconds PowerMonitor::start() const {
  return hub_->start();
}

std::string model_from_watts(double idle_watts, double busy_watts) {
  if (!(idle_watts >= 0.0) || !(busy_watts > idle_watts)) {
    throw UsageError(
        fmt::format("idle {:g} W and busy {:g} W: busy must be more than idle, and neither below 0",
                    idle_watts, busy_watts));
  }
  return fmt::format("idle={},busy={}", idle_watts, busy_watts - idle_watts);
}

}  // namespace encore::app
