#include "renderer/gpu_wide_refit.h"

#include "renderer/gpu_each.h"
#include "shaders/shared/bindings.h"

#include <utility>

namespace encore::renderer {

GpuWideRefit::GpuWideRefit(std::shared_ptr<gl::Context> context, const accel::WideBvh& bvh)
    : context_(std::move(context)), bvh_(bvh) {}

void GpuWideRefit::run(const gl::Buffer& nodes, const gl::Buffer& references,
                       const gl::Buffer& triangles) {
  const std::size_t count = bvh_.tree().nodes.size();
  if (count == 0) return;
  nodes.bind_storage(ENCORE_BINDING_NODES);
  if (linked_version_ != bvh_.version()) link();
  arrivals_.fill(0, count * sizeof(std::uint32_t));
  references.bind_storage(ENCORE_BINDING_REFERENCES);
  triangles.bind_storage(ENCORE_BINDING_TRIANGLES);
  parents_.bind_storage(ENCORE_BINDING_WIDE_PARENTS);
  arrivals_.bind_storage(ENCORE_BINDING_ARRIVALS);
  run_for_each(*each_program(*context_, "refit_wide.comp"), accel::WideTree::kWidth * count);
}

void GpuWideRefit::link() {
  const std::size_t count = bvh_.tree().nodes.size();
  const std::uint64_t most = context_->capabilities().storage_block_bytes;
  parents_.reserve(count * sizeof(std::uint32_t), most);
  arrivals_.reserve(count * sizeof(std::uint32_t), most);
  parents_.bind_storage(ENCORE_BINDING_WIDE_PARENTS);
  run_for_each(*each_program(*context_, "link_wide.comp"), accel::WideTree::kWidth * count);
  linked_version_ = bvh_.version();
}

}  // namespace encore::renderer
