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
class TaskHandover {
 public:
#ifdef ENCORE_THREAD_SANITIZER
  void before_all() {
    __tsan_release(&begun_);
  }  ///< what was written so far, tasks may read
  void begin() {
    __tsan_acquire(&begun_);
  }  ///< a task begins
  void end() {
    __tsan_release(&ended_);
  }  ///< a task ends
  void after_all() {
    __tsan_acquire(&ended_);
  }  ///< what tasks have written may be read

 private:
  char begun_ = 0;
  char ended_ = 0;
#else
  void before_all() {}
  void begin() {}
  void end() {}
  void after_all() {}
#endif
};

}  // namespace encore::accel
