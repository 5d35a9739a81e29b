// Hierarchies of up to eight children a node (accel/wide/wide_tree.h): nearest child first, and
// nothing that begins behind the best hit (twin of accel/wide/wide_bvh_trace.cpp). The nodes are
// the very ones that the CPU walks, corners come from the scene.
//
// What waits takes two words a level, so that many rays fit on the device at once: a node, and the
// order of those of its children that are still to be visited. Where the ray enters the next of
// them is worked out again. ENCORE_STACK_SIZE is more than the depth of this very tree.
#include "wide_box_hit.glsl"
#include "counters.glsl"
#include "pausing.glsl"
#include "triangle_filter.glsl"

// accel/wide/wide_tree.h: WideChild, TriangleBlock.
const uint kWideNoChild = 0xFFFFFFFFu;
const uint kWideLeafBit = 0x80000000u;
const uint kWideBlockSize = 4u;

uint wide_child;  // the node or leaf in hand
int wide_waiting_count;
uint wide_waiting[ENCORE_STACK_SIZE];  // nodes
// How many of its children wait, above three bits for each of them, the nearest lowest.
uint wide_waiting_order[ENCORE_STACK_SIZE];
const int kWideOrderBits = 24;

void start_traversal(Ray ray) {
  wide_child = 0u;
  wide_waiting_count = 0;
}

// Pairs that are out of order change places.
void sort_pair(inout uint a, inout uint b) {
  uint larger = max(a, b);
  a = min(a, b);
  b = larger;
}

// Batcher's network for eight numbers.
void sort_wide_keys(inout uvec4 a, inout uvec4 b) {
  uvec4 larger = max(a, b);
  a = min(a, b);
  b = larger;
  sort_pair(a.x, a.z);
  sort_pair(a.y, a.w);
  sort_pair(b.x, b.z);
  sort_pair(b.y, b.w);
  sort_pair(a.z, b.x);
  sort_pair(a.w, b.y);
  sort_pair(a.x, a.y);
  sort_pair(a.z, a.w);
  sort_pair(b.x, b.y);
  sort_pair(b.z, b.w);
  sort_pair(a.y, b.x);
  sort_pair(a.w, b.z);
  sort_pair(a.y, a.z);
  sort_pair(a.w, b.x);
  sort_pair(b.y, b.z);
}

// The children of the node in hand that the ray meets, as wide_waiting_order has them.
uint wide_order(WideRay ray, float t_min, float farthest) {
  uint row = kWideNodeRows * wide_child;
  vec4 enter_a, enter_b;
  uvec4 hit_a = wide_stretch(row, ray, t_min, farthest, enter_a);
  uvec4 hit_b = wide_stretch(row + 1u, ray, t_min, farthest, enter_b);
  uvec4 there_a = uvec4(notEqual(node_rows[row + kWideChildRows], uvec4(kWideNoChild)));
  uvec4 there_b = uvec4(notEqual(node_rows[row + kWideChildRows + 1u], uvec4(kWideNoChild)));
  hit_a *= there_a;
  hit_b *= there_b;
  uvec4 sums = hit_a + hit_b;
  uint count = sums.x + sums.y + sums.z + sums.w;
#ifdef ENCORE_OUTPUT_COUNTERS
  sums = there_a + there_b;
  ENCORE_COUNT_BOX_TESTS(sums.x + sums.y + sums.z + sums.w);
#endif
  if (count == 0u) return 0u;
  // Bits of numbers that are not negative are ordered as these; the last three say which child.
  // Whoever is not met comes last.
  uvec4 a = (floatBitsToUint(enter_a) & 0x7FFFFFF8u) | uvec4(0u, 1u, 2u, 3u);
  uvec4 b = (floatBitsToUint(enter_b) & 0x7FFFFFF8u) | uvec4(4u, 5u, 6u, 7u);
  a |= hit_a - 1u;
  b |= hit_b - 1u;
  if (count == 1u) {
    uvec4 least = min(a, b);
    return (min(min(least.x, least.y), min(least.z, least.w)) & 7u) | 1u << kWideOrderBits;
  }
  sort_wide_keys(a, b);
  uvec4 low = (a & 7u) << uvec4(0u, 3u, 6u, 9u);
  uvec4 high = (b & 7u) << uvec4(12u, 15u, 18u, 21u);
  uvec4 both = low | high;
  return both.x | both.y | both.z | both.w | count << kWideOrderBits;
}

