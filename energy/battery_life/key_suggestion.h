#pragma once

#include <span>
#include <string>
#include <string_view>

namespace encore::energy {

/// "; did you mean 'x'?" for the candidate at the smallest edit distance, or nothing if more than
/// about a third of the letters differ: to be put behind a message.
std::string nearest_key(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace encore::energy
