#include "energy/convergence/blocks.h"

#include <gtest/gtest.h>

namespace encore::energy {
namespace {

TEST(Blocks, SumsAndTimesSurviveMerging) {
  BlockSeries series(8);
  double amount = 0.0;
  for (int i = 0; i < 1003; ++i) {
    series.add(Seconds(i), Seconds(i + 1), i, 2.0);
    amount += i;
    ASSERT_LT(series.blocks().size(), 8U);
  }
  double sum = 0.0;
  double weight = 0.0;
  for (const Block& block : series.all()) {
    sum += block.amount;
    weight += block.weight;
  }
  EXPECT_DOUBLE_EQ(sum, amount);
  EXPECT_DOUBLE_EQ(weight, 2006.0);
  EXPECT_EQ(series.additions(), 1003U);
  EXPECT_DOUBLE_EQ(series.length().value, 1003.0);
  // Blocks of 128 and 256 ..., each in the middle of what it covers.
  const double length = static_cast<double>(series.additions_per_block());
  for (std::size_t i = 0; i < series.blocks().size(); ++i) {
    EXPECT_DOUBLE_EQ(series.blocks()[i].length.value, length);
    EXPECT_DOUBLE_EQ(series.blocks()[i].middle.value, length * (static_cast<double>(i) + 0.5));
  }
}

TEST(Blocks, WhatHasNoWeightJoinsWhatFollows) {
  BlockSeries series;
  series.add(Seconds(0), Seconds(1), 5.0, 0.0);
  EXPECT_TRUE(series.all().empty());
  series.add(Seconds(1), Seconds(2), 3.0, 2.0);
  ASSERT_EQ(series.all().size(), 1U);
  EXPECT_DOUBLE_EQ(series.all()[0].ratio(), 4.0);
  EXPECT_DOUBLE_EQ(series.all()[0].length.value, 2.0);
}

}  // namespace
}  // namespace encore::energy
