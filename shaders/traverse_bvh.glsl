// Bounding volume hierarchies: nearer child first, and nothing that begins behind the best hit
// (twin of accel/bvh/bvh_traverse.cpp). The nodes are the very ones that the CPU walks.
//
// ENCORE_STACK_SIZE is more than the depth of this very tree: one waiting child a level, so there
// is no depth at which the stack could overflow.
#include "box_hit.glsl"
#include "counters.glsl"
#include "pausing.glsl"
#include "triangle_filter.glsl"

uint bvh_node;
int bvh_waiting_count;
float bvh_waiting_enter[ENCORE_STACK_SIZE];
uint bvh_waiting[ENCORE_STACK_SIZE];

void start_traversal(Ray ray) {
  bvh_node = 0u;
  bvh_waiting_count = 0;
}

// Goes on from where the traversal stands; true when it is over, false if it paused.
bool traverse(Ray ray, inout Hit hit) {
  if (structure.references == 0u) return true;
  PreparedRay prepared = prepare_ray(ray);
  BoxRay box_ray = make_box_ray(ray);
  for (;;) {
    ENCORE_PAUSE_IF_SPENT;
    ENCORE_SPEND;
    ENCORE_COUNT_STEP;
    uint first = nodes[bvh_node].first;
    bool next = false;
    if (nodes[bvh_node].count == 0u) {
      // Inner node: go on with the child that the ray enters first, let the other one wait.
      ENCORE_COUNT_BOX_TESTS(2u);
      float left_enter, right_enter, leave;
      float farthest = reach(hit.t);
      bool left = box_stretch(nodes[first].min, nodes[first].max, box_ray, ray.t_min, farthest,
                              left_enter, leave);
      bool right = box_stretch(nodes[first + 1u].min, nodes[first + 1u].max, box_ray, ray.t_min,
                               farthest, right_enter, leave);
      bool right_first = right && (!left || right_enter < left_enter);
      if (left && right) {
        bvh_waiting_enter[bvh_waiting_count] = right_first ? left_enter : right_enter;
        bvh_waiting[bvh_waiting_count] = right_first ? first : first + 1u;
        ++bvh_waiting_count;
      }
      next = left || right;
      bvh_node = right_first ? first + 1u : first;
    } else {
      ENCORE_COUNT_TRIANGLE_TESTS(1u);
      test_triangle(ray, prepared, first, hit);
      ENCORE_END_IF_HIT;
    }
    // Else the next waiting node that begins before the best hit, or not certainly behind it.
    while (!next) {
      if (bvh_waiting_count == 0) return true;
      ENCORE_SPEND;
      --bvh_waiting_count;
      next = bvh_waiting_enter[bvh_waiting_count] * kNarrow <= reach(hit.t);
      bvh_node = bvh_waiting[bvh_waiting_count];
    }
  }
}

#ifdef ENCORE_RESUMABLE
// How many words of its slot a paused traversal uses, at most.
void store_traversal(uint place) {
  paused_rays[place] = bvh_node;
  paused_rays[place + 1u] = uint(bvh_waiting_count);
  for (int i = 0; i < bvh_waiting_count; ++i) {
    paused_rays[place + 2u + 2u * uint(i)] = floatBitsToUint(bvh_waiting_enter[i]);
    paused_rays[place + 3u + 2u * uint(i)] = bvh_waiting[i];
  }
}
void load_traversal(uint place, Ray ray) {
  bvh_node = paused_rays[place];
  bvh_waiting_count = int(paused_rays[place + 1u]);
  for (int i = 0; i < bvh_waiting_count; ++i) {
    bvh_waiting_enter[i] = uintBitsToFloat(paused_rays[place + 2u + 2u * uint(i)]);
    bvh_waiting[i] = paused_rays[place + 3u + 2u * uint(i)];
  }
}
#endif
