#pragma once

#include <span>
#include <string>
#include <string_view>

namespace encore::scene {

/// The candidate that `word` is most likely a slip of, for "did you mean" in messages: the one at
/// the smallest edit distance (insertions, deletions, replacements and swaps of neighbours; upper
/// and lower case are the same, and so are `-` and `_`), as long as no more than about a third of
/// the letters differ. Of equally near ones the first. Empty when nothing is near.
std::string_view closest_name(std::string_view word, std::span<const std::string_view> candidates);

/// "; did you mean 'x'?" for the closest name, or nothing: to be put behind a message.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace encore::scene
