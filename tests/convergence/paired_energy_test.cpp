#include "energy/convergence/paired_energy.h"

#include <gtest/gtest.h>

#include <vector>

namespace encore::energy {
namespace {

TracePoint at(double time, double joules) {
  TracePoint point;
  point.time = Seconds(time);
  point.energy = Joules(joules);
  return point;
}

class PairedEnergyTest : public testing::Test {
 protected:
  std::vector<EnergyStep> steps_;
  PairedEnergy paired_{Seconds(10), [this](const EnergyStep& step) { steps_.push_back(step); }};
};

TEST_F(PairedEnergyTest, OperationsAreCountedLinearlyBetweenUpdates) {
  paired_.add_energy(at(9, 50));  // before the start
  paired_.add_energy(at(11, 100));
  paired_.add_energy(at(13, 160));
  paired_.add_row(Seconds(10), Seconds(12), 4.0);
  EXPECT_TRUE(steps_.empty());
  EXPECT_EQ(paired_.waiting(), 1U);
  paired_.add_row(Seconds(12), Seconds(14), 10.0);
  ASSERT_EQ(steps_.size(), 1U);
  EXPECT_EQ(steps_[0].start, Seconds(11));
  EXPECT_EQ(steps_[0].end, Seconds(13));
  EXPECT_DOUBLE_EQ(steps_[0].energy.value, 60.0);
  EXPECT_DOUBLE_EQ(steps_[0].operations, 2.0 + 5.0);
}

TEST_F(PairedEnergyTest, NothingIsDoneBetweenRows) {
  paired_.add_energy(at(10, 0));
  paired_.add_energy(at(13, 9));
  paired_.add_energy(at(15, 15));
  paired_.add_row(Seconds(10), Seconds(12), 4.0);
  paired_.add_row(Seconds(14), Seconds(16), 4.0);
  ASSERT_EQ(steps_.size(), 2U);
  EXPECT_DOUBLE_EQ(steps_[0].operations, 4.0);
  EXPECT_DOUBLE_EQ(steps_[1].operations, 2.0);
}

TEST_F(PairedEnergyTest, RepeatedValuesAreNoUpdates) {
  paired_.add_energy(at(10, 0));
  TracePoint repeated = at(11, 20);
  repeated.changed = false;
  paired_.add_energy(repeated);
  paired_.add_energy(at(12, 40));
  paired_.add_row(Seconds(10), Seconds(12), 1.0);
  ASSERT_EQ(steps_.size(), 1U);
  EXPECT_DOUBLE_EQ(steps_[0].energy.value, 40.0);
}

TEST_F(PairedEnergyTest, NoStepCrossesAGap) {
  paired_.add_energy(at(10, 0));
  paired_.add_energy(at(11, 20));
  TracePoint restarted = at(13, 25);
  restarted.starts_stretch = true;
  paired_.add_energy(restarted);
  paired_.add_energy(at(14, 45));
  paired_.add_row(Seconds(10), Seconds(14), 8.0);
  ASSERT_EQ(steps_.size(), 2U);
  EXPECT_EQ(steps_[1].start, Seconds(13));
  EXPECT_DOUBLE_EQ(steps_[1].energy.value, 20.0);
  EXPECT_DOUBLE_EQ(steps_[1].operations, 2.0);
}

TEST_F(PairedEnergyTest, OneEndlessOperationKeepsMemoryAndEnergyBounded) {
  for (int i = 0; i <= 100000; ++i) paired_.add_energy(at(10 + i * 0.01, i));
  EXPECT_LE(paired_.waiting(), 4097U);
  paired_.add_row(Seconds(10), Seconds(1010), 1.0);
  double joules = 0.0;
  double operations = 0.0;
  for (const EnergyStep& step : steps_) {
    joules += step.energy.value;
    operations += step.operations;
  }
  EXPECT_DOUBLE_EQ(joules, 100000.0);
  EXPECT_NEAR(operations, 1.0, 1e-9);
}

}  // namespace
}  // namespace encore::energy
