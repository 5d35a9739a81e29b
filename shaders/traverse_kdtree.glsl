// kd-trees, front to back (twin of accel/kdtree/kdtree_traverse.cpp, which says why a side may be
// passed over and why both are visited in doubt). A stack instead of restarts: every node is
// visited once, and ENCORE_STACK_SIZE is more than the depth of this very tree, so no depth is too
// great.
#include "box_hit.glsl"
#include "counters.glsl"
#include "pausing.glsl"
#include "triangle_filter.glsl"

const uint kKdLeafTag = 3u;

uint kd_index;  // the subtree to enter next, and the ray's stretch inside it
float kd_enter;
float kd_leave;
uint kd_reference;  // what is left of the leaf that the ray is in
uint kd_reference_end;
bool kd_in_leaf;
int kd_waiting_count;
float kd_waiting_enter[ENCORE_STACK_SIZE];
float kd_waiting_leave[ENCORE_STACK_SIZE];
uint kd_waiting[ENCORE_STACK_SIZE];

void start_traversal(Ray ray) {
  kd_index = 0u;
  kd_waiting_count = 0;
  kd_reference = 0u;
  kd_reference_end = 0u;
  BoxRay box_ray = make_box_ray(ray);
  // A ray that misses the box is as one that has left an empty leaf, with nothing waiting.
  kd_in_leaf = !box_stretch(structure.min, structure.max, box_ray, ray.t_min, ray.t_max, kd_enter,
                            kd_leave);
}

// The distance of a node's plane; `both` if the ray runs inside it or cannot be timed: then both
// sides are visited with the whole stretch.
float kd_plane_t(BoxRay ray, uint axis, float position, out bool both) {
  float offset = position - ray.origin[axis];
  both = false;
  if (ray.plain || !(ray.parallel[axis] || ray.untimed[axis])) {
    precise float t = offset * ray.inverse[axis];
    return t;
  }
  both = ray.untimed[axis] || offset == 0.0;
  return offset > 0.0 ? kInfinity : -kInfinity;
}

// Goes down to a leaf, near side first.
void kd_descend(BoxRay ray, bvec3 negative) {
  KdNode node = nodes[kd_index];
  ENCORE_COUNT_STEP;
  while ((node.flags & 3u) != kKdLeafTag) {
    ENCORE_SPEND;
    uint axis = node.flags & 3u;
    bool both;
    float t = kd_plane_t(ray, axis, uintBitsToFloat(node.data), both);
    uint near = negative[axis] ? node.flags >> 2 : kd_index + 1u;
    uint far = negative[axis] ? kd_index + 1u : node.flags >> 2;
    if (!both && t * kNarrow > kd_leave) {
      kd_index = near;
    } else if (!both && t * kWiden < kd_enter) {
      kd_index = far;
    } else {
      kd_waiting[kd_waiting_count] = far;
      kd_waiting_enter[kd_waiting_count] = !both && t > kd_enter ? t : kd_enter;
      kd_waiting_leave[kd_waiting_count] = kd_leave;
      ++kd_waiting_count;
      kd_leave = !both && t < kd_leave ? t : kd_leave;
      kd_index = near;
    }
    node = nodes[kd_index];
    ENCORE_COUNT_STEP;
  }
  uint count = node.flags >> 2;
  ENCORE_COUNT_TRIANGLE_TESTS(count);
  kd_reference = node.data;
  kd_reference_end = node.data + count;
}

// Goes on from where the traversal stands; true when it is over, false if it paused.
bool traverse(Ray ray, inout Hit hit) {
  if (structure.references == 0u) return true;
  BoxRay box_ray = make_box_ray(ray);
  PreparedRay prepared = prepare_ray(ray);
  // A parallel ray of direction -0 takes its sides as one of +0 does; kd_plane_t() knows neither.
  bvec3 negative = lessThan(ray.direction, vec3(0.0));
  for (;;) {
    if (!kd_in_leaf) kd_descend(box_ray, negative);
    kd_in_leaf = true;
    while (kd_reference < kd_reference_end) {
      ENCORE_PAUSE_IF_SPENT;
      ENCORE_SPEND;
      test_triangle(ray, prepared, references[kd_reference], hit);
      ENCORE_END_IF_HIT;
      ++kd_reference;
    }
    ENCORE_PAUSE_IF_SPENT;

    // Take the next node that does not begin beyond the best hit; at equal distance it is taken, as
    // a triangle of lower index may lie in it.
    do {
      if (kd_waiting_count == 0) return true;
      ENCORE_SPEND;
      --kd_waiting_count;
    } while (kd_waiting_enter[kd_waiting_count] * kNarrow > reach(hit.t));
    kd_index = kd_waiting[kd_waiting_count];
    kd_enter = kd_waiting_enter[kd_waiting_count];
    kd_leave = kd_waiting_leave[kd_waiting_count];
    kd_in_leaf = false;
  }
}

#ifdef ENCORE_RESUMABLE
// A traversal pauses in a leaf only, where index and stretch no longer matter.
void store_traversal(uint place) {
  paused_rays[place] = kd_reference;
  paused_rays[place + 1u] = kd_reference_end;
  paused_rays[place + 2u] = uint(kd_waiting_count);
  for (int i = 0; i < kd_waiting_count; ++i) {
    uint at = place + 3u + 3u * uint(i);
    paused_rays[at] = kd_waiting[i];
    paused_rays[at + 1u] = floatBitsToUint(kd_waiting_enter[i]);
    paused_rays[at + 2u] = floatBitsToUint(kd_waiting_leave[i]);
  }
}
void load_traversal(uint place, Ray ray) {
  kd_in_leaf = true;
  kd_reference = paused_rays[place];
  kd_reference_end = paused_rays[place + 1u];
  kd_waiting_count = int(paused_rays[place + 2u]);
  for (int i = 0; i < kd_waiting_count; ++i) {
    uint at = place + 3u + 3u * uint(i);
    kd_waiting[i] = paused_rays[at];
    kd_waiting_enter[i] = uintBitsToFloat(paused_rays[at + 1u]);
    kd_waiting_leave[i] = uintBitsToFloat(paused_rays[at + 2u]);
  }
}
#endif
