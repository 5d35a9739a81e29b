#include "renderer/gpu_refit.h"

#include "renderer/gpu_each.h"
#include "shaders/shared/bindings.h"

#include <utility>
#include <vector>

namespace encore::renderer {

namespace {

const char* case_define(accel::UpdateCase update_case) {
  switch (update_case) {
    case accel::UpdateCase::real:
      return "ENCORE_UPDATE_REAL";
    case accel::UpdateCase::best:
      return "ENCORE_UPDATE_BEST";
    case accel::UpdateCase::average:
      return "ENCORE_UPDATE_AVERAGE";
    case accel::UpdateCase::worst:
      return "ENCORE_UPDATE_WORST";
  }
  return "ENCORE_UPDATE_REAL";
}

}  // namespace

GpuRefit::GpuRefit(std::shared_ptr<gl::Context> context, const accel::Bvh& bvh)
    : context_(std::move(context)), bvh_(bvh) {}

void GpuRefit::run(gl::Buffer& nodes, const gl::Buffer& triangles) {
  const std::size_t node_count = bvh_.nodes().size();
  if (node_count == 0) return;
  if (linked_version_ != bvh_.version()) link(nodes);

  const accel::UpdateCase update_case = bvh_.settings().update_case;
  const auto program = each_program(*context_, "refit.comp", {case_define(update_case)});
  const std::size_t pairs = node_count / 2 + 1;
  arrivals_.fill(0, pairs * sizeof(std::uint32_t));
  nodes.bind_storage(ENCORE_BINDING_NODES);
  triangles.bind_storage(ENCORE_BINDING_TRIANGLES);
  parents_.bind_storage(ENCORE_BINDING_PARENTS);
  arrivals_.bind_storage(ENCORE_BINDING_ARRIVALS);
  if (update_case == accel::UpdateCase::average) {
    leaf_writes_.bind_storage(ENCORE_BINDING_LEAF_WRITES);
  }
  run_for_each(*program, node_count);
}

void GpuRefit::link(const gl::Buffer& nodes) {
  const std::size_t node_count = bvh_.nodes().size();
  const std::uint64_t most = context_->capabilities().storage_block_bytes;
  const std::size_t pairs = node_count / 2 + 1;
  parents_.reserve(pairs * sizeof(std::uint32_t), most);
  arrivals_.reserve(pairs * sizeof(std::uint32_t), most);
  if (bvh_.settings().update_case == accel::UpdateCase::average) {
    const std::vector<std::uint32_t> bits = bvh_.average_case_leaves();
    leaf_writes_.reserve(bits.size() * sizeof(std::uint32_t), most);
    leaf_writes_.write(std::as_bytes(std::span(bits)));
  }
  const auto program = each_program(*context_, "link_parents.comp");
  nodes.bind_storage(ENCORE_BINDING_NODES);
  parents_.bind_storage(ENCORE_BINDING_PARENTS);
  run_for_each(*program, node_count);
  linked_version_ = bvh_.version();
}

}  // namespace encore::renderer
