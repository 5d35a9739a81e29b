// Uniform grids by a three-dimensional DDA (Amanatides and Woo 1987; twin of
// accel/grid/grid_traverse.cpp and grid_walk.cpp, which say why each step is safe). Runs until the
// ray leaves the grid: there is no limit on steps.
#include "box_hit.glsl"
#include "counters.glsl"
#include "pausing.glsl"
#include "triangle_filter.glsl"
#include "walk_grid.glsl"
#include "walk_grid_thick.glsl"

const uint kGridMissed = 0u;
const uint kGridWalk = 1u;
const uint kGridThick = 2u;
uint grid_mode;

void start_traversal(Ray ray) {
  grid_mode = kGridThick;
  BoxRay box_ray = make_box_ray(ray);
  start_thick();
  if (structure.references == 0u || any(box_ray.untimed)) return;
  float enter, leave;
  if (!box_stretch(structure.min, structure.max, box_ray, ray.t_min, ray.t_max, enter, leave) ||
      enter > kLargestFloat) {
    grid_mode = kGridMissed;
  } else if (planes_apart(box_ray, leave)) {
    grid_mode = kGridWalk;
    start_walk(ray, box_ray, enter);
  }
}

// Goes on from where the traversal stands; true when it is over, false if it paused.
bool traverse(Ray ray, inout Hit hit) {
  if (structure.references == 0u || grid_mode == kGridMissed) return true;
  PreparedRay prepared = prepare_ray(ray);
  if (grid_mode == kGridWalk) return walk(ray, prepared, hit);
  return walk_thick(ray, prepared, make_box_ray(ray), hit);
}

#ifdef ENCORE_RESUMABLE
void store_axis(uint place, WalkAxis axis) {
  paused_rays[place] = uint(axis.plane);
  paused_rays[place + 1u] = uint(axis.direction);
  paused_rays[place + 2u] = uint(axis.stride);
  paused_rays[place + 3u] = axis.cells_left;
  paused_rays[place + 4u] = floatBitsToUint(axis.next_t);
}
// What follows from the ray alone is not stored.
WalkAxis load_axis(uint place, float origin, float inverse) {
  return WalkAxis(uintBitsToFloat(paused_rays[place + 4u]), origin, inverse,
                  int(paused_rays[place]), int(paused_rays[place + 1u]),
                  int(paused_rays[place + 2u]), paused_rays[place + 3u]);
}
void store_traversal(uint place) {
  paused_rays[place] = grid_mode;
  paused_rays[place + 1u] = cell_reference;
  paused_rays[place + 2u] = cell_reference_end;
  if (grid_mode == kGridWalk) {
    paused_rays[place + 3u] = walk_cell;
    paused_rays[place + 4u] = walk_subset;
    store_axis(place + 5u, walk_x);
    store_axis(place + 10u, walk_y);
    store_axis(place + 15u, walk_z);
  } else {
    paused_rays[place + 3u] = thick_slab;
    paused_rays[place + 4u] = thick_js.x;
    paused_rays[place + 5u] = thick_js.y;
    paused_rays[place + 6u] = thick_ks.x;
    paused_rays[place + 7u] = thick_ks.y;
    paused_rays[place + 8u] = thick_next.x;
    paused_rays[place + 9u] = thick_next.y;
  }
}
void load_traversal(uint place, Ray ray) {
  grid_mode = paused_rays[place];
  cell_reference = paused_rays[place + 1u];
  cell_reference_end = paused_rays[place + 2u];
  if (grid_mode == kGridWalk) {
    vec3 inverse = make_box_ray(ray).inverse;
    walk_cell = paused_rays[place + 3u];
    walk_subset = paused_rays[place + 4u];
    walk_x = load_axis(place + 5u, ray.origin.x, inverse.x);
    walk_y = load_axis(place + 10u, ray.origin.y, inverse.y);
    walk_z = load_axis(place + 15u, ray.origin.z, inverse.z);
  } else {
    thick_slab = paused_rays[place + 3u];
    thick_js = uvec2(paused_rays[place + 4u], paused_rays[place + 5u]);
    thick_ks = uvec2(paused_rays[place + 6u], paused_rays[place + 7u]);
    thick_next = uvec2(paused_rays[place + 8u], paused_rays[place + 9u]);
  }
}
#endif
