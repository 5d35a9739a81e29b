#include "energy/units.h"

#include "energy/provenance.h"

#include <gtest/gtest.h>

#include <type_traits>

namespace encore::energy {
namespace {

template <class A, class B>
concept Addable = requires(A a, B b) {
  a + b;
};
static_assert(Addable<Seconds, Seconds>);
static_assert(!Addable<Seconds, Joules>, "unlike units must not add");
static_assert(!std::is_convertible_v<double, Joules>, "a bare number has no unit");

TEST(Units, PowerTimesTimeIsEnergy) {
  EXPECT_EQ(Watts(30.0) * Seconds(0.5), Joules(15.0));
  EXPECT_EQ(Joules(15.0) / Seconds(0.5), Watts(30.0));
  EXPECT_EQ(Seconds(3.0) / Seconds(2.0), 1.5);
  EXPECT_EQ(milliseconds(Seconds(0.25)), 250.0);
}

TEST(Provenance, EveryOriginReadsBackFromItsWord) {
  for (const Origin origin :
       {Origin::measured, Origin::modelled, Origin::simulated, Origin::unavailable}) {
    EXPECT_EQ(parse_origin(to_string(origin)), origin);
  }
  EXPECT_FALSE(parse_origin("guessed"));
}

}  // namespace
}  // namespace encore::energy
