#pragma once

#include "accel/build_watch.h"
#include "accel/parallel.h"
#include "accel/settings.h"
#include "accel/simd/isa.h"
#include "accel/wide/wide_tree.h"
#include "scene/triangle.h"

#include <cstdint>
#include <memory>
#include <span>

namespace encore::accel {

/// The most bytes that nodes, blocks and ids of a tree over so many triangles take.
std::uint64_t most_wide_bytes(BuildPreset preset, std::uint64_t triangles);

struct WideBuildKernels;
struct WideBuildMemory;

/// Builds and refits trees of bvh-sah. Keeps its working memory from build to build in
/// MemoryMode::pool. Trees depend on the triangles and the preset alone, not on threads or
/// instruction sets.
class WideBuilder {
 public:
  explicit WideBuilder(MemoryMode memory);
  ~WideBuilder();

  /// Builds `tree` over the triangles, all of them finite, with the workers' threads. Throws
  /// BuildCancelled if the meter's watch asks for it, std::length_error for more triangles than a
  /// tree can number; the tree is then in no defined state.
  void build(std::span<const scene::Triangle> triangles, BuildPreset preset, Workers& workers,
             BuildMeter& meter, WideTree& tree, AllocationCount& allocations);

  /// Which instruction set builds from now on; chosen_isa() unless a test asks for another.
  void set_isa(Isa isa);

  /// Copies the moved triangles' corners into the blocks and fits every box, in place. The
  /// triangles' number and order are those of the last build. Leaves that held a part of a triangle
  /// (BuildPreset::best) hold the whole of it afterwards.
  void refit(std::span<const scene::Triangle> triangles, Workers& workers, WideTree& tree);

 private:
  MemoryMode mode_;
  const WideBuildKernels* kernels_;
  std::unique_ptr<WideBuildMemory> memory_;
};

}  // namespace encore::accel
