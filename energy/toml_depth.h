#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace encore::energy {

/// Most parts of one dotted key. The parser limits the nesting of values but not of dotted keys,
/// and tables are freed recursively: together the two limits bound the stack.
inline constexpr std::size_t kMostKeyParts = 16;

/// The line of the first key (a.a.a...) with more parts than that; nothing if there is none. To be
/// asked of a TOML text before it is parsed; texts that are not TOML may give any answer.
std::optional<std::size_t> line_of_deep_key(std::string_view text);

}  // namespace encore::energy
