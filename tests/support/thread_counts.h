#pragma once

#include "accel/acceleration_structure.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace encore::accel::test {

/// Bytes of all that tracing needs, one after the other.
inline std::vector<std::byte> content_of(const AccelerationStructure& structure) {
  std::vector<std::byte> bytes;
  for (const GpuBuffer& buffer : structure.gpu_buffers()) {
    bytes.insert(bytes.end(), buffer.bytes.begin(), buffer.bytes.end());
  }
  return bytes;
}

/// Builds with one, two and three threads: the same structure, and in a pool no memory the second
/// time. make(MemoryMode) gives a structure.
template <class Make>
void expect_same_for_any_threads(const Make& make, const std::vector<Triangle>& triangles) {
  auto alone = make(MemoryMode::pool);
  alone.set_build_threads(1);
  alone.build(triangles);
  const std::vector<std::byte> expected = content_of(alone);
  const BuildStats stats = alone.stats();
  for (const int threads : {2, 3}) {
    for (const MemoryMode memory : {MemoryMode::pool, MemoryMode::fresh}) {
      auto together = make(memory);
      together.set_build_threads(threads);
      for (int round = 0; round < 2; ++round) {
        together.build(triangles);
        EXPECT_TRUE(content_of(together) == expected) << threads << " threads";
        EXPECT_EQ(together.stats().triangle_box_tests, stats.triangle_box_tests);
        EXPECT_EQ(together.stats().max_depth, stats.max_depth);
        EXPECT_EQ(together.stats().limited, stats.limited);
        if (round == 0) continue;
        if (memory == MemoryMode::pool) {
          EXPECT_EQ(together.stats().allocations, 0U);
        } else {
          EXPECT_GT(together.stats().allocations, 0U);
        }
      }
    }
  }
}

/// A build with two threads can be ended at any look, is then empty, and can be built again.
template <class Structure>
void expect_cancelled_builds_end(Structure& structure, const std::vector<Triangle>& triangles) {
  structure.set_build_threads(2);
  BuildWatch watch;
  structure.set_build_watch(&watch);
  structure.build(triangles);
  EXPECT_EQ(watch.progress, 1.0F);
  const std::vector<std::byte> expected = content_of(structure);
  ASSERT_GT(watch.looks, 4U);
  // How many looks there are depends on which thread does what; the first few are there always.
  for (const std::uint64_t look : {1U, 2U, 3U, 4U}) {
    watch.last_look = look;
    EXPECT_THROW(structure.build(triangles), BuildCancelled);
    EXPECT_LT(watch.progress, 1.0F);
    EXPECT_EQ(structure.stats().triangles, 0U);
  }
  std::atomic<bool> cancel{true};
  watch.last_look = ~std::uint64_t{0};
  watch.cancel = &cancel;
  EXPECT_THROW(structure.build(triangles), BuildCancelled);
  EXPECT_EQ(structure.stats().triangles, 0U);
  cancel = false;
  structure.build(triangles);
  EXPECT_TRUE(content_of(structure) == expected);
  structure.set_build_watch(nullptr);
}

}  // namespace encore::accel::test
