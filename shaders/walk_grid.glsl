// The DDA proper: one cell after the other, each step across the next plane on the way (twin of
// walk() in accel/grid/grid_traverse.cpp and of GridWalk).
#include "box_hit.glsl"
#include "grid_cells.glsl"

// One axis of a walk.
struct WalkAxis {
  float next_t;     // distance of the next plane; infinite if parallel to it
  float origin;
  float inverse;
  int plane;        // where the next plane is stored
  int direction;    // 1 or -1: where the plane after it is stored
  int stride;       // leads to the cell beyond it
  uint cells_left;  // further cells along this axis
};

// Whether planes of the same axis can be told apart up to the distance `leave`.
bool planes_apart(BoxRay ray, float leave) {
  for (int axis = 0; axis < 3; ++axis) {
    if (structure.cells[axis] > 1u && !ray.parallel[axis] &&
        structure.smallest_gap[axis] * abs(ray.inverse[axis]) <=
            8.0 * ENCORE_PLANE_SLACK * leave) {
      return false;
    }
  }
  return true;
}

float plane_t(WalkAxis axis) {
  precise float t = (cell_planes[axis.plane] - axis.origin) * axis.inverse;
  return t;
}

bool certainly_behind(uint plane, float origin, float inverse, float earliest) {
  precise float t = (cell_planes[plane] - origin) * inverse;
  return t * kWiden < earliest;
}

// The state along one axis in the first cell that the ray can possibly be in at `enter`; adds that
// cell's part to `cell`.
WalkAxis start_axis(int axis, Ray ray, BoxRay box_ray, float enter, inout uint cell) {
  uint planes = first_plane(axis);
  uint last = structure.cells[axis] - 1u;
  uint stride = cell_stride(axis);
  float origin = ray.origin[axis];
  WalkAxis a;
  a.origin = origin;
  a.inverse = box_ray.inverse[axis];
  if (box_ray.parallel[axis]) {
    // The ray stays in one cell; inside a plane that is the cell above it, to which all triangles
    // that touch the plane belong.
    cell += cell_of(axis, origin) * stride;
    a.next_t = kInfinity;
    a.plane = int(planes);
    a.direction = 0;
    a.stride = 0;
    a.cells_left = 0u;
    return a;
  }

  // Start from a guess and correct it until the cell's own exit is not certainly behind, but the
  // exit of the cell before it is.
  float earliest = enter * kNarrow;
  uint i = cell_of(axis, origin + ray.direction[axis] * enter);
  if (ray.direction[axis] > 0.0) {
    while (i > 0u && !certainly_behind(planes + i, origin, a.inverse, earliest)) {
      ENCORE_SPEND;
      --i;
    }
    while (i < last && certainly_behind(planes + i + 1u, origin, a.inverse, earliest)) {
      ENCORE_SPEND;
      ++i;
    }
    a.plane = int(planes + i + 1u);
    a.direction = 1;
    a.stride = int(stride);
    a.cells_left = last - i;
  } else {
    while (i < last && !certainly_behind(planes + i + 1u, origin, a.inverse, earliest)) {
      ENCORE_SPEND;
      ++i;
    }
    while (i > 0u && certainly_behind(planes + i, origin, a.inverse, earliest)) {
      ENCORE_SPEND;
      --i;
    }
    a.plane = int(planes + i);
    a.direction = -1;
    a.stride = -int(stride);
    a.cells_left = i;
  }
  a.next_t = plane_t(a);
  cell += i * stride;
  return a;
}

// Crosses the next plane of an axis; false if that leaves the grid.
bool cross_plane(inout WalkAxis axis, inout uint cell) {
  if (axis.cells_left == 0u) return false;
  --axis.cells_left;
  cell = uint(int(cell) + axis.stride);
  axis.plane += axis.direction;
  axis.next_t = plane_t(axis);
  return true;
}

