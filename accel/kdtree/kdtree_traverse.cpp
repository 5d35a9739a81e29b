#include "accel/box_hit.h"
#include "accel/kdtree/kd_node.h"
#include "accel/kdtree/kdtree.h"
#include "accel/tolerance.h"
#include "accel/triangle_tester.h"

namespace encore::accel {

namespace {

struct Waiting {
  std::uint32_t node;
  float enter;
  float leave;
};

}  // namespace

/// The stretch [enter, leave] of the ray inside a node is known to within the rounding of plane
/// distances. The side that the ray meets first ("near") follows from the direction's sign alone:
/// everything up to the plane's distance t is near, everything from there on is far, wherever the
/// origin lies. A side is passed over only if t lies outside the stretch by more than the slack.
///
/// A ray that runs inside the plane has t = 0 * inf = NaN, which fails all comparisons: both sides
/// are visited with the whole stretch; so are they along an axis without a plane_inverse(). A
/// parallel ray beside the plane has t = +-inf, which picks the origin's side; a plane behind the
/// origin has t < 0 <= enter, which picks the far side.
template <bool AnyHit, class Tester, class Counter>
void KdTree::trace(const Ray& ray, Hit& hit, Counter& counter) const {
  const BoxRay box_ray(ray);
  if (triangles_.empty()) return;
  const BoxStretch stretch = box_stretch(bounds_.min, bounds_.max, box_ray, ray.t_min, hit.t);
  counter.scene_box(stretch.hit(), stretch.enter, stretch.leave);
  if (!stretch.hit()) return;

  const Tester tester(ray);
  const gpu::KdNode* nodes = memory_.nodes.data();
  const std::uint32_t* references = memory_.references.data();
  Waiting waiting[kKdDepthCap + 1];
  std::uint32_t waiting_count = 0;
  std::uint32_t index = 0;
  float enter = stretch.enter;
  float leave = stretch.leave;
  for (;;) {
    // Go down to a leaf, near side first.
    gpu::KdNode node = nodes[index];
    std::uint32_t axis = kd_tag(node);
    counter.node(index, enter, leave);
    while (axis != kKdLeafTag) {
      const float t = (kd_position(node) - box_ray.origin[static_cast<int>(axis)]) *
                      box_ray.inverse[static_cast<int>(axis)];
      const bool negative = box_ray.negative[axis] != 0;
      const std::uint32_t near = negative ? kd_upper(node) : index + 1;
      const std::uint32_t far = negative ? index + 1 : kd_upper(node);
      if (t * kNarrow > leave) {
        counter.plane(index, t, PlaneSides::near);
        index = near;
      } else if (t * kWiden < enter) {
        counter.plane(index, t, PlaneSides::far);
        index = far;
      } else {
        counter.plane(index, t, PlaneSides::both);
        waiting[waiting_count++] = {far, t > enter ? t : enter, leave};
        leave = t < leave ? t : leave;
        index = near;
      }
      node = nodes[index];
      axis = kd_tag(node);
      counter.node(index, enter, leave);
    }

    const std::uint32_t count = kd_count(node);
    const std::uint32_t* const leaf = references + kd_first(node);
    counter.triangles(triangles_.data(), leaf, count, hit);
    if (tester.test(triangles_.data(), leaf, count, hit) && AnyHit) return;

    // Take the next node that does not begin beyond the best hit. At equal distance it is taken:
    // a triangle of lower index may lie in it.
    for (;;) {
      if (waiting_count == 0) return;
      --waiting_count;
      if (!(waiting[waiting_count].enter * kNarrow > Tester::reach(hit.t))) break;
      counter.skipped(waiting[waiting_count].node, waiting[waiting_count].enter, hit.t);
    }
    index = waiting[waiting_count].node;
    enter = waiting[waiting_count].enter;
    leave = waiting[waiting_count].leave;
  }
}

ENCORE_COMPILE_TRACE(KdTree)

}  // namespace encore::accel
