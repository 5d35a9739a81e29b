#include "energy/attribution/excitation.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace encore::energy {

namespace {

constexpr double kMostStretch = 1.6;
constexpr std::size_t kLeastRounds = 2;

/// Uniform in [0, 1), equal with every standard library (its distributions are not).
double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11U) * 0x1p-53;
}

/// One block a phase and one sleep, in random order.
std::vector<MixBlock> make_round(const std::vector<Phase>& phases,
                                 const PerPhase<Seconds>& mean_times, Seconds least,
                                 std::mt19937_64& random) {
  const auto length = [&] { return least * (1.0 + (kMostStretch - 1.0) * uniform(random)); };
  std::vector<MixBlock> round(phases.size() + 1);
  for (std::size_t i = 0; i < phases.size(); ++i) {
    round[i].repeats[phases[i]] =
        static_cast<std::size_t>(std::max(1.0, std::ceil(length() / mean_times[phases[i]])));
  }
  round.back().sleep = length();
  for (std::size_t i = round.size() - 1; i > 0; --i) {
    const auto other = static_cast<std::size_t>(uniform(random) * static_cast<double>(i + 1));
    std::swap(round[i], round[other]);
  }
  return round;
}

}  // namespace

Seconds MixBlock::length(const PerPhase<Seconds>& mean_times) const {
  Seconds sum = sleep;
  for (const Phase phase : kPhases) {
    sum += mean_times[phase] * static_cast<double>(repeats[phase]);
  }
  return sum;
}

std::vector<MixBlock> make_mix_blocks(std::span<const Phase> phases,
                                      const PerPhase<Seconds>& mean_times, Seconds update_period,
                                      Seconds budget, std::uint64_t seed) {
  std::vector<Phase> used;
  Seconds longest;
  for (const Phase phase : phases) {
    const bool is_new = std::find(used.begin(), used.end(), phase) == used.end();
    if (!is_new || !(mean_times[phase].value > 0.0)) continue;
    used.push_back(phase);
    longest = std::max(longest, mean_times[phase]);
  }
  const Seconds least = std::max(update_period * kLeastBlockPeriods, longest * 0.5);
  if (used.empty() || !(least.value > 0.0)) return {};

  std::mt19937_64 random(seed);
  std::vector<MixBlock> blocks;
  Seconds spent;
  std::size_t rounds = 0;
  while (true) {
    const std::vector<MixBlock> round = make_round(used, mean_times, least, random);
    for (const MixBlock& block : round) spent += block.length(mean_times);
    if (spent > budget) break;
    blocks.insert(blocks.end(), round.begin(), round.end());
    ++rounds;
  }
  if (rounds < kLeastRounds) blocks.clear();
  return blocks;
}

std::vector<MixBlock> make_mix_blocks(std::span<const Phase> phases,
                                      const PerPhase<Seconds>& mean_times, const SourceInfo& source,
                                      Seconds budget, std::uint64_t seed) {
  return make_mix_blocks(phases, mean_times, std::max(source.update_period, source.poll_period),
                         budget, seed);
}

}  // namespace encore::energy
