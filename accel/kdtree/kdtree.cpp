#include "accel/kdtree/kdtree.h"

#include "accel/kdtree/kd_node.h"
#include "accel/kdtree/kdtree_build_median.h"
#include "shaders/shared/bindings.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace encore::accel {

std::string_view KdTree::name() const {
  return to_string(kind_);
}

void KdTree::build(std::span<const Triangle> triangles) {
  if (triangles.size() >= kKdMostNodes) {
    throw std::length_error("a kd-tree holds fewer than 2^30 triangles");
  }
  mark_changed();
  BuildMeter meter(build_watch());
  Workers workers(build_threads(), triangles.size());
  try {
    workers.run([&] { build_over(triangles, meter, workers); });
  } catch (...) {
    triangles_ = {};
    top_memory_ = {};
    BuildMeter unwatched(nullptr);
    build_over({}, unwatched, Workers(1));
    throw;
  }
  meter.finish();
}

void KdTree::build_over(std::span<const Triangle> triangles, BuildMeter& meter,
                        const Workers& workers) {
  triangles_ = triangles;
  Bounds bounds;
  meter.pass(triangles.size(), [&](std::size_t begin, std::size_t end) {
    Bounds here = bounds;  // a copy stays in registers
    for (std::size_t i = begin; i < end; ++i) here.extend(scene::bounds_of(triangles[i]));
    bounds = here;
  });
  bounds_ = bounds;
  const KdLimits limits = kd_limits(settings_, triangles.size());
  if (!workers.parallel() || !build_together(limits, meter, workers)) build_alone(limits, meter);
}

void KdTree::build_alone(const KdLimits& limits, BuildMeter& meter) {
  KdBuilder builder(triangles_, limits, mode_, memory_, meter);
  if (kind_ == StructureKind::kd_sah) {
    KdSahSplitter splitter(settings_, triangles_.size(), mode_, sah_memory_, meter);
    builder.run(bounds_, splitter);
    if (mode_ == MemoryMode::fresh) sah_memory_.keys.release();
  } else {
    KdMedianSplitter splitter;
    builder.run(bounds_, splitter);
  }
}

// The same tree by several threads; false if the limits are in the way.
bool KdTree::build_together(const KdLimits& limits, BuildMeter& meter, const Workers& workers) {
  // Where nodes might run out, it matters in which order they are made.
  if (limits.references + kKdDepthCap + 2 > kKdMostNodes) return false;
  KdTop top(triangles_, limits, mode_, top_memory_, meter, workers);
  const auto sah = kind_ == StructureKind::kd_sah ? &settings_ : nullptr;
  const bool whole = top.build(bounds_, sah, memory_, sah_memory_);
  if (!whole || mode_ == MemoryMode::fresh) top_memory_ = {};
  return whole;
}

std::uint64_t KdTree::build_operations() const {
  return memory_.references_classified + sah_memory_.keys_sorted + sah_memory_.candidates_examined;
}

BuildStats KdTree::stats() const {
  BuildStats stats;
  stats.triangles = triangles_.size();
  stats.allocations = memory_.allocations.requests + sah_memory_.allocations.requests;
  stats.allocated_bytes = memory_.allocations.bytes + sah_memory_.allocations.bytes;
  stats.triangle_box_tests = memory_.triangle_box_tests;
  stats.nodes = memory_.nodes.size();
  stats.references = memory_.references.size();
  stats.limited = memory_.limited;
  stats.bytes = memory_.nodes.bytes().size() + memory_.references.bytes().size();

  // A box without area (a line, a point) has no chances to compare: every ray is taken to meet all.
  const double whole = bounds_.area();
  visit([&](const NodeView& node) {
    const double chance = whole > 0.0 ? node.bounds.area() / whole : 1.0;
    stats.sah_cost += node.leaf ? chance * double(node.triangles.size()) : chance;
    stats.max_depth = std::max(stats.max_depth, node.depth);
    if (node.leaf) {
      ++stats.leaves;
      if (node.triangles.empty()) ++stats.empty_leaves;
      stats.largest_leaf = std::max<std::uint64_t>(stats.largest_leaf, node.triangles.size());
    }
    return true;
  });
  return stats;
}

GpuBuffers KdTree::gpu_buffers() const {
  return {{ENCORE_BINDING_NODES, memory_.nodes.bytes()},
          {ENCORE_BINDING_REFERENCES, memory_.references.bytes()}};
}

gpu::StructureParameters KdTree::gpu_parameters() const {
  gpu::StructureParameters parameters{};
  if (triangles_.empty()) return parameters;
  parameters.min = bounds_.min;
  parameters.max = bounds_.max;
  parameters.depth = memory_.depth;
  parameters.references = static_cast<std::uint32_t>(memory_.references.size());
  return parameters;
}

void KdTree::visit(const std::function<bool(const NodeView&)>& visitor) const {
  if (memory_.nodes.empty()) return;
  struct Waiting {
    std::uint32_t node;
    std::uint32_t depth;
    Bounds bounds;
  };
  std::array<Waiting, kKdDepthCap + 2> waiting;
  std::size_t count = 0;
  waiting[count++] = {0, 0, bounds_};
  while (count > 0) {
    const Waiting current = waiting[--count];
    const gpu::KdNode node = memory_.nodes[current.node];
    NodeView view;
    view.bounds = current.bounds;
    view.depth = current.depth;
    view.place = current.node;
    if (kd_tag(node) == kKdLeafTag) {
      view.leaf = true;
      view.triangles = memory_.references.span().subspan(kd_first(node), kd_count(node));
      visitor(view);
      continue;
    }
    view.split_axis = static_cast<int>(kd_tag(node));
    view.split_position = kd_position(node);
    if (!visitor(view)) continue;
    Waiting upper{kd_upper(node), current.depth + 1, current.bounds};
    upper.bounds.min[view.split_axis] = view.split_position;
    waiting[count++] = upper;
    Waiting lower{current.node + 1, current.depth + 1, current.bounds};
    lower.bounds.max[view.split_axis] = view.split_position;
    waiting[count++] = lower;
  }
}

}  // namespace encore::accel
