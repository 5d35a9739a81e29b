#include "scene/model_number.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>

namespace encore::scene {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f' || c == '\0';
}

// The limit that a number outside the range of its type stands for. Without an exponent only the
// digits before the point can have made it too large.
template <typename Number>
Number out_of_range_value(std::string_view token) {
  const bool negative = token.front() == '-';
  const std::size_t exponent = token.find_first_of("eE");
  bool tiny = false;
  if (exponent != std::string_view::npos) {
    tiny = exponent + 1 < token.size() && token[exponent + 1] == '-';
  } else {
    tiny = std::min(token.find('.'), token.size()) < 30;
  }
  const Number size = tiny ? Number(0) : std::numeric_limits<Number>::infinity();
  return negative ? -size : size;
}

template <typename Number>
bool parse(std::string_view token, Number& value) {
  if (!token.empty() && token.front() == '+') token.remove_prefix(1);
  if (token.empty()) return false;
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, value);
  if (error == std::errc::invalid_argument) return false;
  if (stop == end) {
    if (error == std::errc::result_out_of_range) value = out_of_range_value<Number>(token);
    return true;
  }

  // The C runtime of Windows used to print "1.#INF00" for infinities, "-1.#IND00" for no numbers.
  const std::string_view rest(stop, static_cast<std::size_t>(end - stop));
  if (!rest.starts_with('#')) return false;
  const Number infinity = std::numeric_limits<Number>::infinity();
  const bool infinite = rest.starts_with("#INF");
  value = infinite ? (token.front() == '-' ? -infinity : infinity)
                   : std::numeric_limits<Number>::quiet_NaN();
  return true;
}

}  // namespace

std::string_view take_token(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && is_blank(text[begin])) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !is_blank(text[end])) ++end;
  const std::string_view token = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return token;
}

bool parse_number(std::string_view token, float& value) {
  return parse(token, value);
}

bool parse_number(std::string_view token, double& value) {
  return parse(token, value);
}

}  // namespace encore::scene
