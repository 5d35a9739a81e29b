#include "energy/toml_depth.h"

#include <algorithm>
#include <string>

namespace encore::energy {

namespace {

/// The index behind a string that begins at `begin`; behind its line where it has no end.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const std::string triple(3, quote);
  const bool many_lines = text.substr(begin, 3) == triple;
  for (std::size_t i = begin + (many_lines ? 3 : 1); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (!many_lines && (text[i] == quote || text[i] == '\n')) {
      return i + 1;
    } else if (many_lines && text.substr(i, 3) == triple) {
      // One or two quotes more belong to the string.
      return std::min(text.find_first_not_of(quote, i), text.size());
    }
  }
  return text.size();
}

}  // namespace

std::optional<std::size_t> line_of_deep_key(std::string_view text) {
  constexpr std::string_view kKeyEnds = "\n=,[]{}";
  std::size_t dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = end_of_string(text, i);
      continue;
    }
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (c == '.' && ++dots == kMostKeyParts) {
      const auto place = text.begin() + static_cast<std::ptrdiff_t>(i);
      return 1 + static_cast<std::size_t>(std::count(text.begin(), place, '\n'));
    }
    if (kKeyEnds.find(c) != std::string_view::npos) dots = 0;
    ++i;
  }
  return std::nullopt;
}

}  // namespace encore::energy
