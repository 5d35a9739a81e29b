#include "renderer/gpu_build.h"

#include "renderer/gpu_each.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/gpu_types.h"

#include <bit>
#include <span>

namespace encore::renderer {

namespace {

constexpr std::uint32_t kCodeBits = 30;
// shaders/sort.glsl.
constexpr std::size_t kSortDigits = 16;
constexpr unsigned kSortDigitBits = 4;
constexpr std::size_t kSortEach = 8;
constexpr std::size_t kSortBlock = kSortEach * kEachGroup;
// An even number of passes: what is sorted lies where it was at first.
constexpr unsigned kSortPasses = 8;
static_assert(kSortPasses * kSortDigitBits >= kCodeBits && kSortPasses % 2 == 0);

std::size_t sort_blocks(std::size_t keys) {
  return (keys + kSortBlock - 1) / kSortBlock;
}

}  // namespace

std::uint32_t GpuBuild::most_depth() const {
  return count_ < 2 ? 0 : kCodeBits + static_cast<std::uint32_t>(std::bit_width(count_ - 1));
}

void GpuBuild::reserve() {
  const std::uint64_t most = context_->capabilities().storage_block_bytes;
  const std::size_t words = (std::size_t{count_} + 1) * sizeof(std::uint32_t);
  nodes_.reserve(node_count() * sizeof(gpu::BvhNode), most);
  parents_.reserve(words, most);
  arrivals_.reserve(words, most);
  bounds_.reserve(6 * sizeof(std::int32_t), most);
  for (gl::Buffer& keys : keys_) keys.reserve(2 * sizeof(std::uint32_t) * count_, most);
  counts_.reserve(kSortDigits * sort_blocks(count_) * sizeof(std::uint32_t), most);
}

void GpuBuild::run(const gl::Buffer& triangles, std::uint32_t count) {
  count_ = 0;  // until everything fits
  gpu::StructureParameters parameters{};
  parameters.references = count;
  parameters_.reserve(sizeof parameters, context_->capabilities().storage_block_bytes);
  parameters_.write(std::as_bytes(std::span(&parameters, 1)));
  count_ = count;
  try {
    reserve();
  } catch (...) {
    count_ = 0;
    throw;
  }
  if (count == 0) return;
  triangles.bind_storage(ENCORE_BINDING_TRIANGLES);
  bounds_.bind_storage(ENCORE_BINDING_BUILD_BOUNDS);
  bounds_.fill(0x7FFFFFFF, 6 * sizeof(std::int32_t));
  run_for_each(*each_program(*context_, "build_bounds.comp"), count);
  keys_[0].bind_storage(ENCORE_BINDING_SORT_TO);
  run_for_each(*each_program(*context_, "build_keys.comp"), count);
  sort();
  const auto tree = each_program(*context_, "build_tree.comp");
  keys_[0].bind_storage(ENCORE_BINDING_SORT_FROM);
  nodes_.bind_storage(ENCORE_BINDING_NODES);
  parents_.bind_storage(ENCORE_BINDING_PARENTS);
  tree->set("leaf_count", count);
  run_for_each(*tree, count == 1 ? 1 : count - 1);
  fit(triangles);
}

void GpuBuild::sort() {
  counts_.bind_storage(ENCORE_BINDING_SORT_COUNTS);
  const auto count = each_program(*context_, "sort_count.comp");
  const auto scan = each_program(*context_, "sort_scan.comp");
  const auto scatter = each_program(*context_, "sort_scatter.comp");
  const std::size_t threads = sort_blocks(count_) * kEachGroup;
  for (const auto& program : {count, scan, scatter}) program->set("key_count", count_);
  for (unsigned pass = 0; pass < kSortPasses; ++pass) {
    keys_[pass % 2].bind_storage(ENCORE_BINDING_SORT_FROM);
    keys_[1 - pass % 2].bind_storage(ENCORE_BINDING_SORT_TO);
    count->set("shift", kSortDigitBits * pass);
    scatter->set("shift", kSortDigitBits * pass);
    run_for_each(*count, threads);
    run_for_each(*scan, kEachGroup);
    run_for_each(*scatter, threads);
  }
}

void GpuBuild::fit(const gl::Buffer& triangles) {
  if (count_ == 0) return;
  arrivals_.fill(0, (std::size_t{count_} + 1) * sizeof(std::uint32_t));
  nodes_.bind_storage(ENCORE_BINDING_NODES);
  triangles.bind_storage(ENCORE_BINDING_TRIANGLES);
  parents_.bind_storage(ENCORE_BINDING_PARENTS);
  arrivals_.bind_storage(ENCORE_BINDING_ARRIVALS);
  run_for_each(*each_program(*context_, "refit.comp", {"ENCORE_UPDATE_WORST"}), node_count());
}

void GpuBuild::bind() const {
  nodes_.bind_storage(ENCORE_BINDING_NODES);
  parameters_.bind_uniform(ENCORE_BINDING_STRUCTURE);
}

}  // namespace encore::renderer
