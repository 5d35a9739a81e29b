#include "scene/model_number.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
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

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// A number and where it ended; `end` is null if it is not written plainly.
struct Plain {
  double value = 0.0;
  const char* end = nullptr;
};

// Digits times a power of ten: where both are exact in a double, one operation rounds correctly.
constexpr int kMostPower = 22;
constexpr double kPowersOfTen[kMostPower + 1] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                 1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// Gathers a run of digits; `at` ends behind it.
std::uint64_t gather_digits(const char*& at, const char* end, std::uint64_t number) {
  for (; at != end && is_digit(*at); ++at) {
    number = number * 10 + static_cast<std::uint64_t>(*at - '0');
  }
  return number;
}

// The exponent from its sign on; more than three digits are never exact.
bool read_exponent(const char*& at, const char* end, int& exponent) {
  const bool negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  const char* const first = at;
  const std::uint64_t size = gather_digits(at, end, 0);
  if (at == first || at - first > 3) return false;
  exponent += negative ? -static_cast<int>(size) : static_cast<int>(size);
  return true;
}

Plain read_plain(std::string_view text) {
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end && is_blank(*at)) ++at;
  const bool negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  const char* const first = at;
  std::uint64_t digits = gather_digits(at, end, 0);
  int exponent = 0;
  auto count = at - first;
  if (at != end && *at == '.') {
    const char* const point = ++at;
    digits = gather_digits(at, end, digits);
    exponent = -static_cast<int>(at - point);
    count += at - point;
  }
  // Up to 19 digits fit into 64 bits; what lies below 2^53 is exact.
  if (count == 0 || count > 19 || digits > (std::uint64_t{1} << 53U)) return {};
  if (at != end && (*at == 'e' || *at == 'E') && !read_exponent(++at, end, exponent)) return {};
  if (at != end && !is_blank(*at)) return {};
  if (exponent < -kMostPower || exponent > kMostPower) return {};
  auto value = static_cast<double>(digits);
  value = exponent < 0 ? value / kPowersOfTen[-exponent] : value * kPowersOfTen[exponent];
  return {negative ? -value : value, at};
}

// Rounding twice, to double and to float, differs from rounding once only where the first result
// lies halfway between two floats.
bool rounds_as_once(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const double size = value < 0.0 ? -value : value;
  const bool normal = size > 1.2e-38 && size < 3.4e38;
  return value == 0.0 || (normal && (bits & 0x1FFFFFFFU) != 0x10000000U);
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

bool take_plain_number(std::string_view& text, double& value) {
  const Plain plain = read_plain(text);
  if (plain.end == nullptr) return false;
  value = plain.value;
  text.remove_prefix(static_cast<std::size_t>(plain.end - text.data()));
  return true;
}

bool take_plain_number(std::string_view& text, float& value) {
  const Plain plain = read_plain(text);
  if (plain.end == nullptr || !rounds_as_once(plain.value)) return false;
  value = static_cast<float>(plain.value);
  text.remove_prefix(static_cast<std::size_t>(plain.end - text.data()));
  return true;
}

}  // namespace encore::scene
