#pragma once

#include "accel/wide/wide_build_kernels.h"

#include <cstdint>

namespace encore::accel {

/// Keys [begin, end), sorted. Where the codes are all the same, more of them than a leaf holds have
/// finer ones in the second array (refine_wide_keys).
struct WideKeyRange {
  std::uint32_t begin, end;
  std::uint32_t array;
  /// How many bits of the code differ, from the last on; 32 more in the first array: the larger,
  /// the larger the part of space.
  std::uint32_t level;

  /// Whether anything is gained by dividing it.
  [[gnu::always_inline]] [[nodiscard]] bool divisible() const {
    return end - begin > (level > 0 ? TriangleBlock::kSize : WideTopology::kLargestLeaf);
  }
};

// Always inlined, as files of every instruction set use them.

[[gnu::always_inline]] inline std::uint32_t differing_bits(const std::uint64_t* keys,
                                                           std::uint32_t begin, std::uint32_t end) {
  const std::uint64_t differ = (keys[begin] ^ keys[end - 1]) >> 32;
  return differ == 0 ? 0 : 64 - static_cast<std::uint32_t>(__builtin_clzll(differ));
}

[[gnu::always_inline]] inline WideKeyRange key_range(const std::uint64_t* const* keys,
                                                     std::uint32_t array, std::uint32_t begin,
                                                     std::uint32_t end) {
  WideKeyRange range{begin, end, array, differing_bits(keys[array], begin, end)};
  if (array == 1) return range;
  if (range.level > 0) {
    range.level += 32;
  } else if (end - begin > WideTopology::kLargestLeaf) {
    range.array = 1;
    range.level = differing_bits(keys[1], begin, end);
  }
  return range;
}

/// Ranges of up to so many keys are divided with an eye to full blocks. Where more are, trees get
/// smaller still, but rays pay for it.
inline constexpr std::uint32_t kFewKeys = 12;

/// Of the places that divide a few keys so that both sides need no more blocks than all of them
/// together, the one where the most significant bit differs. Keys are all different.
[[gnu::always_inline]] inline std::uint32_t divide_few_keys(const std::uint64_t* keys,
                                                            std::uint32_t begin,
                                                            std::uint32_t end) {
  constexpr std::uint32_t kBlock = TriangleBlock::kSize;
  const std::uint32_t spare = (begin - end) % kBlock;
  std::uint32_t best = begin;
  std::uint64_t most = 0;
  for (std::uint32_t i = begin + 1; i < end; ++i) {
    const std::uint64_t differ = keys[i - 1] ^ keys[i];
    const bool better = differ > most && (begin - i) % kBlock <= spare;
    most = better ? differ : most;
    best = better ? i : best;
  }
  return best;
}

/// The first key of the upper half of the space that the range covers; where nothing differs, the
/// first of the second half by number, whole blocks before it.
[[gnu::always_inline]] inline std::uint32_t divide_keys(const std::uint64_t* const* keys,
                                                        const WideKeyRange& range) {
  constexpr std::uint32_t kBlock = TriangleBlock::kSize;
  if (range.level == 0) {
    return range.begin + (range.end - range.begin + 2 * kBlock - 1) / (2 * kBlock) * kBlock;
  }
  const std::uint64_t* const all = keys[range.array];
  if (range.end - range.begin <= kFewKeys) return divide_few_keys(all, range.begin, range.end);
  const std::uint64_t bit = std::uint64_t{1}
                            << (range.array == 0 ? range.level - 1 : range.level + 31);
  std::uint32_t low = range.begin, high = range.end - 1;  // not set, set
  while (high - low > 1) {
    const std::uint32_t middle = low + (high - low) / 2;
    const bool set = (all[middle] & bit) != 0;
    high = set ? middle : high;
    low = set ? low : middle;
  }
  return high;
}

}  // namespace encore::accel
