#pragma once

#include "accel/task_handover.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cstddef>

namespace encore::accel {

/// Builds and updates of fewer triangles are left to one thread: waking others would cost more than
/// they bring.
inline constexpr std::size_t kParallelTriangles = 1U << 16U;

/// The threads of one build or update, the caller's among them. One thread is no library call at
/// all, so what a single thread costs is measured as it is.
///
/// Results must not depend on the number of threads: cut work by its size, never by who does it.
class Workers {
 public:
  /// `threads` >= 1, 0: as many as the calling thread's arena has.
  explicit Workers(int threads)
      : threads_(threads > 0 ? threads : tbb::this_task_arena::max_concurrency()) {}

  /// The same for a build or update of so many triangles: one where they are few.
  Workers(int threads, std::size_t triangles)
      : Workers(triangles < kParallelTriangles ? 1 : threads) {}

  [[nodiscard]] int threads() const { return threads_; }
  [[nodiscard]] bool parallel() const { return threads_ > 1; }

  /// Runs the whole of a build so that at most threads() threads work on it; the two calls below
  /// belong inside. Exceptions come through.
  template <class Work>
  void run(const Work& work) {
    if (!parallel()) return work();
    tbb::task_arena arena(threads_);
    TaskHandover handover;
    arena.execute([&] {
      const TaskHandover::Task task(handover);
      work();
    });
  }

  /// body(begin, end) over [0, count), in parts of `part` elements (the last may be smaller), in
  /// any order and several at once. The parts are the same for any number of threads.
  template <class Body>
  void for_parts(std::size_t count, std::size_t part, const Body& body) const {
    const std::size_t parts = (count + part - 1) / part;
    const auto run_part = [&](std::size_t k) { body(k * part, std::min(count, (k + 1) * part)); };
    if (!parallel() || parts <= 1) {
      for (std::size_t k = 0; k < parts; ++k) run_part(k);
      return;
    }
    TaskHandover handover;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, parts, 1),
        [&](const tbb::blocked_range<std::size_t>& range) ENCORE_NOT_THREAD_SANITIZED {
          const TaskHandover::Task task(handover);
          for (std::size_t k = range.begin(); k < range.end(); ++k) run_part(k);
        },
        tbb::simple_partitioner());
  }

  /// Both calls, at once if `worth_it`; returns when both are done.
  template <class First, class Second>
  void both(bool worth_it, const First& first, const Second& second) const {
    if (!parallel() || !worth_it) {
      first();
      second();
      return;
    }
    TaskHandover handover;
    tbb::task_group group;
    group.run([&]() ENCORE_NOT_THREAD_SANITIZED {
      const TaskHandover::Task task(handover);
      second();
    });
    try {
      first();
    } catch (...) {
      // The task uses what lies on this stack.
      group.cancel();
      group.wait();
      throw;
    }
    group.wait();
  }

 private:
  int threads_;
};

}  // namespace encore::accel
