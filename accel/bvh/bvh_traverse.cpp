#include "accel/bvh/bvh.h"
#include "accel/bvh/two_boxes.h"
#include "accel/triangle_tester.h"

#include <array>
#include <limits>

namespace encore::accel {

namespace {

// Where the ray leaves a node's box is not kept.
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

}  // namespace

template <bool AnyHit, class Tester, class Counter>
void Bvh::trace(const Ray& ray, Hit& hit, Counter& counter) const {
  if (triangles_.empty()) return;
  const gpu::BvhNode* const nodes = root();
  const Triangle* const triangles = triangles_.data();
  const Tester tester(ray);
  if (nodes->count != 0) {
    counter.node(place(nodes->first, 1), ray.t_min, kUnknown);
    counter.triangle(triangles, nodes->first, hit);
    tester.test(triangles, nodes->first, hit);
    return;
  }

  /// A node still to be visited, and where the ray enters its box.
  struct Waiting {
    float enter;
    std::uint32_t first, count;
  };
  // Each level of the path to the current node leaves at most one child waiting. The root's own box
  // is not tested: its children's are, in one go.
  std::array<Waiting, kMaxDepth + 1> waiting;
  std::uint32_t waiting_count = 0;
  const TwoBoxRay<FourFloats> box_ray(ray);
  std::uint32_t first = nodes->first;
  std::uint32_t count = 0;
  float enter = ray.t_min;  // of the current node; only told to the counter
  for (;;) {
    counter.node(place(first, count), enter, kUnknown);
    if (count == 0) {
      // Inner node: go on with the child that the ray enters first, let the other one wait. Which
      // one is left to the branch predictor on purpose: choosing without branches makes the load
      // of the next node wait for this test, which was measured to halve the speed.
      const gpu::BvhNode* const children = nodes + first;
      const TwoEntries entries = box_ray.test(children, Tester::reach(hit.t));
      const auto place_of = [this, children](int child) {
        return [=, this] { return place(children[child].first, children[child].count); };
      };
      counter.box(place_of(0), (entries.hits & 1U) != 0, entries.left);
      counter.box(place_of(1), (entries.hits & 2U) != 0, entries.right);
      const gpu::BvhNode* next = children;
      if (entries.hits == 3) {
        if (entries.right < entries.left) {
          waiting[waiting_count++] = {entries.left, children[0].first, children[0].count};
          next = children + 1;
        } else {
          waiting[waiting_count++] = {entries.right, children[1].first, children[1].count};
        }
      } else if (entries.hits == 2) {
        next = children + 1;
      }
      if (entries.hits != 0) {
        first = next->first;
        count = next->count;
        enter = next == children ? entries.left : entries.right;
        continue;
      }
    } else {
      counter.triangle(triangles, first, hit);
      if (tester.test(triangles, first, hit) && AnyHit) return;
    }
    // The next waiting node that begins before the best hit, or not certainly behind it.
    for (;;) {
      if (waiting_count == 0) return;
      --waiting_count;
      if (!(waiting[waiting_count].enter * kNarrow > Tester::reach(hit.t))) break;
      const Waiting& left_out = waiting[waiting_count];
      counter.skipped(place(left_out.first, left_out.count), left_out.enter, hit.t);
    }
    first = waiting[waiting_count].first;
    count = waiting[waiting_count].count;
    enter = waiting[waiting_count].enter;
  }
}

ENCORE_COMPILE_TRACE(Bvh)

}  // namespace encore::accel
