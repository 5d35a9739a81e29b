// Where several planes of one axis are met at once as far as rounding can tell (the origin is far
// away, or the cells are very thin), the ray is as thick as the blur: slab by slab along one axis,
// every cell that the ray may pass through (twin of walk_thick() in accel/grid/grid_traverse.cpp
// and of ThickAxis).
#include "box_hit.glsl"
#include "grid_cells.glsl"

// One axis; cells are numbered in the order in which the ray meets them.
struct ThickAxis {
  uint planes;
  uint size;
  uint stride;
  float origin;
  float inverse;
  float spacing;  // average distance between planes; infinite if not known
  bool forward;
  bool timed;  // plane distances are known
  uint first;  // the cells [first, last) that can matter at all
  uint last;
};

float thick_plane_t(ThickAxis a, uint plane) {
  precise float t =
      (cell_planes[a.planes + (a.forward ? plane : a.size - plane)] - a.origin) * a.inverse;
  return t;
}
float thick_enter(ThickAxis a, uint cell) {
  return a.timed ? thick_plane_t(a, cell) * kNarrow : -kLargestFloat;
}
float thick_leave(ThickAxis a, uint cell) {
  return a.timed ? thick_plane_t(a, cell + 1u) * kWiden : kLargestFloat;
}
uint thick_offset(ThickAxis a, uint cell) {
  return (a.forward ? cell : a.size - 1u - cell) * a.stride;
}

ThickAxis thick_axis(int axis, Ray ray, BoxRay box_ray) {
  ThickAxis a;
  a.planes = first_plane(axis);
  a.size = structure.cells[axis];
  a.stride = cell_stride(axis);
  a.origin = ray.origin[axis];
  a.inverse = box_ray.inverse[axis];
  a.spacing = kInfinity;
  a.forward = !(ray.direction[axis] < 0.0);
  a.timed = !box_ray.parallel[axis] && !box_ray.untimed[axis];
  a.first = 0u;
  a.last = a.size;
  if (a.timed) {
    a.spacing = (thick_plane_t(a, a.size) - thick_plane_t(a, 0u)) / float(a.size);
  } else if (box_ray.parallel[axis]) {
    // Outside the box the ray never enters it.
    bool inside = a.origin >= structure.min[axis] && a.origin <= structure.max[axis];
    a.forward = true;
    a.first = inside ? cell_of(axis, a.origin) : 0u;
    a.last = inside ? a.first + 1u : 0u;
  }
  return a;
}

// The cells [result.x, result.y) that the ray can be in between two distances; calls must come with
// ascending `from`.
uvec2 thick_between(inout ThickAxis a, float from, float to) {
  while (a.first < a.last && thick_leave(a, a.first) < from) {
    ENCORE_SPEND;
    ++a.first;
  }
  uint last = a.first;
  while (last < a.last && thick_enter(a, last) <= to) {
    ENCORE_SPEND;
    ++last;
  }
  return uvec2(a.first, last);
}

uint thick_slab;  // the next one
uvec2 thick_js;   // the rows of the slab, [x, y)
uvec2 thick_ks;
uvec2 thick_next;  // the next cell of the slab: j, k

void start_thick() {
  thick_slab = 0u;
  thick_js = uvec2(0u);
  thick_ks = uvec2(0u);
  thick_next = uvec2(0u);
  cell_reference = 0u;
  cell_reference_end = 0u;
}

// True when the walk is over, false if it paused.
bool walk_thick(Ray ray, PreparedRay prepared, BoxRay box_ray, inout Hit hit) {
  ThickAxis a = thick_axis(0, ray, box_ray);
  ThickAxis b = thick_axis(1, ray, box_ray);
  ThickAxis c = thick_axis(2, ray, box_ray);
  // March along the axis whose planes follow each other most closely.
  if (b.spacing < a.spacing && !(c.spacing < b.spacing)) {
    ThickAxis x = a;
    a = b;
    b = x;
  } else if (c.spacing < a.spacing) {
    ThickAxis x = a;
    a = c;
    c = x;
  }

  thick_slab = max(thick_slab, a.first);
  for (;;) {
    if (!finish_cell(ray, prepared, hit)) return false;
    ENCORE_END_IF_HIT;
    ENCORE_PAUSE_IF_SPENT;
    ENCORE_SPEND;
    if (thick_next.x >= thick_js.y) {
      // The next row of the slab; after the last one the next slab.
      thick_next = uvec2(thick_js.x, thick_next.y + 1u);
      if (thick_next.y < thick_ks.y && thick_js.x < thick_js.y) continue;
      if (thick_slab >= a.last) return true;
      float enter = max(thick_enter(a, thick_slab), ray.t_min);
      float best = reach(hit.t);
      float leave = min(thick_leave(a, thick_slab), best);
      ++thick_slab;
      if (enter > best) return true;
      thick_js = uvec2(0u);
      thick_ks = uvec2(0u);
      if (leave >= enter) {
        thick_js = thick_between(b, enter, leave);
        thick_ks = thick_between(c, enter, leave);
        if (thick_ks.x >= thick_ks.y) thick_js = uvec2(0u);
      }
      thick_next = uvec2(thick_js.x, thick_ks.x);
      continue;
    }
    uint j = thick_next.x;
    uint k = thick_next.y;
    ++thick_next.x;
    if (max(thick_enter(b, j), thick_enter(c, k)) <= min(thick_leave(b, j), thick_leave(c, k))) {
      enter_cell(thick_offset(a, thick_slab - 1u) + thick_offset(b, j) + thick_offset(c, k));
    }
  }
}
