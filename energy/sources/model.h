#pragma once

#include "energy/phase_log.h"
#include "energy/sources/power_source.h"

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace encore::energy {

/// Constants that cannot be used. what() is one line: place, reason, way out.
class PowerModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a machine draws as constants: P = idle + sum of the deltas of what is busy. The older form
/// with one power a phase is the special case P_phase = idle + delta with phases that fill the
/// time.
struct PowerModel {
  Watts idle;
  /// Above idle while the phase runs. Empty: not known, and then energy is not known either while
  /// that phase runs (it is never 0 instead).
  PerPhase<std::optional<Watts>> delta;
  /// Above idle while the GPU works, whatever phase runs beside it.
  std::optional<Watts> gpu;
  /// Where the constants come from, in words: "given by the user".
  std::string detail;
  /// Standard uncertainty of the constants, relative; empty: nobody said.
  std::optional<double> uncertainty;

  friend bool operator==(const PowerModel&, const PowerModel&) = default;
};

/// Largest power that is believed, W.
inline constexpr double kLargestModelPower = 1e5;
/// What is assumed of constants whose uncertainty nobody gave.
inline constexpr double kUnknownModelUncertainty = 0.2;

/// Throws PowerModelError unless every constant is a number from 0 to kLargestModelPower, at least
/// one is above idle, and the uncertainty lies in [0, 1].
void check(const PowerModel& model);

/// The constants in words: "idle 19 W; above it: build 14.6 W, render 15.6 W".
std::string describe(const PowerModel& model);

/// What was busy for how long.
struct BusyTimes {
  PerPhase<Seconds> phases{};
  Seconds gpu;
};

/// idle * elapsed + sum delta_k * busy_k; nothing if something without a constant was busy.
std::optional<Joules> modelled_energy(const PowerModel& model, Seconds elapsed,
                                      const BusyTimes& busy);

/// Cumulative busy times up to `now`, the running phase included (LiveBusyTime gives those of the
/// phases). Called by the thread that reads the source.
using BusyFunction = std::function<BusyTimes(Seconds now)>;

/// A counter of modelled joules, "model:constants". Its readings fail, with a message that names
/// the phase, while something without a constant is busy and a second longer. Throws
/// PowerModelError as check() does.
std::unique_ptr<PowerSource> make_model_source(const PowerModel& model, BusyFunction busy);

/// What is known of that source before it is opened.
SourceInfo model_source_info(const PowerModel& model);

}  // namespace encore::energy
