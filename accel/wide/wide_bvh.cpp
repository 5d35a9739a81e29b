#include "accel/wide/wide_bvh.h"

#include "accel/wide/wide_node.h"
#include "shaders/shared/bindings.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

namespace encore::accel {

namespace {

constexpr std::size_t kMostTriangles = std::size_t{1} << 28;

double half_area(const Bounds& box) {
  const double x = double(box.max.x) - double(box.min.x);
  const double y = double(box.max.y) - double(box.min.y);
  const double z = double(box.max.z) - double(box.min.z);
  return x * (y + z) + y * z;
}

/// BuildStats::sah_cost. A tree whose root has no area costs nothing: no random ray meets it.
double sah_cost(const WideTree& tree) {
  const double root = half_area({tree.min, tree.max});
  if (tree.nodes.empty() || !(root > 0.0)) return 0.0;
  double sum = root;
  for (const gpu::WideNode& node : tree.nodes.span()) {
    for (std::uint32_t i = 0; i < WideTree::kWidth; ++i) {
      const std::uint32_t child = node.child[i];
      if (child == WideChild::kNoChild) continue;
      const std::uint32_t weight =
          WideChild::is_leaf(child) ? leaf_references(tree.ids.data(), child) : 1;
      sum += half_area(child_bounds(node, i)) * double(weight);
    }
  }
  return sum / root;
}

/// Of the deepest leaf: one below the inner nodes, which alone the tree counts.
std::uint32_t leaf_depth(const WideTree& tree) {
  return tree.nodes.empty() ? 0 : tree.depth + 1;
}

std::uint64_t largest_leaf(const WideTree& tree) {
  std::uint32_t most = 0;
  for (const gpu::WideNode& node : tree.nodes.span()) {
    for (const std::uint32_t child : node.child) {
      if (child == WideChild::kNoChild || !WideChild::is_leaf(child)) continue;
      most = std::max(most, leaf_references(tree.ids.data(), child));
    }
  }
  return most;
}

}  // namespace

WideBvh::WideBvh(const BvhSettings& settings, MemoryMode memory)
    : settings_(settings),
      memory_(memory),
      single_(&wide_single_kernels(chosen_isa())),
      tiles_(&wide_tile_kernels(chosen_isa())),
      builder_(memory) {}

void WideBvh::build(std::span<const Triangle> triangles) {
  if (triangles.size() > kMostTriangles) {
    throw std::length_error("a wide hierarchy holds at most 268435456 triangles");
  }
  mark_changed();
  BuildMeter meter(build_watch());
  clear();
  if (triangles.empty()) return meter.finish();
  try {
    Workers workers(build_threads());
    workers.run(
        [&] { builder_.build(triangles, settings_.preset, workers, meter, tree_, allocations_); });
  } catch (...) {
    clear();
    throw;
  }
  triangles_ = triangles;
  meter.finish();
}

void WideBvh::clear() {
  triangles_ = {};
  allocations_ = {};
  built_cost_.reset();
  cost_.reset();
  refitted_ = false;
  AllocationCount none;
  tree_.nodes.reset(0, memory_, none);
  tree_.blocks.reset(0, memory_, none);
  tree_.ids.reset(0, memory_, none);
  tree_.min = tree_.max = gpu::vec3(0.0F);
  tree_.triangles = tree_.references = tree_.leaves = tree_.depth = 0;
}

void WideBvh::update(std::span<const Triangle> triangles) {
  if (triangles.size() != triangles_.size()) return build(triangles);
  mark_changed();
  triangles_ = triangles;
  allocations_ = {};
  refitted_ = true;
  cost_.reset();
  if (triangles.empty()) return;
  Workers workers(build_threads());
  workers.run([&] { builder_.refit(triangles, workers, tree_); });
}

void WideBvh::assess() {
  cost_ = sah_cost(tree_);
  if (!refitted_) built_cost_ = cost_;
}

std::optional<double> WideBvh::decay() const {
  if (!built_cost_ || !cost_) return std::nullopt;
  if (*built_cost_ > 0.0) return *cost_ / *built_cost_;
  // All was flat: as good as ever if it still is, else beyond comparison.
  return *cost_ > 0.0 ? std::numeric_limits<double>::infinity() : 1.0;
}

std::optional<double> WideBvh::assessed_cost() const {
  return cost_;
}

bool WideBvh::decayed() const {
  const std::optional<double> now = decay();
  return !now || *now >= double(settings_.rebuild_at);
}

WideView WideBvh::view() const {
  return {tree_.nodes.data(), tree_.blocks.data(), tree_.ids.data(),
          static_cast<std::uint32_t>(tree_.nodes.size())};
}

void WideBvh::intersect(std::span<const Ray> rays, std::span<Hit> hits) const {
  single_->intersect[static_cast<std::size_t>(intersection())](
      view(), triangles_.data(), rays.data(), rays.size(), hits.data());
}

void WideBvh::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  single_->occluded[static_cast<std::size_t>(intersection())](
      view(), triangles_.data(), rays.data(), rays.size(), blocked.data());
}

