#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string_view>

namespace encore::fuzz {

/// Ends the program unless a promise was kept.
inline void require(bool kept) {
  if (!kept) std::abort();
}

inline void require_finite(double value) {
  require(std::isfinite(value));
}
template <class Quantity>
void require_finite(const Quantity& quantity) {
  require_finite(quantity.value);
}
template <class Quantity>
void require_finite(const std::optional<Quantity>& quantity) {
  if (quantity) require_finite(*quantity);
}

/// Runs a parser and the checks behind it; Error with a message is the one way in which it may
/// fail.
template <class Error, class Parse>
void check_parser(const Parse& parse) {
  try {
    parse();
  } catch (const Error& error) {
    require(!std::string_view(error.what()).empty());
  }
}

/// The bytes as text.
inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// An input whose first byte says which of several parsers gets the rest; '0' is the first of them,
/// so that seeds can be typed.
struct Choice {
  unsigned which = 0;
  std::string_view text;
};
inline std::optional<Choice> choice_of(const std::uint8_t* data, std::size_t size, unsigned count) {
  if (size == 0) return std::nullopt;
  return Choice{static_cast<std::uint8_t>(data[0] - '0') % count, text_of(data + 1, size - 1)};
}

}  // namespace encore::fuzz