// Takes the first child of an order: the one in hand from now on. Returns the rest of it, 0 if
// there is none.
uint take_first(uint node, uint order) {
  uint first = order & 7u;
  wide_child = node_rows[kWideNodeRows * node + kWideChildRows + first / 4u][first % 4u];
  uint left = (order >> kWideOrderBits) - 1u;
  return left == 0u ? 0u : (order & 0xFFFFFFu) >> 3 | left << kWideOrderBits;
}

void test_wide_leaf(Ray ray, PreparedRay prepared, inout Hit hit) {
  uint first = kWideBlockSize * (wide_child & 0x0FFFFFFFu);
  uint end = first + kWideBlockSize * ((wide_child >> 28 & 7u) + 1u);
  uint before = kNoHit;
  for (uint place = first; place < end; ++place) {
    ENCORE_SPEND;
    // The last triangle is repeated until the last block is full.
    uint triangle = references[place];
    if (triangle == before) return;
    before = triangle;
    ENCORE_COUNT_TRIANGLE_TESTS(1u);
    test_triangle(ray, prepared, triangle, hit);
#ifdef ENCORE_ANY_HIT
    if (hit.triangle != kNoHit) return;
#endif
  }
}

// Goes on from where the traversal stands; true when it is over, false if it paused.
bool traverse(Ray ray, inout Hit hit) {
  if (structure.references == 0u) return true;
  PreparedRay prepared = prepare_ray(ray);
  WideRay wide_ray = make_wide_ray(ray);
  for (;;) {
    ENCORE_PAUSE_IF_SPENT;
    ENCORE_SPEND;
    ENCORE_COUNT_STEP;
    bool next = false;
    if ((wide_child & kWideLeafBit) == 0u) {
      uint node = wide_child;
      uint order = wide_order(wide_ray, ray.t_min, reach(hit.t));
      if (order != 0u) {
        uint rest = take_first(node, order);
        if (rest != 0u) {
          wide_waiting[wide_waiting_count] = node;
          wide_waiting_order[wide_waiting_count] = rest;
          ++wide_waiting_count;
        }
        next = true;
      }
    } else {
      test_wide_leaf(ray, prepared, hit);
      ENCORE_END_IF_HIT;
    }
    // Else the next waiting child. Where it certainly begins behind the best hit, so do those after
    // it: they are in order but for the last three bits, which the second factor allows for.
    while (!next) {
      if (wide_waiting_count == 0) return true;
      ENCORE_SPEND;
      --wide_waiting_count;
      uint node = wide_waiting[wide_waiting_count];
      uint order = wide_waiting_order[wide_waiting_count];
      float enter = wide_enter(node, order & 7u, wide_ray, ray.t_min);
      next = enter * kNarrow * kNarrow <= reach(hit.t);
      if (next) {
        uint rest = take_first(node, order);
        if (rest != 0u) wide_waiting_order[wide_waiting_count++] = rest;
      }
    }
  }
}

#ifdef ENCORE_RESUMABLE
// How many words of its slot a paused traversal uses, at most.
void store_traversal(uint place) {
  paused_rays[place] = wide_child;
  paused_rays[place + 1u] = uint(wide_waiting_count);
  for (int i = 0; i < wide_waiting_count; ++i) {
    paused_rays[place + 2u + 2u * uint(i)] = wide_waiting[i];
    paused_rays[place + 3u + 2u * uint(i)] = wide_waiting_order[i];
  }
}
void load_traversal(uint place, Ray ray) {
  wide_child = paused_rays[place];
  wide_waiting_count = int(paused_rays[place + 1u]);
  for (int i = 0; i < wide_waiting_count; ++i) {
    wide_waiting[i] = paused_rays[place + 2u + 2u * uint(i)];
    wide_waiting_order[i] = paused_rays[place + 3u + 2u * uint(i)];
  }
}
#endif
