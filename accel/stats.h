#pragma once

#include <array>
#include <cstdint>

namespace encore::accel {

/// What the last build or update did and what the structure is now (the thesis' Table 3 and more).
/// Fields that mean nothing for a structure stay 0.
struct BuildStats {
  std::uint64_t triangles = 0;
  // The last build or update:
  std::uint64_t allocations = 0;         ///< requests to the system's allocator (thesis: MC)
  std::uint64_t allocated_bytes = 0;     ///< bytes of those requests (thesis: MS)
  std::uint64_t triangle_box_tests = 0;  ///< exact triangle-box overlap tests
  // The structure:
  std::uint64_t nodes = 0;
  std::uint64_t leaves = 0;  ///< grid: cells that hold a reference
  std::uint64_t empty_leaves = 0;
  std::uint32_t max_depth = 0;  ///< the root alone has depth 0
  std::array<std::uint32_t, 3> grid_size{};
  std::uint64_t references = 0;
  std::uint64_t largest_leaf = 0;  ///< most references in one leaf or cell
  std::uint64_t bytes = 0;         ///< memory that tracing needs (nodes, references, cells)
  /// Whether the structure is coarser than its settings ask for, since it would have needed more
  /// memory than they allow (most_references).
  bool limited = false;
  /// Expected cost of a random ray that hits the scene's box, in units of one triangle test with a
  /// step costing 1 (Goldsmith and Salmon 1987; MacDonald and Booth 1990): for trees
  /// sum(area(inner)) + sum(area(leaf) * references), divided by area(root); for grids the same
  /// with cells as leaves.
  double sah_cost = 0.0;

  [[nodiscard]] double references_per_leaf() const {
    return leaves > empty_leaves ? double(references) / double(leaves - empty_leaves) : 0.0;
  }
  [[nodiscard]] double duplication() const {
    return triangles > 0 ? double(references) / double(triangles) : 0.0;
  }
};

}  // namespace encore::accel
