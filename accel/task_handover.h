#pragma once

// Said by GCC and by Clang.
#if defined(__SANITIZE_THREAD__)
#define ENCORE_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define ENCORE_THREAD_SANITIZER
#endif
#endif

#ifdef ENCORE_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
/// Left as it is by the thread sanitizer: what a task reads of itself before begin() was written by
/// whoever made the task, in a way that the sanitizer cannot see.
#define ENCORE_NOT_THREAD_SANITIZED __attribute__((no_sanitize("thread")))
#else
#define ENCORE_NOT_THREAD_SANITIZED
#endif

namespace encore::accel {

/// Tells the thread sanitizer how work passes from one thread to others and back through oneTBB,
/// whose library is not built with it. Says nothing of one task's work to another, so races between
/// tasks are still found. In other builds nothing is left of it.
///
/// Where it lives: what was written before, tasks may read; what they have written may be read
/// after it, also where one of them has thrown.
class TaskHandover {
 public:
#ifdef ENCORE_THREAD_SANITIZER
  TaskHandover() {
    __tsan_release(&begun_);
  }
  ~TaskHandover() {
    __tsan_acquire(&ended_);
  }
  TaskHandover(const TaskHandover&) = delete;
  TaskHandover& operator=(const TaskHandover&) = delete;

  /// A task, from where it begins to where it ends.
  class Task {
   public:
    explicit Task(TaskHandover& handover) : handover_(handover) {
      __tsan_acquire(&handover_.begun_);
    }
    ~Task() { __tsan_release(&handover_.ended_); }
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;

   private:
    TaskHandover& handover_;
  };

 private:
  char begun_ = 0;
  char ended_ = 0;
#else
  TaskHandover() {}
  class Task {
   public:
    explicit Task(TaskHandover& /*handover*/) {}
  };
#endif
};

}  // namespace encore::accel
