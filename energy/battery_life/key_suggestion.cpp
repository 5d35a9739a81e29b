#include "energy/battery_life/key_suggestion.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace encore::energy {

namespace {

/// Insertions, deletions and replacements from one word to the other.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearest_key(std::string_view word, std::span<const std::string_view> candidates) {
  constexpr std::size_t kLongestWord = 63;  // a longer one is no slip of a key
  if (word.size() > kLongestWord) return {};
  std::string_view best;
  std::size_t least = kLongestWord;
  for (const std::string_view candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    const std::size_t allowed = (std::max(word.size(), candidate.size()) + 1) / 3;
    if (distance > allowed || distance >= least) continue;
    best = candidate;
    least = distance;
  }
  return best.empty() ? std::string() : "; did you mean '" + std::string(best) + "'?";
}

}  // namespace encore::energy
