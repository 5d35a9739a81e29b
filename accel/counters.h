#pragma once

#include <cstdint>

namespace encore::accel {

/// What one ray (or a batch, summed) cost. Counting is compiled in only where it is asked for.
struct TraceCounters {
  std::uint32_t steps = 0;           ///< nodes popped or cells entered
  std::uint32_t box_tests = 0;       ///< ray-box tests (BVH)
  std::uint32_t triangle_tests = 0;  ///< ray-triangle tests

  TraceCounters& operator+=(const TraceCounters& o) {
    steps += o.steps;
    box_tests += o.box_tests;
    triangle_tests += o.triangle_tests;
    return *this;
  }
};

/// Counter policies of the inner loops: `Counting` adds up, `NotCounting` compiles to nothing.
struct Counting {
  TraceCounters& sum;
  void step() { ++sum.steps; }
  void box_tests(std::uint32_t n) { sum.box_tests += n; }
  void triangle_tests(std::uint32_t n) { sum.triangle_tests += n; }
};
struct NotCounting {
  void step() {}
  void box_tests(std::uint32_t) {}
  void triangle_tests(std::uint32_t) {}
};

}  // namespace encore::accel
