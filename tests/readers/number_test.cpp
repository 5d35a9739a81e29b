// Numbers of model files: the quick way gives what the careful one gives, bit for bit.
#include "scene/model_number.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <type_traits>

namespace encore::scene {
namespace {

// Whether the quick way took the token; if so, both must agree on the value.
template <typename Number>
bool taken(const std::string& token) {
  const std::string text = " \t" + token + "\n7";
  std::string_view rest = text;
  Number quick = 0;
  if (!take_plain_number(rest, quick)) {
    EXPECT_EQ(rest, text);
    return false;
  }
  EXPECT_EQ(rest, "\n7");
  Number careful = 0;
  EXPECT_TRUE(parse_number(token, careful)) << token;
  using Bits = std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>;
  EXPECT_EQ(std::bit_cast<Bits>(quick), std::bit_cast<Bits>(careful)) << token;
  return true;
}

TEST(ModelNumber, PlainNumbersAreTakenAtOnce) {
  for (const char* token : {"0", "-0.0", "+1", "5.", ".5", "-0.037829999", "1e-05", "-2.5E+3",
                            "16777217", "0.1", "123456.789"}) {
    EXPECT_TRUE(taken<double>(token)) << token;
  }
  EXPECT_TRUE(taken<float>("-0.037829999"));
}

TEST(ModelNumber, OthersAreLeftToTheCarefulWay) {
  for (const char* token :
       {"-", ".", "e5", "1e", "1e+", "1e1000", "+-1", "--1", "nan", "inf", "1.#IND", "0x10", "1,5",
        "1#", "1e40", "12345678901234567890", "0.00000000000000000001"}) {
    EXPECT_FALSE(taken<float>(token)) << token;
    EXPECT_FALSE(taken<double>(token)) << token;
  }
}

TEST(ModelNumber, HalfwayBetweenTwoFloatsIsNotRoundedTwice) {
  // Just above the middle of two floats, but below what a double can tell from it.
  EXPECT_FALSE(taken<float>("1.000000059604644775390625"));
  EXPECT_FALSE(taken<float>("16777217"));
  EXPECT_FALSE(taken<float>("1e-39"));
}

TEST(ModelNumber, BothWaysAgreeOnRandomNumbers) {
  std::mt19937_64 random(7);
  int quick = 0;
  for (int i = 0; i < 200000; ++i) {
    std::string token = random() % 2 == 0 ? "-" : "";
    const std::size_t digits = 1 + random() % 17;
    const std::size_t point = random() % 20;
    for (std::size_t k = 0; k < digits; ++k) {
      if (k == point) token += '.';
      token += static_cast<char>('0' + random() % 10);
    }
    if (random() % 3 == 0) token += "e" + std::to_string(static_cast<int>(random() % 60) - 30);
    quick += taken<float>(token) ? 1 : 0;
    taken<double>(token);
  }
  EXPECT_GT(quick, 100000);
}

}  // namespace
}  // namespace encore::scene
