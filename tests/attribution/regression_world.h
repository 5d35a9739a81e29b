#pragma once

#include "energy/attribution/excitation.h"
#include "energy/attribution/regression.h"
#include "energy/sampling/trace.h"
#include "energy/sources/simulated.h"

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace encore::energy {

/// A machine whose phases draw known power, and the trace that a sensor makes of it.
struct World {
  explicit World(std::vector<std::string> columns, Watts idle_power = Watts(20),
                 std::uint64_t seed = 1)
      : timeline(std::move(columns), Seconds(0)),
        power(Seconds(0), idle_power),
        idle_watts(idle_power),
        random(seed) {}

  /// Nothing runs.
  void sleep(Seconds length) { step(length, Watts(0)); }
  /// A column runs at so many watts above idle. Power that fluctuates does so from run to run.
  void run(std::size_t column, Seconds length, Watts above) {
    timeline.add(column, now, now + length);
    step(length, above * (1.0 + fluctuation * normal(random)));
  }
  /// Two columns at once; `both`: what they draw together.
  void run_both(std::size_t a, std::size_t b, Seconds length, Watts both) {
    timeline.add(a, now, now + length);
    timeline.add(b, now, now + length);
    step(length, both);
  }
  /// Idle before and after, load in between.
  void idle_for(Seconds length) {
    idle.push_back({now, now + length});
    sleep(length);
  }
  void load_begins() { loaded.push_back({now, now}); }
  void load_ends() { loaded.back().to = now; }

  /// Reads a simulated sensor through the whole time, polls a little uneven.
  void measure(SimulatedSettings settings) {
    auto all = std::make_shared<StepPower>(power);
    settings.energy_until = [all](Seconds t) { return all->energy_until(t); };
    SimulatedSource source(std::move(settings));
    info = source.info();
    Trace seen;
    std::uniform_real_distribution<double> uneven(0.9, 1.1);
    for (Seconds t(0.0); t < now; t += info.poll_period * uneven(random)) {
      const ReadResult result = source.read(t);
      if (result.state == ReadState::ok || result.state == ReadState::restarted) {
        seen.add(result.reading, result.state == ReadState::restarted);
      } else {
        seen.add_gap();
      }
    }
    trace = seen.view();
  }
  /// A counter that is exact whenever it is read.
  void measure_exactly(Seconds poll) {
    SimulatedSettings settings = counter(Seconds(0), poll);
    settings.info.update_period = poll;
    measure(settings);
  }
  static SimulatedSettings counter(Seconds period, Seconds poll) {
    SimulatedSettings settings;
    settings.info.name = "simulated:counter";
    settings.info.update_period = period;
    settings.info.poll_period = poll;
    settings.shortest_hold = settings.longest_hold = period;
    return settings;
  }

  [[nodiscard]] PhaseFit fit() const { return fit_phases(info, trace, timeline, idle, loaded); }

  BusyTimeline timeline;
  StepPower power;
  Watts idle_watts;
  Seconds now{0.0};
  std::mt19937_64 random;
  std::normal_distribution<double> normal;
  double fluctuation = 0.0;  ///< of a run's power, relative
  double wander = 0.0;       ///< W, of power that changes slowly whatever runs
  std::vector<Window> idle;
  std::vector<Window> loaded;
  SourceInfo info;
  TraceView trace;

 private:
  void step(Seconds length, Watts above) {
    if (wander > 0.0) {
      // Correlated over about a second.
      const double phi = std::exp(-length.value);
      off_ = phi * off_ + std::sqrt(1.0 - phi * phi) * wander * normal(random);
    }
    now += length;
    power.add(now, idle_watts + above + Watts(off_));
  }
  double off_ = 0.0;
};

/// Runs mix blocks over the columns (in the order of `phases`), run times uneven by 10 %.
inline void run_blocks(World& world, const std::vector<MixBlock>& blocks,
                       const std::vector<Phase>& phases, const PerPhase<Seconds>& times,
                       const std::vector<Watts>& powers) {
  std::uniform_real_distribution<double> uneven(0.9, 1.1);
  for (const MixBlock& block : blocks) {
    for (std::size_t c = 0; c < phases.size(); ++c) {
      for (std::size_t i = 0; i < block.repeats[phases[c]]; ++i) {
        world.run(c, times[phases[c]] * uneven(world.random), powers[c]);
      }
    }
    if (block.sleep.value > 0.0) world.sleep(block.sleep);
  }
}

/// A counter of 1 mJ that a graphics card updates about ten times a second.
inline SimulatedSettings nvml_like() {
  SimulatedSettings settings = World::counter(Seconds(0.1), Seconds(0.025));
  settings.info.energy_step = Joules(0.001);
  settings.shortest_hold = Seconds(0.085);
  settings.longest_hold = Seconds(0.115);
  return settings;
}

}  // namespace encore::energy
