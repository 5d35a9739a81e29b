#include "accel/wide/wide_build.h"

#include "accel/wide/wide_build_memory.h"

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace encore::accel {

namespace {

constexpr std::size_t kMostTriangles = std::size_t{1} << 28;

void make_empty(WideTree& tree, MemoryMode mode, AllocationCount& allocations) {
  tree.nodes.reset(0, mode, allocations);
  tree.blocks.reset(0, mode, allocations);
  tree.ids.reset(0, mode, allocations);
  tree.min = tree.max = gpu::vec3(0.0F);
  tree.triangles = tree.references = tree.leaves = tree.depth = 0;
}

}  // namespace

void WideBuildMemory::release() {
  for (auto& array : items) array.release();
  for (auto& array : keys) array.release();
  part_boxes.release();
  part_bins.release();
  part_slabs.release();
  leaf_boxes.release();
  runs.release();
  digits.release();
  nodes.release();
  order.release();
  top.release();
  subtrees.release();
  top_places.release();
  subtree_places.release();
}

std::uint64_t most_wide_bytes(BuildPreset preset, std::uint64_t triangles) {
  const std::uint64_t references =
      preset == BuildPreset::best ? most_wide_references(triangles) : triangles;
  // The most where every leaf holds a single reference (most_wide_nodes): then n / 7 nodes.
  return (references / 7 + 1) * sizeof(gpu::WideNode) +
         references * (sizeof(TriangleBlock) + TriangleBlock::kSize * sizeof(std::uint32_t));
}

void find_wide_bounds(WideBuildRun& run) {
  const std::size_t count = run.triangles.size();
  Array<WideBox>& boxes = run.memory.part_boxes;
  boxes.reset((count + kWidePart - 1) / kWidePart, run.mode, run.allocations);
  for_wide_parts(run, count, 0.05, [&](std::size_t begin, std::size_t end) {
    WideBox& box = boxes[begin / kWidePart];
    box = kEmptyWideBox;
    run.kernels.bounds(run.triangles.data(), begin, end, box);
  });
  run.box = kEmptyWideBox;
  for (const WideBox& box : boxes.span()) extend(run.box, box);
  float largest = 0.0F;
  for (const int i : {0, 1, 2, 4, 5, 6}) largest = std::max(largest, std::fabs(run.box.ends[i]));
  int exponent = 0;
  std::frexp(largest, &exponent);
  run.unit = std::ldexp(1.0F, std::clamp(-exponent, -126, 126));
}

WideBuilder::WideBuilder(MemoryMode memory)
    : mode_(memory),
      kernels_(&wide_build_kernels(chosen_isa())),
      memory_(std::make_unique<WideBuildMemory>()) {}

WideBuilder::~WideBuilder() = default;

void WideBuilder::set_isa(Isa isa) {
  kernels_ = &wide_build_kernels(isa);
}

void WideBuilder::build(std::span<const scene::Triangle> triangles, BuildPreset preset,
                        Workers& workers, BuildMeter& meter, WideTree& tree,
                        AllocationCount& allocations) {
  if (triangles.size() > kMostTriangles) {
    throw std::length_error("a wide hierarchy holds at most 268435456 triangles");
  }
  make_empty(tree, mode_, allocations);
  if (triangles.empty()) return;
  WideBuildRun run{.kernels = *kernels_,
                   .triangles = triangles,
                   .workers = workers,
                   .meter = meter,
                   .mode = mode_,
                   .allocations = allocations,
                   .memory = *memory_,
                   .box = kEmptyWideBox,
                   .unit = 1.0F};
  try {
    find_wide_bounds(run);
    if (preset == BuildPreset::fast) {
      build_wide_morton(run);
    } else {
      build_wide_sah(run, preset == BuildPreset::best);
    }
    finish_wide_tree(run, tree);
  } catch (...) {
    if (mode_ == MemoryMode::fresh) memory_->release();
    throw;
  }
  if (mode_ == MemoryMode::fresh) memory_->release();
}

}  // namespace encore::accel
