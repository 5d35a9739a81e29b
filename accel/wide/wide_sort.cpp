#include "accel/wide/wide_codes.h"

#include <cstring>
#include <utility>

namespace encore::accel {

namespace {

constexpr std::uint32_t kDigitBits = 8;
constexpr std::uint32_t kDigits = 1U << kDigitBits;
constexpr std::uint32_t kPasses = 4;

/// Parts of a pass: as many as there are threads, if there is enough to do. The sort is stable, so
/// its result does not depend on them.
std::size_t part_size(const WideBuildRun& run, std::size_t count) {
  const auto threads = static_cast<std::size_t>(run.workers.threads());
  const std::size_t parts = std::min(threads, std::size_t{64});
  return std::max(kWidePart, (count + parts - 1) / parts);
}

}  // namespace

void sort_wide_keys(WideBuildRun& run) {
  const std::size_t count = run.memory.keys[0].size();
  const std::size_t part = part_size(run, count);
  const std::size_t parts = (count + part - 1) / part;
  Array<std::uint32_t>& counts = run.memory.digits;
  counts.reset(parts * kDigits, run.mode, run.allocations);
  for (std::uint32_t pass = 0; pass < kPasses; ++pass) {
    run.meter.check();
    const std::uint32_t shift = 32 + pass * kDigitBits;
    const std::uint64_t* const from = run.memory.keys[0].data();
    std::uint64_t* const to = run.memory.keys[1].data();
    const auto digit = [shift](std::uint64_t key) { return key >> shift & (kDigits - 1); };
    run.workers.for_parts(count, part, [&](std::size_t begin, std::size_t end) {
      std::uint32_t* const mine = counts.data() + begin / part * kDigits;
      std::memset(mine, 0, kDigits * sizeof(std::uint32_t));
      for (std::size_t i = begin; i < end; ++i) ++mine[digit(from[i])];
    });
    std::uint32_t next = 0;
    bool all_alike = false;
    for (std::uint32_t value = 0; value < kDigits; ++value) {
      const std::uint32_t before = next;
      for (std::size_t k = 0; k < parts; ++k) {
        next += std::exchange(counts[k * kDigits + value], next);
      }
      all_alike |= next - before == count;
    }
    if (all_alike) continue;
    run.workers.for_parts(count, part, [&](std::size_t begin, std::size_t end) {
      std::uint32_t* const mine = counts.data() + begin / part * kDigits;
      for (std::size_t i = begin; i < end; ++i) to[mine[digit(from[i])]++] = from[i];
    });
    std::swap(run.memory.keys[0], run.memory.keys[1]);
  }
}

}  // namespace encore::accel
