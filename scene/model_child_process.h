#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace encore::scene {

/// What a child process may use before it is ended. Memory counts from what this process has mapped
/// at the start; the wall clock also runs while the child waits (for a pipe, a slow disk).
struct ChildLimits {
  std::uint64_t memory_bytes = 0;
  std::uint32_t cpu_seconds = 0;
  std::uint32_t wall_seconds = 0;
};

struct ChildResult {
  enum class Outcome { finished, crashed, out_of_memory, out_of_time, cancelled, not_started };
  Outcome outcome = Outcome::not_started;
  std::string bytes;  ///< what the work returned, if it finished
};

/// Runs `work` in a forked copy of this process, so that whatever it does (crash, hang, swell) ends
/// there, and hands back the bytes it returned. Its output goes nowhere. `work` must not rely on
/// other threads: only the calling one lives in the child. A LoadWatch (load_watch.h) that cancels
/// ends the child within 20 ms. Never throws but std::bad_alloc for the bytes that come back.
ChildResult run_in_child(const std::function<std::string()>& work, const ChildLimits& limits);

}  // namespace encore::scene
