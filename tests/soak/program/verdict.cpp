#include "tests/soak/program/soak.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace encore::test {

namespace {

std::vector<double> values_of(std::span<const MemoryUse> memory, std::uint64_t MemoryUse::*which) {
  std::vector<double> values;
  values.reserve(memory.size());
  for (const MemoryUse& use : memory) values.push_back(static_cast<double>(use.*which));
  return values;
}

void judge_memory(std::span<const MemoryUse> memory, std::vector<std::string>& problems) {
  const std::vector<double> in_use = values_of(memory, &MemoryUse::in_use);
  const Drift used = drift_of(in_use);
  if (std::fabs(used.whole) > kMostInUseDrift) {
    problems.push_back(
        fmt::format("bytes in use drift by {:+.2f} % over {} rounds, {:+.0f} bytes a round; at "
                    "most {:.0f} % is none",
                    used.whole * 100.0, memory.size(), used.per_round, kMostInUseDrift * 100.0));
  }
  // The least of the last three: what a driver's thread has not given back yet is no leak.
  const auto tail = std::min<std::ptrdiff_t>(3, std::ssize(in_use));
  const double last = *std::min_element(in_use.end() - tail, in_use.end());
  const double change = last / in_use.front() - 1.0;
  if (std::fabs(change) > kMostInUseDrift) {
    problems.push_back(
        fmt::format("{:.0f} bytes are in use after the last rounds, {:.0f} were after the first "
                    "that counts: {:+.2f} %",
                    last, in_use.front(), change * 100.0));
  }
  if (memory.size() < kRoundsForResident) return;
  const Drift resident = drift_of(values_of(memory, &MemoryUse::resident));
  if (resident.whole > kMostResidentDrift) {
    problems.push_back(fmt::format(
        "resident bytes drift by {:+.2f} % over {} rounds, {:+.0f} bytes a round; at "
        "most {:.0f} % is none",
        resident.whole * 100.0, memory.size(), resident.per_round, kMostResidentDrift * 100.0));
  }
}

}  // namespace

std::vector<std::string> verdict(const SoakTally& tally, const SoakPlan& plan) {
  std::vector<std::string> problems;
  const SpotCheckTally& checks = tally.checks;
  if (checks.wrong > 0) {
    problems.push_back(fmt::format("{} of {} checked rays were answered wrongly; the first: {}",
                                   checks.wrong, checks.rays, checks.first_wrong));
  }
  if (static_cast<double>(checks.loose_differing) >
      kMostLooseDifferences * static_cast<double>(checks.loose)) {
    problems.push_back(
        fmt::format("{} of {} rays in mode moller-trumbore found another triangle than brute force",
                    checks.loose_differing, checks.loose));
  }
  if (tally.wrong_pictures > 0) {
    problems.push_back(fmt::format("{} of {} pictures are wrong; the first: {}",
                                   tally.wrong_pictures, tally.pictures,
                                   tally.first_wrong_picture));
  }
  if (tally.memory.size() >= plan.warm_up() + 2) {
    judge_memory(std::span(tally.memory).subspan(plan.warm_up()), problems);
  }
  return problems;
}

}  // namespace encore::test
