#pragma once

#include "accel/wide/wide_bvh.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace encore::renderer {

/// What GpuRefit is for bvh-median, for bvh-sah: fits the boxes of its nodes in place on the
/// device, bottom-up (after Karras 2012). Every leaf's box is that of its triangles, every inner
/// node's that of its children: the boxes of WideBvh::update() on the same nodes.
class GpuWideRefit {
 public:
  /// Both stay in use; the hierarchy is the one that the nodes on the device are copies of.
  GpuWideRefit(std::shared_ptr<gl::Context> context, const accel::WideBvh& bvh);

  /// Makes the links from nodes to parents anew if the nodes on the device are those of another
  /// build, then refits them to the triangles on the device. Does not wait. Uses storage bindings
  /// of the tracer's.
  void run(const gl::Buffer& nodes, const gl::Buffer& references, const gl::Buffer& triangles);

 private:
  void link();

  std::shared_ptr<gl::Context> context_;
  const accel::WideBvh& bvh_;
  std::optional<std::uint64_t> linked_version_;
  gl::Buffer parents_{"the links to parents"};
  gl::Buffer arrivals_{"the arrivals of a refit"};
};

}  // namespace encore::renderer
