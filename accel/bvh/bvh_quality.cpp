#include "accel/bvh/bvh_quality.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

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

}  // namespace

double bvh_sah_cost(std::span<const gpu::BvhNode> nodes) {
  if (nodes.empty()) return 0.0;
  // A box without area is met by no random ray: its cost stays 0. Four sums side by side, as one
  // addition need not wait for the other.
  std::array<double, 4> sums{};
  std::size_t i = 0;
  for (; i + sums.size() <= nodes.size(); i += sums.size()) {
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += cost(nodes[i + k]);
  }
  for (; i < nodes.size(); ++i) sums[0] += cost(nodes[i]);
  const double sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  const double root = half_area(nodes.front());
  return root > 0.0 ? sum / root : 0.0;
}

void BvhQuality::assess(std::span<const gpu::BvhNode> nodes) {
  now_ = bvh_sah_cost(nodes);
  if (!refitted_) built_ = now_;
}

std::optional<double> BvhQuality::decay() const {
  if (!built_ || !now_) return std::nullopt;
  if (*built_ > 0.0) return *now_ / *built_;
  // All was flat: as good as ever if it still is, else beyond comparison.
  return *now_ > 0.0 ? std::numeric_limits<double>::infinity() : 1.0;
}

}  // namespace encore::accel
