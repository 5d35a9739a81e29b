#include "tests/soak/program/memory_use.h"

#include <malloc.h>
#include <unistd.h>

#include <cstddef>
#include <fstream>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ENCORE_SANITIZER_ALLOCATOR
// sanitizer/allocator_interface.h, which not every compiler ships.
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();
#endif

namespace encore::test {

MemoryUse memory_use() {
  MemoryUse use;
  std::uint64_t all_pages = 0;
  std::uint64_t resident_pages = 0;
  std::ifstream("/proc/self/statm") >> all_pages >> resident_pages;
  use.resident = resident_pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
#ifdef ENCORE_SANITIZER_ALLOCATOR
  use.in_use = __sanitizer_get_current_allocated_bytes();
#else
  const struct mallinfo2 info = mallinfo2();
  use.in_use = info.uordblks + info.hblkhd;
#endif
  return use;
}

Drift drift_of(std::span<const double> values) {
  const auto count = static_cast<double>(values.size());
  double mean = 0.0;
  for (const double value : values) mean += value / count;
  const double middle = (count - 1.0) / 2.0;
  double over = 0.0;
  double under = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = static_cast<double>(i) - middle;
    over += x * (values[i] - mean);
    under += x * x;
  }
  const double slope = over / under;
  return {.per_round = slope, .whole = slope * (count - 1.0) / mean};
}

}  // namespace encore::test
