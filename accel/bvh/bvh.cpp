#include "accel/bvh/bvh.h"

#include "shaders/shared/bindings.h"

#include <array>
#include <stdexcept>

namespace encore::accel {

namespace {

constexpr std::size_t kMostTriangles = std::size_t{1} << 31;  // 2 #T - 1 nodes, indexed in 32 bits

Bounds bounds_of_node(const gpu::BvhNode& node) {
  return {node.min, node.max};
}

}  // namespace

Bvh::Bvh(StructureKind kind, const BvhSettings& settings, MemoryMode memory)
    : kind_(kind), settings_(settings), memory_(memory) {}

void Bvh::build(std::span<const Triangle> triangles) {
  if (triangles.size() > kMostTriangles) {
    throw std::length_error("a bounding volume hierarchy holds at most 2147483648 triangles");
  }
  mark_changed();
  BuildMeter meter(build_watch());
  Workers workers(build_threads(), triangles.size());
  try {
    workers.run([&] { build_over(triangles, meter, workers); });
  } catch (...) {
    BuildMeter unwatched(nullptr);
    Workers alone(1);
    build_over({}, unwatched, alone);
    throw;
  }
  meter.finish();
}

void Bvh::build_over(std::span<const Triangle> triangles, BuildMeter& meter,
                     const Workers& workers) {
  triangles_ = triangles;
  allocations_ = {};
  refit_ = {};
  quality_.forget();
  max_depth_ = 0;
  pairs_.reset(triangles.size(), memory_, allocations_);
  if (!triangles.empty()) build_median(meter, workers);
  if (memory_ == MemoryMode::fresh) {
    items_.release();
    changed_.release();
  }
}

std::span<const gpu::BvhNode> Bvh::nodes() const {
  if (triangles_.empty()) return {};
  return {root(), 2 * triangles_.size() - 1};
}

BuildStats Bvh::stats() const {
  BuildStats stats;
  stats.triangles = stats.leaves = stats.references = triangles_.size();
  stats.largest_leaf = triangles_.empty() ? 0 : 1;
  stats.allocations = allocations_.requests;
  stats.allocated_bytes = allocations_.bytes;
  stats.nodes = nodes().size();
  stats.max_depth = max_depth_;
  stats.bytes = nodes().size_bytes();
  stats.sah_cost = bvh_sah_cost(nodes());
  return stats;
}

bool Bvh::decayed() const {
  const std::optional<double> decay = quality_.decay();
  return !decay || *decay >= double(settings_.rebuild_at);
}

GpuBuffers Bvh::gpu_buffers() const {
  return {{ENCORE_BINDING_NODES, std::as_bytes(nodes())}};
}

gpu::StructureParameters Bvh::gpu_parameters() const {
  gpu::StructureParameters parameters{};
  if (triangles_.empty()) return parameters;
  parameters.min = root()->min;
  parameters.max = root()->max;
  parameters.depth = max_depth_;
  parameters.references = static_cast<std::uint32_t>(triangles_.size());
  return parameters;
}

void Bvh::visit(const std::function<bool(const NodeView&)>& visitor) const {
  if (triangles_.empty()) return;
  struct Task {
    std::uint32_t node, depth;
  };
  std::array<Task, kMaxDepth + 1> waiting;
  std::uint32_t waiting_count = 0;
  waiting[waiting_count++] = {0, 0};
  while (waiting_count > 0) {
    const Task task = waiting[--waiting_count];
    const gpu::BvhNode& node = root()[task.node];
    NodeView view;
    view.bounds = bounds_of_node(node);
    view.depth = task.depth;
    view.leaf = node.count != 0;
    view.place = place(node.first, node.count);
    if (view.leaf) view.triangles = {&node.first, 1};
    if (!visitor(view) || view.leaf) continue;
    waiting[waiting_count++] = {node.first + 1, task.depth + 1};
    waiting[waiting_count++] = {node.first, task.depth + 1};
  }
}

}  // namespace encore::accel
