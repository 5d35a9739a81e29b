#include "energy/sources/gauge_integral.h"

#include <gtest/gtest.h>

#include <limits>

namespace encore::energy {
namespace {

TEST(GaugeIntegral, JoinsReadingsByTrapezoids) {
  GaugeIntegral gauge;
  EXPECT_EQ(gauge.add(Seconds(10), Watts(4)).reading.energy, Joules(0)) << "the first one primes";
  EXPECT_EQ(gauge.add(Seconds(12), Watts(6)).reading.energy, Joules(10));
  const ReadResult third = gauge.add(Seconds(13), Watts(0));
  EXPECT_EQ(third.state, ReadState::ok);
  EXPECT_EQ(third.reading.energy, Joules(13));
  EXPECT_EQ(third.reading.power, Watts(0));
  EXPECT_EQ(gauge.energy(), Joules(13));
}

TEST(GaugeIntegral, SaysWhetherTheValueChanged) {
  GaugeIntegral gauge;
  EXPECT_TRUE(gauge.add(Seconds(0), Watts(5)).reading.changed);
  EXPECT_FALSE(gauge.add(Seconds(1), Watts(5)).reading.changed);
  EXPECT_TRUE(gauge.add(Seconds(2), Watts(6)).reading.changed);
  EXPECT_TRUE(gauge.add(Seconds(3), Watts(6), true).reading.changed) << "it was told to be new";
}

TEST(GaugeIntegral, AGapIsNeverFilledIn) {
  GaugeIntegral gauge;
  gauge.add(Seconds(0), Watts(10));
  gauge.add(Seconds(1), Watts(10));
  const ReadResult gap = gauge.failed("no data");
  EXPECT_EQ(gap.state, ReadState::failed);
  EXPECT_EQ(gap.message, "no data");
  const ReadResult back = gauge.add(Seconds(5), Watts(10));
  EXPECT_EQ(back.state, ReadState::restarted);
  EXPECT_FALSE(back.message.empty());
  EXPECT_EQ(back.reading.energy, Joules(10)) << "the four seconds between are not counted";
  const ReadResult next = gauge.add(Seconds(6), Watts(10));
  EXPECT_EQ(next.state, ReadState::ok);
  EXPECT_EQ(next.reading.energy, Joules(20));
}

TEST(GaugeIntegral, FailuresBeforeTheFirstReadingLeaveNoGap) {
  GaugeIntegral gauge;
  gauge.failed("not yet");
  EXPECT_EQ(gauge.add(Seconds(0), Watts(10)).state, ReadState::ok);
}

TEST(GaugeIntegral, ReadingsTooFarApartAreNotJoined) {
  GaugeIntegral gauge(Seconds(5));
  gauge.add(Seconds(0), Watts(10));
  EXPECT_EQ(gauge.add(Seconds(5), Watts(10)).state, ReadState::ok) << "just near enough";
  const ReadResult far = gauge.add(Seconds(11), Watts(10));
  EXPECT_EQ(far.state, ReadState::restarted);
  EXPECT_EQ(far.reading.energy, Joules(50));
}

TEST(GaugeIntegral, NonsenseIsAGapAndTimeThatStandsStillAddsNothing) {
  GaugeIntegral gauge;
  gauge.add(Seconds(0), Watts(10));
  EXPECT_EQ(gauge.add(Seconds(1), Watts(-3)).state, ReadState::failed);
  EXPECT_EQ(gauge.add(Seconds(2), Watts(std::numeric_limits<double>::quiet_NaN())).state,
            ReadState::failed);
  EXPECT_EQ(gauge.add(Seconds(3), Watts(10)).state, ReadState::restarted);
  EXPECT_EQ(gauge.add(Seconds(3), Watts(50)).reading.energy, Joules(0));
  EXPECT_EQ(gauge.add(Seconds(2), Watts(50)).reading.energy, Joules(0)) << "nor does a step back";
}

TEST(GaugeIntegral, TheFirstReadingAfterALossStartsAnew) {
  GaugeIntegral gauge;
  gauge.add(Seconds(0), Watts(10));
  EXPECT_EQ(gauge.lost("gone").state, ReadState::lost);
  EXPECT_EQ(gauge.add(Seconds(1), Watts(10)).state, ReadState::restarted);
}

}  // namespace
}  // namespace encore::energy
