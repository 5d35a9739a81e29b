// Which instruction set is used, and what is said where a wish cannot be granted.
#include "accel/simd/isa.h"

#include "accel/wide/wide_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

namespace encore::accel {
namespace {

TEST(Isas, StartWithThePortableOneAndAscend) {
  const std::vector<Isa>& isas = available_isas();
  ASSERT_FALSE(isas.empty());
  EXPECT_EQ(isas.front(), Isa::portable);
  EXPECT_TRUE(std::is_sorted(isas.begin(), isas.end()));
}

TEST(Isas, HaveKernelsEach) {
  for (const Isa isa : available_isas()) {
    for (const auto kernel : wide_single_kernels(isa).intersect) EXPECT_NE(kernel, nullptr);
    for (const auto kernel : wide_single_kernels(isa).occluded) EXPECT_NE(kernel, nullptr);
    for (const auto kernel : wide_tile_kernels(isa).intersect) EXPECT_NE(kernel, nullptr);
    for (const auto kernel : wide_tile_kernels(isa).occluded) EXPECT_NE(kernel, nullptr);
  }
}

TEST(Isas, ThatThisMachineLacksAreRefused) {
  const auto none = static_cast<Isa>(17);
  EXPECT_THROW(wide_single_kernels(none), std::invalid_argument);
  EXPECT_THROW(wide_tile_kernels(none), std::invalid_argument);
}

/// The choice is made once a process, so each wish gets a process of its own.
void choose(const char* wish) {
  setenv("ENCORE_ISA", wish, 1);
  try {
    std::cerr << to_string(chosen_isa());
  } catch (const std::runtime_error& error) {
    std::cerr << error.what();
  }
  std::exit(0);
}

TEST(IsasDeathTest, AreChosenByTheEnvironment) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  for (const Isa isa : available_isas()) {
    const std::string name(to_string(isa));
    EXPECT_EXIT(choose(name.c_str()), testing::ExitedWithCode(0), "^" + name + "$");
  }
  const std::string best(to_string(available_isas().back()));
  EXPECT_EXIT(choose(""), testing::ExitedWithCode(0), "^" + best + "$");
  EXPECT_EXIT(choose("mmx"), testing::ExitedWithCode(0),
              "ENCORE_ISA is 'mmx'; this machine has portable");
}

}  // namespace
}  // namespace encore::accel
