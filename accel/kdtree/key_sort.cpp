#include "accel/kdtree/key_sort.h"

#include <algorithm>
#include <array>
#include <utility>

namespace encore::accel {

namespace {

constexpr std::size_t kByDigits = 128;  // shorter lists are compared
constexpr int kDigits = 4;
constexpr std::uint32_t kDigitValues = 256;

}  // namespace

void sort_keys(std::uint32_t* keys, std::uint32_t* spare, std::size_t count, BuildMeter* meter) {
  if (count < kByDigits) {
    std::sort(keys, keys + count);
    return;
  }

  BuildMeter unwatched(nullptr);
  if (meter == nullptr) meter = &unwatched;

  // Count all digits in one reading.
  std::array<std::array<std::uint32_t, kDigitValues>, kDigits> counts{};
  for (std::size_t i = 0, end = 0; i < count;) {
    for (end = meter->part_end(i, count); i < end; ++i) {
      for (int digit = 0; digit < kDigits; ++digit) {
        ++counts[digit][keys[i] >> (8 * digit) & 0xFFU];
      }
    }
  }

  std::uint32_t* from = keys;
  std::uint32_t* to = spare;
  for (int digit = 0; digit < kDigits; ++digit) {
    std::array<std::uint32_t, kDigitValues>& next = counts[digit];
    if (next[from[0] >> (8 * digit) & 0xFFU] == count) continue;
    std::uint32_t sum = 0;
    for (std::uint32_t& value : next) sum += std::exchange(value, sum);
    for (std::size_t i = 0, end = 0; i < count;) {
      for (end = meter->part_end(i, count); i < end; ++i) {
        to[next[from[i] >> (8 * digit) & 0xFFU]++] = from[i];
      }
    }
    std::swap(from, to);
  }
  if (from != keys) std::copy(from, from + count, keys);
}

}  // namespace encore::accel
