#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace encore::accel {

/// Asks the system for large pages where so much is about to be written that the many small ones
/// would cost time: each the first time it is touched, and whenever work jumps from one to the
/// next. For memory all of which will be written, as a large page takes its whole size at once.
inline void ask_for_large_pages([[maybe_unused]] std::span<const std::byte> memory) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::size_t kWorthIt = std::size_t{4} << 20, kPage = 4096;
  if (memory.size() < kWorthIt) return;
  std::byte* const begin = const_cast<std::byte*>(memory.data());
  const std::size_t skip = (kPage - reinterpret_cast<std::uintptr_t>(begin) % kPage) % kPage;
  // A system that does not know them leaves everything as it is.
  ::madvise(begin + skip, (memory.size() - skip) / kPage * kPage, MADV_HUGEPAGE);
#endif
}

}  // namespace encore::accel
