#pragma once

#include "accel/bvh/bvh.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace encore::renderer {

/// Refits a bounding volume hierarchy in place on the device: every leaf takes its triangle's box
/// and climbs; of two siblings the one that arrives last fits their parent (after Karras 2012,
/// "Maximizing Parallelism in the Construction of BVHs, Octrees, and k-d Trees"). No thread ever
/// waits for another, so this is right on every device. Boxes are exact minima and maxima: bit for
/// bit those of Bvh::update() on the same nodes, in every update case.
///
/// The links from children to parents are made on the device too, once after each upload of nodes.
class GpuRefit {
 public:
  /// Both stay in use; the hierarchy is the one that the nodes on the device are copies of.
  GpuRefit(std::shared_ptr<gl::Context> context, const accel::Bvh& bvh);

  /// Makes the links anew if the nodes on the device are those of another build, then refits them
  /// to the triangles on the device. Does not wait. Uses storage bindings of the tracer's.
  void run(gl::Buffer& nodes, const gl::Buffer& triangles);

 private:
  void link(const gl::Buffer& nodes);

  std::shared_ptr<gl::Context> context_;
  const accel::Bvh& bvh_;
  std::optional<std::uint64_t> linked_version_;
  gl::Buffer parents_{"the links to parents"};
  gl::Buffer arrivals_{"the arrivals of a refit"};
  gl::Buffer leaf_writes_{"the leaves to write"};
};

}  // namespace encore::renderer
