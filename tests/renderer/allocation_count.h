#pragma once

#include <cstdint>

namespace encore::renderer::test {

/// Calls of any global operator new of this program so far, by all threads.
std::uint64_t allocations_so_far();

}  // namespace encore::renderer::test
