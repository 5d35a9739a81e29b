#include "scene/portable_math.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace encore::scene {
namespace {

TEST(PortableMath, AgreesWithTheLibraryToTenToTheMinusFourteen) {
  for (int i = -200000; i <= 200000; ++i) {
    const double x = i * 0.00071 + i * (i % 7) * 0.7;
    ASSERT_NEAR(portable_sin(x), static_cast<double>(std::sin(static_cast<long double>(x))), 1e-14);
    ASSERT_NEAR(portable_cos(x), static_cast<double>(std::cos(static_cast<long double>(x))), 1e-14);
    const double y = i / 200000.0;
    ASSERT_NEAR(portable_acos(y), std::acos(y), 1e-14);
  }
}

TEST(PortableMath, IsTheSameBitForBitEverywhere) {
  // A checksum over many arguments, taken once; any machine or compiler that differs fails here.
  std::uint64_t sum = 0;
  for (int i = -5000; i <= 5000; ++i) {
    const double x = i * 0.37;
    for (const double value : {portable_sin(x), portable_cos(x), portable_acos(i / 5000.0),
                               portable_sin_degrees(x), portable_cos_degrees(x)}) {
      sum = (sum ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211ULL;
    }
  }
  EXPECT_EQ(sum, 6631033956127018722ULL);
}

TEST(PortableMath, RightAnglesAreExact) {
  for (int turn = -8; turn <= 8; ++turn) {
    const double degrees = 90.0 * turn;
    const int quadrant = ((turn % 4) + 4) % 4;
    const double sines[] = {0.0, 1.0, 0.0, -1.0};
    EXPECT_EQ(portable_sin_degrees(degrees), sines[quadrant]);
    EXPECT_EQ(portable_cos_degrees(degrees), sines[(quadrant + 1) % 4]);
  }
  EXPECT_EQ(portable_sin_degrees(90.0 * 4e15), 0.0);
  EXPECT_DOUBLE_EQ(portable_sin_degrees(30.0), 0.5);
}

TEST(PortableMath, EndsAndNonsenseAreDefined) {
  EXPECT_EQ(portable_acos(2.0), 0.0);
  EXPECT_EQ(portable_acos(-2.0), kPi);
  EXPECT_TRUE(std::isnan(portable_acos(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(std::isnan(portable_sin(std::numeric_limits<double>::infinity())));
  EXPECT_TRUE(std::isnan(portable_cos(-std::numeric_limits<double>::infinity())));
  EXPECT_LE(std::fabs(portable_sin(1e300)), 1.0);
}

}  // namespace
}  // namespace encore::scene
