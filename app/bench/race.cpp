#include "app/bench/race.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

namespace encore::app::bench {

namespace {

constexpr double kMostRuns = 1e5;  // of one sample

double clock_s(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// One thread: time that the process did not get, on a machine that others use too, is nobody's.
double now_s(int threads) {
  return threads == 1 ? processor_s() : clock_s(CLOCK_MONOTONIC);
}

double seconds_a_run(const Runner& runner, int runs, int threads) {
  const double start = now_s(threads);
  for (int i = 0; i < runs; ++i) runner.run();
  return (now_s(threads) - start) / runs;
}

bool cancelled(const RaceSettings& settings) {
  return settings.cancel != nullptr && settings.cancel->load();
}

}  // namespace

double processor_s() {
  return clock_s(CLOCK_PROCESS_CPUTIME_ID);
}

RaceTimes race(const std::vector<Runner>& runners, const RaceSettings& settings) {
  using Clock = std::chrono::steady_clock;
  RaceTimes times(runners.size());
  const auto start = Clock::now();
  std::vector<int> runs;
  for (const Runner& runner : runners) {
    if (cancelled(settings)) return times;
    const double once = std::max(seconds_a_run(runner, 1, settings.threads), 1e-9);
    runs.push_back(
        static_cast<int>(std::clamp(std::ceil(settings.least_s / once), 1.0, kMostRuns)));
  }
  for (int round = 0; round < settings.rounds; ++round) {
    const std::chrono::duration<double> taken = Clock::now() - start;
    if (round >= RaceSettings::kLeastRounds && taken.count() > settings.budget_s) break;
    std::vector<double> of_round;
    for (std::size_t k = 0; k < runners.size(); ++k) {
      of_round.push_back(seconds_a_run(runners[k], runs[k], settings.threads));
      if (cancelled(settings)) return times;
    }
    for (std::size_t k = 0; k < runners.size(); ++k) times[k].push_back(of_round[k]);
  }
  return times;
}

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  const double median =
      values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
  return {values.front(), median, values.back()};
}

Spread speed_ratio(const std::vector<double>& ours, const std::vector<double>& peer) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(ours.size(), peer.size()); ++i) {
    if (ours[i] > 0.0) ratios.push_back(peer[i] / ours[i]);
  }
  return spread_of(std::move(ratios));
}

}  // namespace encore::app::bench
