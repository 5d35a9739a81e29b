#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace encore::app::bench {

/// One thing that is timed beside others.
struct Runner {
  std::string name;
  std::function<void()> run;
};

/// How times are taken.
struct RaceSettings {
  int rounds = 7;
  double least_s = 0.03;  ///< a sample is as many runs in a row as take this long, at least one
  double budget_s = 1e9;  ///< no further round begins after so long, once there are kLeastRounds
  int threads = 1;        ///< 1: processor time of the whole process; else wall time
  const std::atomic<bool>* cancel = nullptr;

  static constexpr int kLeastRounds = 3;
};

/// Seconds a run: times[runner][round]. All runners have the same number of rounds; fewer than
/// asked for if it took too long, perhaps none if it was cancelled.
using RaceTimes = std::vector<std::vector<double>>;

/// What this process has had of the processors so far, all threads together.
double processor_s();

/// Runs everybody once to warm up, then round by round everybody's sample in the order given
/// (A B C A B C …), so that what else the machine does meets all alike.
RaceTimes race(const std::vector<Runner>& runners, const RaceSettings& settings);

struct Spread {
  double min = 0.0;
  double median = 0.0;
  double max = 0.0;
};
/// All 0 for no values; the median of an even number is the mean of the two in the middle.
Spread spread_of(std::vector<double> values);

/// How many times as fast as `peer` this one was, round by round: over 1, ours is faster.
Spread speed_ratio(const std::vector<double>& ours, const std::vector<double>& peer);

}  // namespace encore::app::bench
