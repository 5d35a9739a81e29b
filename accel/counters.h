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
  friend bool operator==(const TraceCounters&, const TraceCounters&) = default;
};

/// Which sides of a split plane a ray goes to: the one it meets first, the other one, or both.
enum class PlaneSides : std::uint8_t { near, far, both };

/// Counter policies of the inner loops. A traversal tells its policy everything that it does, in
/// order; `NotCounting` compiles to nothing, `Counting` adds up, `Recording`
/// (inspect/ray_recording.h) writes everything down. Nodes go by their place (NodeView::place),
/// distances are the traversal's own numbers.
///
/// - scene_box: the test against the box of everything, where a traversal has one (not counted)
/// - node: enters a node or cell; the stretch of the ray inside it where that is known
/// - box: tests the box of a node, whose place is a function: looking it up where nobody asks
///   would load nodes before it is known that the ray goes there
/// - plane: meets a node's split plane at the distance t
/// - triangles, triangle: is about to test these against the best hit so far
/// - skipped: leaves out a node that waited, since it begins behind the best hit
/// - cells: how to find the box of a cell, before the first one is entered
struct NotCounting {
  void scene_box(bool, float, float) {}
  void node(std::uint32_t) {}
  void node(std::uint32_t, float, float) {}
  template <class Place>
  void box(const Place&, bool, float) {}
  void plane(std::uint32_t, float, PlaneSides) {}
  template <class Triangle, class Hit>
  void triangles(const Triangle*, const std::uint32_t*, std::uint32_t, const Hit&) {}
  template <class Triangle, class Hit>
  void triangle(const Triangle*, std::uint32_t, const Hit&) {}
  void skipped(std::uint32_t, float, float) {}
  template <class BoundsOfCell>
  void cells(const BoundsOfCell&) {}
};
struct Counting : NotCounting {
  TraceCounters& sum;
  explicit Counting(TraceCounters& counters) : sum(counters) {}
  void node(std::uint32_t) { ++sum.steps; }
  void node(std::uint32_t, float, float) { ++sum.steps; }
  template <class Place>
  void box(const Place&, bool, float) {
    ++sum.box_tests;
  }
  template <class Triangle, class Hit>
  void triangles(const Triangle*, const std::uint32_t*, std::uint32_t count, const Hit&) {
    sum.triangle_tests += count;
  }
  template <class Triangle, class Hit>
  void triangle(const Triangle*, std::uint32_t, const Hit&) {
    ++sum.triangle_tests;
  }
};

}  // namespace encore::accel