uint walk_cell;
WalkAxis walk_x;
WalkAxis walk_y;
WalkAxis walk_z;
uint walk_subset;  // 0: in walk_cell; else the next of the cells between, see walk()

void start_walk(Ray ray, BoxRay box_ray, float enter) {
  walk_cell = 0u;
  walk_subset = 0u;
  walk_x = start_axis(0, ray, box_ray, enter, walk_cell);
  walk_y = start_axis(1, ray, box_ray, enter, walk_cell);
  walk_z = start_axis(2, ray, box_ray, enter, walk_cell);
  enter_cell(walk_cell);
}

// Crosses the next plane of an axis into the cell behind it; false if that leaves the grid or
// everything beyond is farther away than the best hit.
bool cross_single(inout WalkAxis axis, float best) {
  if (axis.next_t * kNarrow > best || !cross_plane(axis, walk_cell)) return false;
  enter_cell(walk_cell);
  return true;
}

// Several planes are met at once as far as rounding can tell, so the ray may pass through any cell
// between walk_cell and the one beyond all of those planes: enters those in between, one a call,
// the one beyond too if the ray leaves the grid; then goes on beyond. False when the walk is over.
bool cross_together(float best) {
  // Those tied with the nearest, and one tied with any of those.
  float tx = walk_x.next_t;
  float ty = walk_y.next_t;
  float tz = walk_z.next_t;
  float nearest = min(tx, min(ty, tz));
  if (walk_subset == 0u && (nearest * kNarrow > best || nearest > kLargestFloat)) return false;
  float limit = nearest * kWiden;
  float middle = max(min(tx, ty), min(max(tx, ty), tz));
  if (middle <= limit) limit = middle * kWiden;
  bvec3 at = lessThanEqual(vec3(tx, ty, tz), vec3(limit));
  bvec3 last = equal(uvec3(walk_x.cells_left, walk_y.cells_left, walk_z.cells_left), uvec3(0u));
  bool leaving = (at.x && last.x) || (at.y && last.y) || (at.z && last.z);
  uint movable = (at.x && !last.x ? 1u : 0u) | (at.y && !last.y ? 2u : 0u) |
                 (at.z && !last.z ? 4u : 0u);

  for (++walk_subset; walk_subset < 8u; ++walk_subset) {
    if ((walk_subset & ~movable) != 0u || (walk_subset == movable && !leaving)) continue;
    int between = int(walk_cell) + ((walk_subset & 1u) != 0u ? walk_x.stride : 0) +
                  ((walk_subset & 2u) != 0u ? walk_y.stride : 0) +
                  ((walk_subset & 4u) != 0u ? walk_z.stride : 0);
    enter_cell(uint(between));
    return true;
  }
  if (leaving) return false;
  walk_subset = 0u;
  if (at.x) cross_plane(walk_x, walk_cell);
  if (at.y) cross_plane(walk_y, walk_cell);
  if (at.z) cross_plane(walk_z, walk_cell);
  enter_cell(walk_cell);
  return true;
}

// True when the walk is over, false if it paused.
bool walk(Ray ray, PreparedRay prepared, inout Hit hit) {
  bool inside = true;
  while (inside) {
    if (!finish_cell(ray, prepared, hit)) return false;
    ENCORE_END_IF_HIT;
    ENCORE_PAUSE_IF_SPENT;
    ENCORE_SPEND;
    // The common case: one plane is certainly the next.
    float tx = walk_x.next_t;
    float ty = walk_y.next_t;
    float tz = walk_z.next_t;
    float best = reach(hit.t);
    if (walk_subset != 0u) {
      inside = cross_together(best);
    } else if (tx * kWiden < min(ty, tz)) {
      inside = cross_single(walk_x, best);
    } else if (ty * kWiden < min(tx, tz)) {
      inside = cross_single(walk_y, best);
    } else if (tz * kWiden < min(tx, ty)) {
      inside = cross_single(walk_z, best);
    } else {
      inside = cross_together(best);
    }
  }
  return true;
}
