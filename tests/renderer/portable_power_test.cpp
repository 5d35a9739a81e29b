#include "renderer/portable_power.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using encore::renderer::portable_power;

TEST(PortablePower, AgreesWithTheLibraryOverTheWholeRange) {
  for (const double exponent : {0.25, 1.0 / 2.4, 1.0, 2.0, 2.4, 10.0, 32.5, 128.0, -1.0, -3.5}) {
    for (double base = 1e-6; base < 1e6; base *= 1.37) {
      const double expected = std::pow(base, exponent);
      if (!(expected > 1e-290 && expected < 1e290)) continue;
      EXPECT_NEAR(portable_power(base, exponent) / expected, 1.0, 1e-12)
          << base << " ^ " << exponent;
    }
  }
}

TEST(PortablePower, ExactWhereItHasToBe) {
  EXPECT_EQ(portable_power(1.0, 12345.0), 1.0);
  EXPECT_EQ(portable_power(0.0, 32.0), 0.0);
  EXPECT_EQ(portable_power(0.3, 0.0), 1.0);
  EXPECT_EQ(portable_power(0.0, 0.0), 1.0);
  EXPECT_EQ(portable_power(2.0, 10.0), 1024.0);
  EXPECT_EQ(portable_power(2.0, 1023.0), 0x1p1023);
  EXPECT_EQ(portable_power(2.0, -1022.0), 0x1p-1022);
}

TEST(PortablePower, EndsOfTheRange) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(portable_power(2.0, 1024.0), inf);
  EXPECT_EQ(portable_power(0.5, 1e9), 0.0);
  EXPECT_EQ(portable_power(inf, 2.0), inf);
  EXPECT_EQ(portable_power(inf, -2.0), 0.0);
  EXPECT_EQ(portable_power(0.0, -1.0), inf);
  EXPECT_TRUE(std::isnan(portable_power(-1.0, 2.0)));
  EXPECT_TRUE(std::isnan(portable_power(std::nan(""), 2.0)));
  const double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_NEAR(portable_power(tiny, 0.5) / std::sqrt(tiny), 1.0, 1e-12);
}

}  // namespace
