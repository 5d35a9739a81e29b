#include "renderer/gl/fence.h"

#include "compute.h"
#include "renderer/gl/error.h"
#include "tests/support/gl_context.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <string>

namespace encore::renderer::gl {
namespace {

using test::contains;
using FenceTest = test::GlTest;

/// Some milliseconds' work on a slow device.
constexpr const char* kWork = R"(#version 430 core
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Data { uint data[]; };
uniform uint rounds;
void main() {
  uint x = gl_GlobalInvocationID.x;
  for (uint i = 0u; i < rounds; ++i) x = x * 1664525u + 1013904223u;
  data[gl_GlobalInvocationID.x] = x;
}
)";

TEST_F(FenceTest, TimerTellsTheDevicesTime) {
  const int bits = context_->capabilities().timestamp_bits;
  if (bits == 0) GTEST_SKIP() << "this device has no clock";
  Timer timer(bits);
  EXPECT_FALSE(timer.seconds()) << "nothing was timed yet";
  timer.begin();
  EXPECT_FALSE(timer.seconds()) << "not ended yet";

  const Program program = test_support::compute_program(kWork);
  Buffer buffer("test data");
  buffer.reserve(1 << 16, 1 << 20);
  buffer.bind_storage(0);
  program.set("rounds", 1U);
  test_support::run(program, 256);  // compiles
  timer.begin();
  timer.end();
  finish("no work");
  ASSERT_TRUE(timer.seconds());
  EXPECT_GE(*timer.seconds(), 0.0);
  program.set("rounds", 4000U);
  timer.begin();
  test_support::run(program, 256);
  timer.end();
  finish("work");
  ASSERT_TRUE(timer.seconds());
  EXPECT_GT(*timer.seconds(), 0.0);
}

TEST_F(FenceTest, ATimerWithoutAClockSaysNothing) {
  Timer timer(0);
  timer.begin();
  timer.end();
  finish("no work");
  EXPECT_FALSE(timer.seconds());
}

TEST_F(FenceTest, WhatHasFinishedIsWaitedForWithoutTime) {
  finish("no work");
  EXPECT_NO_THROW(finish("no work", 0.0));
}

}  // namespace
}  // namespace encore::renderer::gl
