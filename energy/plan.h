#pragma once

#include "energy/sources/power_source.h"
#include "energy/units.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace encore::energy {

/// In which order configurations (and their repeats) are measured. Machines drift, by temperature
/// above all; an order that mirrors or shuffles keeps drift from passing for a difference.
enum class Order {
  listed,    ///< as asked for, repeat by repeat
  abba,      ///< every second repeat backwards: linear drift cancels
  shuffled,  ///< every repeat in an order of its own, by the seed
};
std::string_view to_string(Order order);
std::optional<Order> parse_order(std::string_view word);

/// How one configuration is measured: pause, idle, warm up, measure, mix, idle. All times are of
/// the clock, all defaults those of the plan `quick`.
struct Plan {
  std::string name = "quick";
  /// Operations that are not measured: until both this long and this many. They fill caches and
  /// pools and let the clock frequency settle; too short, and the first rows come out slow.
  Seconds warm_up{0.2};
  std::uint64_t warm_up_operations = 1;
  /// Measured: until both this long and this many operations. Longer narrows the confidence
  /// interval with the square root of the time.
  Seconds run{1.5};
  std::uint64_t min_operations = 3;
  /// Stops earlier, after this many measured operations; 0: no limit.
  std::uint64_t max_operations = 0;
  /// A row holds one operation, or as many as it takes to fill this time, so that rows stay
  /// bounded (100 a second) however short operations are.
  Seconds row{0.010};
  /// Nothing runs for so long before and after, to see the machine's idle power. Too short, and a
  /// slow gauge has not settled yet; 0: no baseline, and so no net energy.
  Seconds idle_before{0.0};
  Seconds idle_after{0.0};
  /// Pause before each configuration, so that all start at the same temperature.
  Seconds cool_down{0.0};
  /// Time for blocks that repeat single phases in varied proportions, for phases that are too short
  /// for the sensor (attribution by regression); 0: none.
  Seconds mix{0.0};
  std::uint64_t mix_seed = 1;
  /// Reads all sources this often; without a value each at its own rate.
  std::optional<Seconds> poll;
  /// The thesis' cut: a gauge's samples below this are taken for idle and left out of the mean.
  /// Biased (docs/measuring.md); without a value samples are dropped by time instead, until the
  /// gauge has settled.
  std::optional<Watts> cut_below;
  /// Each configuration so many times.
  std::uint32_t repeats = 1;
  Order order = Order::listed;
  std::uint64_t order_seed = 1;
  /// Runs until the relative half-width of the 95 % interval of the figure of merit (joules an
  /// operation, or time where there is no sensor) is at most this; then `run` is the least time.
  std::optional<double> until;
  /// Gives up on `until` after so long.
  Seconds until_limit{600.0};

  friend bool operator==(const Plan&, const Plan&) = default;
};

/// Seconds a configuration: to look around, and for machines without a sensor.
Plan quick_plan();
/// The default where there is a sensor: long enough for that sensor to resolve about 1 %, with idle
/// windows that it can settle in (see fit_to_sources).
Plan settle_plan();
/// The protocol of the thesis (section 4.4.2): 10 s idle, 180 s, 10 s idle, read at 1 Hz, samples
/// under 24 W cut. Its idle windows are two or three updates of its gauge.
Plan thesis_plan();

/// The plan of this name, or nothing; names for messages and options.
std::optional<Plan> plan_by_name(std::string_view name);
inline constexpr std::string_view kPlanNames[] = {"quick", "settle", "thesis"};

/// Lengthens a `settle` plan to what the slowest of these sources needs: the run to 41 update
/// periods (one standard deviation of the edge error is then below 1 %), idle windows to 40 (at
/// least 2 s, at most 60 s), mixed blocks to 100, or to none if that takes longer than a minute (a
/// battery's gauge: ask for it with a time of its own). Leaves out everything
/// that only a sensor needs if there are no sources. Other plans stay as they are.
Plan fit_to_sources(Plan plan, std::span<const SourceInfo> sources);

/// What the plan takes at least, for one configuration and all its repeats.
Seconds least_duration(const Plan& plan);

/// The order in which `count` configurations are measured, repeats and all: indices from 0.
std::vector<std::size_t> measuring_order(const Plan& plan, std::size_t count);

}  // namespace encore::energy
