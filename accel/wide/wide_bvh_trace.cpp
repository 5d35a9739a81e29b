// What is counted and written down: the search of kernels/wide_single.cpp, one box after the other.
#include "accel/box_hit.h"
#include "accel/tolerance.h"
#include "accel/triangle_tester.h"
#include "accel/wide/wide_bvh.h"
#include "accel/wide/wide_node.h"

#include <algorithm>
#include <array>
#include <limits>

namespace encore::accel {

namespace {

// Where the ray leaves a node's box is not kept.
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// A node still to be visited, and where the ray enters its box.
struct Waiting {
  float enter;
  std::uint32_t child;
};

}  // namespace

template <class Tester, class Counter>
void WideBvh::trace(const Ray& ray, Hit& hit, Counter& counter) const {
  if (triangles_.empty()) return;
  const Tester tester(ray);
  const BoxRay box_ray(ray);
  std::array<Waiting, WideTree::kStackSize> waiting;
  std::uint32_t waiting_count = 0;
  waiting[waiting_count++] = {ray.t_min, 0};
  while (waiting_count > 0) {
    const Waiting next = waiting[--waiting_count];
    if (next.enter * kNarrow > Tester::reach(hit.t)) {
      counter.skipped(place(next.child), next.enter, hit.t);
      continue;
    }
    counter.node(place(next.child), next.enter, kUnknown);
    if (WideChild::is_leaf(next.child)) {
      const std::uint32_t* const references =
          tree_.ids.data() + TriangleBlock::kSize * WideChild::first_block(next.child);
      const std::uint32_t count = leaf_references(tree_.ids.data(), next.child);
      counter.triangles(triangles_.data(), references, count, hit);
      tester.test(triangles_.data(), references, count, hit);
      continue;
    }
    const gpu::WideNode& node = tree_.nodes[next.child];
    const std::uint32_t first = waiting_count;
    for (std::uint32_t i = 0; i < WideTree::kWidth; ++i) {
      if (node.child[i] == WideChild::kNoChild) continue;
      const Bounds box = child_bounds(node, i);
      const BoxStretch stretch =
          box_stretch(box.min, box.max, box_ray, ray.t_min, Tester::reach(hit.t));
      counter.box([&] { return place(node.child[i]); }, stretch.hit(), stretch.enter);
      if (stretch.hit()) waiting[waiting_count++] = {stretch.enter, node.child[i]};
    }
    // The nearest one comes last; of those at the same distance the first.
    std::stable_sort(waiting.begin() + first, waiting.begin() + waiting_count,
                     [](const Waiting& a, const Waiting& b) { return a.enter < b.enter; });
    std::reverse(waiting.begin() + first, waiting.begin() + waiting_count);
  }
}

void WideBvh::intersect_counted(std::span<const Ray> rays, std::span<Hit> hits,
                                std::span<TraceCounters> counters) const {
  with_tester(intersection(), [&]<class Tester>() {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits[i] = Hit{.t = rays[i].t_max};
      counters[i] = {};
      Counting counting{counters[i]};
      trace<Tester>(rays[i], hits[i], counting);
    }
  });
}

void WideBvh::trace_path(const Ray& ray, Hit& hit, RayPath& path) const {
  hit = Hit{.t = ray.t_max};
  Recording recording(ray, intersection(), path);
  with_tester(intersection(), [&]<class Tester>() { trace<Tester>(ray, hit, recording); });
  recording.end(hit);
}

}  // namespace encore::accel