void WideBvh::intersect_together(std::span<const Ray> rays, std::size_t width,
                                 std::span<Hit> hits) const {
  if (rays.empty()) return;
  tiles_->intersect[static_cast<std::size_t>(intersection())](
      view(), triangles_.data(), rays.data(), width, rays.size() / width, hits.data());
}

void WideBvh::occluded_together(std::span<const Ray> rays, std::size_t width,
                                std::span<std::uint8_t> blocked) const {
  if (rays.empty()) return;
  tiles_->occluded[static_cast<std::size_t>(intersection())](
      view(), triangles_.data(), rays.data(), width, rays.size() / width, blocked.data());
}

BuildStats WideBvh::stats() const {
  BuildStats stats;
  stats.triangles = tree_.triangles;
  stats.allocations = allocations_.requests;
  stats.allocated_bytes = allocations_.bytes;
  stats.nodes = tree_.nodes.size() + tree_.leaves;
  stats.leaves = tree_.leaves;
  stats.references = tree_.references;
  stats.max_depth = leaf_depth(tree_);
  stats.largest_leaf = largest_leaf(tree_);
  stats.bytes = tree_.nodes.bytes().size() + tree_.blocks.bytes().size() + tree_.ids.bytes().size();
  stats.sah_cost = sah_cost(tree_);
  return stats;
}

GpuBuffers WideBvh::gpu_buffers() const {
  return {{ENCORE_BINDING_NODES, tree_.nodes.bytes()},
          {ENCORE_BINDING_REFERENCES, tree_.ids.bytes()}};
}

gpu::StructureParameters WideBvh::gpu_parameters() const {
  gpu::StructureParameters parameters{};
  if (triangles_.empty()) return parameters;
  parameters.min = tree_.min;
  parameters.max = tree_.max;
  parameters.depth = leaf_depth(tree_);
  parameters.references = static_cast<std::uint32_t>(tree_.ids.size());
  return parameters;
}

void WideBvh::visit(const std::function<bool(const NodeView&)>& visitor) const {
  if (triangles_.empty()) return;
  struct Task {
    std::uint32_t child, depth;
    Bounds bounds;
  };
  std::array<Task, WideTree::kStackSize> waiting;
  std::uint32_t waiting_count = 0;
  waiting[waiting_count++] = {0, 0, {tree_.min, tree_.max}};
  while (waiting_count > 0) {
    const Task task = waiting[--waiting_count];
    NodeView view;
    view.bounds = task.bounds;
    view.depth = task.depth;
    view.leaf = WideChild::is_leaf(task.child);
    view.place = place(task.child);
    if (view.leaf) {
      view.triangles = {
          tree_.ids.data() + TriangleBlock::kSize * WideChild::first_block(task.child),
          leaf_references(tree_.ids.data(), task.child)};
    }
    if (!visitor(view) || view.leaf) continue;
    const gpu::WideNode& node = tree_.nodes[task.child];
    for (std::uint32_t i = WideTree::kWidth; i-- > 0;) {
      if (node.child[i] == WideChild::kNoChild) continue;
      waiting[waiting_count++] = {node.child[i], task.depth + 1, child_bounds(node, i)};
    }
  }
}

}  // namespace encore::accel
