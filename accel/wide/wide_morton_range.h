#pragma once

#include "accel/wide/wide_tree.h"

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
  } else if (end - begin > TriangleBlock::kSize) {
    range.array = 1;
    range.level = differing_bits(keys[1], begin, end);
  }
  return range;
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
