#include "renderer/gl/buffer.h"

#include "compute.h"
#include "renderer/gl/error.h"
#include "tests/support/gl_context.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace encore::renderer::gl {
namespace {

using test::contains;
using test_support::words_of;
using BufferTest = test::GlTest;
using Words = std::vector<std::uint32_t>;

constexpr std::uint64_t kMost = 1 << 20;

TEST_F(BufferTest, GivesBackWhatWasWritten) {
  Buffer buffer("test data");
  buffer.reserve(40, kMost);
  Words words(10);
  std::iota(words.begin(), words.end(), 100U);
  buffer.write(std::as_bytes(std::span(words)));
  EXPECT_EQ(words_of(buffer, 10), words);
  const Words patch{7, 8};
  buffer.write(std::as_bytes(std::span(patch)), 12);
  EXPECT_EQ(words_of(buffer, 4, 8), (Words{102, 7, 8, 105}));
}

TEST_F(BufferTest, FillSetsOnlyTheFirstBytes) {
  Buffer buffer("test data");
  buffer.reserve(16, kMost);
  buffer.fill(0xDEADBEEF, 16);
  buffer.fill(3, 8);
  EXPECT_EQ(words_of(buffer, 4), (Words{3, 3, 0xDEADBEEF, 0xDEADBEEF}));
  EXPECT_THROW(buffer.fill(0, 6), std::logic_error);
  EXPECT_THROW(buffer.fill(0, 4096), std::logic_error);
}

TEST_F(BufferTest, GrowsByHalfAgainAndNeverShrinks) {
  Buffer buffer("test data");
  EXPECT_EQ(buffer.id(), 0U);
  buffer.reserve(0, kMost);
  EXPECT_EQ(buffer.capacity(), 16U);
  buffer.reserve(1000, kMost);
  EXPECT_EQ(buffer.capacity(), 1000U);
  const std::uint32_t id = buffer.id();
  const Words words{1, 2, 3};
  buffer.write(std::as_bytes(std::span(words)));
  buffer.reserve(500, kMost);  // nothing happens, so what was there still is
  EXPECT_EQ(buffer.capacity(), 1000U);
  EXPECT_EQ(words_of(buffer, 3), words);
  buffer.reserve(1004, kMost);
  EXPECT_EQ(buffer.capacity(), 1500U);
  EXPECT_EQ(buffer.id(), id);
  buffer.reserve(1504, 1600);  // but not beyond what the device can show a shader
  EXPECT_EQ(buffer.capacity(), 1600U);
}

TEST_F(BufferTest, OverTheLimitThrowsNamingBothNumbers) {
  Buffer buffer("the nodes of kd-sah");
  buffer.reserve(64, kMost);
  try {
    buffer.reserve(163'892'429, 128 << 20);
    FAIL() << "it was not refused";
  } catch (const GlError& error) {
    const std::string message = error.what();
    for (const char* part : {"the nodes of kd-sah", "156.3 MiB", "128 MiB", "--device cpu"}) {
      EXPECT_TRUE(contains(message, part)) << part << "\n" << message;
    }
  }
  EXPECT_EQ(buffer.capacity(), 64U);
}

TEST_F(BufferTest, WhatTheDeviceHasNoRoomForThrowsNamingIt) {
  Buffer buffer("the triangles");
  constexpr std::uint64_t kFar = std::uint64_t{1} << 46;  // 64 TiB
  try {
    buffer.reserve(kFar, std::numeric_limits<std::uint64_t>::max());
    FAIL() << "the device took 64 TiB";
  } catch (const GlError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(contains(message, "the triangles")) << message;
    EXPECT_TRUE(contains(message, "GL_OUT_OF_MEMORY")) << message;
    EXPECT_TRUE(contains(message, "64 TiB")) << message;
  }
  EXPECT_EQ(buffer.capacity(), 0U);
  EXPECT_NO_THROW(context_->check("after it"));
  buffer.reserve(64, kMost);  // and it can be used again
  buffer.fill(5, 64);
  EXPECT_EQ(words_of(buffer, 1), Words{5});
}

TEST_F(BufferTest, AccessBeyondWhatWasReservedIsRefused) {
  Buffer buffer("test data");
  Words words(4);
  EXPECT_THROW(buffer.read(std::as_writable_bytes(std::span(words))), std::logic_error);
  buffer.reserve(16, kMost);
  EXPECT_NO_THROW(buffer.read(std::as_writable_bytes(std::span(words))));
  EXPECT_THROW(buffer.read(std::as_writable_bytes(std::span(words)), 4), std::logic_error);
  EXPECT_THROW(buffer.write(std::as_bytes(std::span(words)), 4), std::logic_error);
  EXPECT_THROW(
      buffer.write(std::as_bytes(std::span(words)), std::numeric_limits<std::size_t>::max() - 8),
      std::logic_error);
}

TEST_F(BufferTest, MovingKeepsTheMemory) {
  Buffer first("test data");
  first.reserve(16, kMost);
  first.fill(9, 16);
  const Buffer second(std::move(first));
  EXPECT_EQ(words_of(second, 4), Words(4, 9));
}

TEST_F(BufferTest, ShadersWriteAndReadInOrderWithTheHost) {
  const Program program = test_support::compute_program(R"(#version 430 core
layout(local_size_x = 64) in;
layout(std430, binding = 3) buffer Data { uint data[]; };
uniform uint factor;
uniform int summand;
uniform ivec2 more;
void main() {
  uint i = gl_GlobalInvocationID.x;
  data[i] = data[i] * factor + uint(summand + more.x * more.y);
}
)");
  Buffer buffer("test data");
  buffer.reserve(4096, kMost);
  Words words(1024);
  std::iota(words.begin(), words.end(), 0U);
  buffer.write(std::as_bytes(std::span(words)));
  buffer.bind_storage(3);
  program.set("factor", 3U);
  program.set("summand", 5);
  program.set("more", 2, 4);
  program.set("left out by the compiler", 1);
  test_support::run(program, 16);
  for (std::uint32_t& word : words) word = 3 * word + 13;
  EXPECT_EQ(words_of(buffer, 1024), words);
}

}  // namespace
}  // namespace encore::renderer::gl
