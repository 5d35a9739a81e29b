#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace encore::renderer {

/// Builds a bounding volume hierarchy over the triangles on the device, there: so that a scene that
/// is rebuilt every frame sends its vertices alone. Morton codes of the middles of the triangles'
/// boxes, a radix sort, the binary radix tree over them and its boxes bottom-up (Karras 2012,
/// "Maximizing Parallelism in the Construction of BVHs, Octrees, and k-d Trees").
///
/// Nodes are gpu::BvhNode with a triangle a leaf, as bvh-median's: the same shader traces them. The
/// tree depends on the triangles alone and is the same on every device that rounds alike, each
/// time.
class GpuBuild {
 public:
  explicit GpuBuild(std::shared_ptr<gl::Context> context) : context_(std::move(context)) {}

  /// Builds over the first `count` triangles (gpu::Triangle) of the buffer. Does not wait. Uses
  /// storage bindings of the tracer's. Throws GlError if the nodes do not fit on the device.
  void run(const gl::Buffer& triangles, std::uint32_t count);
  /// Fits the boxes of the last build to triangles that moved since, as many in the same order.
  void fit(const gl::Buffer& triangles);

  /// Binds nodes and parameters where the shaders look for a structure's.
  void bind() const;

  /// Of the last build.
  [[nodiscard]] std::uint32_t triangle_count() const { return count_; }
  [[nodiscard]] std::size_t node_count() const {
    return count_ == 0 ? 0 : 2 * std::size_t{count_} - 1;
  }
  /// No path from the root is longer, in nodes below it: a bit of a code or a place a level.
  [[nodiscard]] std::uint32_t most_depth() const;
  [[nodiscard]] const gl::Buffer& nodes() const { return nodes_; }
  /// Code and triangle of each leaf, in ascending order of codes, then of triangles.
  [[nodiscard]] const gl::Buffer& sorted() const { return keys_[0]; }

 private:
  void reserve();
  void sort();

  std::shared_ptr<gl::Context> context_;
  std::uint32_t count_ = 0;
  gl::Buffer nodes_{"the nodes of a hierarchy built on the device"};
  gl::Buffer parents_{"the links to parents"};
  gl::Buffer arrivals_{"the arrivals of a refit"};
  gl::Buffer bounds_{"the box of the triangles' centres"};
  gl::Buffer keys_[2] = {gl::Buffer("the Morton codes"), gl::Buffer("the sorted Morton codes")};
  gl::Buffer counts_{"the counts of a sort"};
  gl::Buffer parameters_{"the parameters of a hierarchy built on the device"};
};

}  // namespace encore::renderer
