#include "accel/brute_force.h"

#include "accel/triangle_tester.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace encore::accel {

template <bool AnyHit, class Tester, class Counter>
void BruteForce::trace(const Ray& ray, Hit& hit, Counter& counter) const {
  const Tester tester(ray);
  counter.node(0, ray.t_min, ray.t_max);
  constexpr std::uint32_t kBatch = 64;
  std::array<std::uint32_t, kBatch> references;
  const auto count = static_cast<std::uint32_t>(triangles_.size());
  for (std::uint32_t first = 0; first < count; first += kBatch) {
    const std::uint32_t n = std::min(kBatch, count - first);
    std::iota(references.begin(), references.begin() + n, first);
    counter.triangles(triangles_.data(), references.data(), n, hit);
    if (tester.test(triangles_.data(), references.data(), n, hit) && AnyHit) return;
  }
}

BuildStats BruteForce::stats() const {
  BuildStats stats;
  stats.triangles = stats.references = stats.largest_leaf = triangles_.size();
  stats.leaves = 1;
  stats.empty_leaves = triangles_.empty() ? 1 : 0;
  stats.sah_cost = static_cast<double>(triangles_.size());
  return stats;
}

void BruteForce::visit(const std::function<bool(const NodeView&)>& visitor) const {
  std::vector<std::uint32_t> all(triangles_.size());
  std::iota(all.begin(), all.end(), 0U);
  Bounds bounds;
  for (const Triangle& t : triangles_) bounds.extend(scene::bounds_of(t));
  visitor(NodeView{.bounds = bounds, .depth = 0, .leaf = true, .triangles = all});
}

ENCORE_COMPILE_TRACE(BruteForce)

}  // namespace encore::accel
