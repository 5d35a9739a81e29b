#include "accel/bvh/bvh_quality.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace encore::accel {

namespace {

double half_area(const gpu::BvhNode& node) {
  const double x = double(node.max.x) - double(node.min.x);
  const double y = double(node.max.y) - double(node.min.y);
  const double z = double(node.max.z) - double(node.min.z);
  return x * (y + z) + y * z;
}

/// A step or a triangle test for every ray that meets the box. No branch: leaves come in no order.
double cost(const gpu::BvhNode& node) {
  return half_area(node) * double(node.count + std::uint32_t{node.count == 0});
}

/// Sum over the nodes. Four sums side by side, as one addition need not wait for the other.
double sum_of_costs(std::span<const gpu::BvhNode> nodes) {
  std::array<double, 4> sums{};
  std::size_t i = 0;
  for (; i + sums.size() <= nodes.size(); i += sums.size()) {
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += cost(nodes[i + k]);
  }
  for (; i < nodes.size(); ++i) sums[0] += cost(nodes[i]);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// Sum over the nodes of at least that area. A box is no larger than its parent's, so whatever is
/// below a smaller one need not be looked at.
double sum_of_large(std::span<const gpu::BvhNode> nodes, double area) {
  double sum = 0.0;
  std::vector<std::uint32_t> waiting{0};
  while (!waiting.empty()) {
    const gpu::BvhNode& node = nodes[waiting.back()];
    waiting.pop_back();
    if (half_area(node) < area) continue;
    sum += cost(node);
    if (node.count != 0) continue;
    waiting.push_back(node.first + 1);
    waiting.push_back(node.first);
  }
  return sum;
}

/// A box without area is met by no random ray: its cost stays 0.
double over_root(double sum, std::span<const gpu::BvhNode> nodes) {
  const double root = half_area(nodes.front());
  return root > 0.0 ? sum / root : 0.0;
}

}  // namespace

double bvh_sah_cost(std::span<const gpu::BvhNode> nodes) {
  return nodes.empty() ? 0.0 : over_root(sum_of_costs(nodes), nodes);
}

double bvh_sah_cost_sampled(std::span<const gpu::BvhNode> nodes) {
  constexpr std::size_t kWhole = 16384;
  constexpr std::size_t kStretch = 32;  // 1 KiB: memory likes neighbours
  constexpr std::size_t kStep = 256;
  if (nodes.size() <= kWhole) return bvh_sah_cost(nodes);
  const double large = half_area(nodes.front()) / 64.0;
  double rest = 0.0;
  for (std::size_t i = 0; i < nodes.size(); i += kStep) {
    for (const gpu::BvhNode& node : nodes.subspan(i, std::min(kStretch, nodes.size() - i))) {
      rest += half_area(node) < large ? cost(node) : 0.0;
    }
  }
  const double factor = static_cast<double>(kStep) / static_cast<double>(kStretch);
  return over_root(sum_of_large(nodes, large) + factor * rest, nodes);
}

void BvhQuality::assess(std::span<const gpu::BvhNode> nodes) {
  now_ = bvh_sah_cost_sampled(nodes);
  if (!refitted_) built_ = now_;
}

std::optional<double> BvhQuality::decay() const {
  if (!built_ || !now_) return std::nullopt;
  if (*built_ > 0.0) return *now_ / *built_;
  // All was flat: as good as ever if it still is, else beyond comparison.
  return *now_ > 0.0 ? std::numeric_limits<double>::infinity() : 1.0;
}

}  // namespace encore::accel
