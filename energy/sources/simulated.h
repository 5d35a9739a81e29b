#pragma once

#include "energy/sources/gauge_integral.h"
#include "energy/sources/power_source.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace encore::energy {

/// Power in steps: exact, and cheap to ask at any time.
class StepPower {
 public:
  /// Before `start` the power is `before`.
  explicit StepPower(Seconds start, Watts before = Watts(0));
  /// `power` from the end of the step before up to `end`; the last step goes on for ever. Ends
  /// rise.
  void add(Seconds end, Watts power);
  /// Joules from `start` to `time` (negative before it).
  [[nodiscard]] Joules energy_until(Seconds time) const;
  [[nodiscard]] Seconds end() const { return knots_.back().time; }

 private:
  struct Knot {
    Seconds time;
    Joules energy;
  };
  std::vector<Knot> knots_;
  Watts before_;
  Watts last_;
};

/// What goes wrong in a simulated sensor, and when.
struct SimulatedFault {
  enum class Kind {
    fail,   ///< no value in [from, to)
    reset,  ///< the counter starts anew at `from`
    lose,   ///< the device is gone from `from` on
  };
  Kind kind = Kind::fail;
  Seconds from;
  Seconds to;
};

/// A sensor to be simulated.
struct SimulatedSettings {
  /// Name, domain, counter or gauge, periods, steps; kind and provenance are always "simulated".
  SourceInfo info;
  /// The true joules from any fixed moment up to a time; must not fall.
  std::function<Joules(Seconds)> energy_until;
  /// Time between two updates: uniform in this range, a fixed period if both are equal, a sensor
  /// that is always fresh if both are 0. The phase of the first update is random.
  Seconds shortest_hold{0.001};
  Seconds longest_hold{0.001};
  /// A counter's raw value has so many bits and wraps; 64 or a step of 0: never.
  unsigned counter_bits = 64;
  /// A gauge shows the mean power over so long before the update.
  Seconds window{0.001};
  /// Standard deviation of what an update is off by: W of a gauge, J of a counter (which then still
  /// never falls). Neighbours are correlated by `noise_correlation` in [0, 1).
  double noise = 0.0;
  double noise_correlation = 0.0;
  /// Factor on all that is shown: a sensor that is not calibrated.
  double gain = 1.0;
  std::vector<SimulatedFault> faults;
  std::uint64_t seed = 1;
};

/// A test double whose truth is known. Shows the truth as a sensor would: smoothed over
/// info.smoothing (first-order low pass), then held between updates, then rounded down to
/// info.energy_step or to the nearest info.power_step. Equal settings and reading times give equal
/// readings. Reads no clock and starts no thread.
class SimulatedSource final : public PowerSource {
 public:
  explicit SimulatedSource(SimulatedSettings settings);

  [[nodiscard]] const SourceInfo& info() const override { return settings_.info; }
  ReadResult read(Seconds now) override;

  /// What really flowed.
  [[nodiscard]] Joules true_energy(Seconds from, Seconds to) const;

 private:
  void update_until(Seconds now);
  void update_at(Seconds time);
  [[nodiscard]] double hold();
  [[nodiscard]] double smoothed(Seconds time);
  [[nodiscard]] double next_noise();
  ReadResult read_counter(Seconds now, bool prime);

  SimulatedSettings settings_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  GaugeIntegral integral_;
  bool opened_ = false;  ///< the first update was made
  bool first_read_ = true;
  bool failed_ = false;
  Seconds last_update_;
  Seconds next_update_;
  Seconds filtered_until_;
  double filtered_ = 0.0;
  double noise_now_ = 0.0;
  double shown_ = 0.0;          ///< what the sensor shows: joules or watts, not yet rounded
  std::uint64_t last_raw_ = 0;  ///< of a counter with steps
  std::uint64_t steps_ = 0;     ///< since it was opened, wraps undone
  double joules_ = 0.0;         ///< of a counter without steps
  double last_shown_ = 0.0;
  Seconds last_read_;
};

/// The ready-made sensors of the command line: "rapl" (a 32-bit counter of 61 uJ, each 1 ms),
/// "nvml" (a counter of 1 mJ, each 100 ms), "battery" (a gauge of 10 mW, held 3 to 6 s). They are
/// named "simulated:rapl" and so on and show a slowly swinging load that has nothing to do with
/// this machine. Throws std::invalid_argument naming the presets if there is none of that name.
std::unique_ptr<SimulatedSource> make_simulated(std::string_view preset, std::uint64_t seed = 1);
/// Their settings, for tests that put their own power in.
SimulatedSettings simulated_preset(std::string_view preset);
std::vector<std::string> simulated_presets();

}  // namespace encore::energy
