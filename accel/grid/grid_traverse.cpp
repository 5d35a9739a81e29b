#include "accel/box_hit.h"
#include "accel/grid/grid.h"
#include "accel/grid/grid_walk.h"
#include "accel/tolerance.h"
#include "accel/triangle_tester.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace encore::accel {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Meets the triangles of cells on behalf of one ray.
template <bool AnyHit, class Tester, class Counter>
class CellVisitor {
 public:
  CellVisitor(const Triangle* triangles, const std::uint32_t* starts,
              const std::uint32_t* references, const Ray& ray, Hit& hit, Counter& counter)
      : triangles_(triangles),
        starts_(starts),
        references_(references),
        tester_(ray),
        hit_(hit),
        counter_(counter) {}

  // Tests a cell's triangles; true if the search is over.
  bool operator()(std::uint32_t cell) {
    counter_.node(cell);
    const std::uint32_t first = starts_[cell];
    const std::uint32_t count = starts_[cell + 1] - first;
    if (count == 0) return false;
    counter_.triangles(triangles_, references_ + first, count, hit_);
    const bool changed = tester_.test(triangles_, references_ + first, count, hit_);
    return AnyHit && changed;
  }
  // Nothing that begins behind this can matter any more.
  [[nodiscard]] float best() const { return Tester::reach(hit_.t); }

 private:
  const Triangle* triangles_;
  const std::uint32_t* starts_;
  const std::uint32_t* references_;
  Tester tester_;
  Hit& hit_;
  Counter& counter_;
};

// Several planes are met at once as far as rounding can tell, so the ray may pass through any cell
// between `cell` and the one beyond all of those planes: visits those in between, and the one
// beyond too if the ray leaves the grid. offsets[i] leads across plane i, 0 if that one is not met
// now or is the last of its axis. True if the search is over.
template <class Visitor>
__attribute__((noinline)) bool visit_between(Visitor& visit, std::uint32_t cell,
                                             std::array<std::int32_t, 3> offsets, bool leaving) {
  unsigned movable = 0;
  for (unsigned axis = 0; axis < 3; ++axis) movable |= (offsets[axis] != 0 ? 1U : 0U) << axis;
  for (unsigned subset = 1; subset < 8; ++subset) {
    if ((subset & ~movable) != 0 || (subset == movable && !leaving)) continue;
    std::uint32_t between = cell;
    for (unsigned axis = 0; axis < 3; ++axis) {
      if ((subset >> axis & 1U) != 0) between += static_cast<std::uint32_t>(offsets[axis]);
    }
    if (visit(between)) return true;
  }
  return false;
}

// The DDA proper: one cell after the other, each step across the next plane on the way. Planes of
// one axis must lie farther apart than rounding can blur (see GridWalk::planes_apart).
template <class Visitor>
void walk(const GridWalk& start, Visitor& visit) {
  std::uint32_t cell = start.cell;
  float tx = start.axes[0].next_t, ty = start.axes[1].next_t, tz = start.axes[2].next_t;
  GridWalk::Axis x = start.axes[0], y = start.axes[1], z = start.axes[2];

  // Crosses the next plane of an axis; false if that leaves the grid.
  const auto cross = [&cell](GridWalk::Axis& a, float& t) {
    if (a.cells_left == 0) return false;
    --a.cells_left;
    cell += static_cast<std::uint32_t>(a.stride);
    a.plane += a.direction;
    t = (*a.plane - a.origin) * a.inverse;
    return true;
  };

  while (true) {
    if (visit(cell)) return;
    const float best = visit.best();

    // The common case: one plane is certainly the next.
    const float wide_x = tx * kWiden, wide_y = ty * kWiden, wide_z = tz * kWiden;
    if (wide_x < ty && wide_x < tz) {
      // Everything beyond it is farther away than the best hit.
      if (tx * kNarrow > best || !cross(x, tx)) return;
      continue;
    }
    if (wide_y < tx && wide_y < tz) {
      if (ty * kNarrow > best || !cross(y, ty)) return;
      continue;
    }
    if (wide_z < tx && wide_z < ty) {
      if (tz * kNarrow > best || !cross(z, tz)) return;
      continue;
    }

    // Two or three are met at once: those tied with the nearest, and one tied with any of those.
    const float nearest = std::min({tx, ty, tz});
    if (nearest * kNarrow > best || nearest == kInfinity) return;
    float limit = nearest * kWiden;
    const float middle = std::max(std::min(tx, ty), std::min(std::max(tx, ty), tz));
    if (middle <= limit) limit = middle * kWiden;
    const bool at_x = tx <= limit, at_y = ty <= limit, at_z = tz <= limit;
    const bool leaving =
        (at_x && x.cells_left == 0) || (at_y && y.cells_left == 0) || (at_z && z.cells_left == 0);
    const std::array<std::int32_t, 3> offsets{at_x && x.cells_left != 0 ? x.stride : 0,
                                              at_y && y.cells_left != 0 ? y.stride : 0,
                                              at_z && z.cells_left != 0 ? z.stride : 0};
    if (visit_between(visit, cell, offsets, leaving) || leaving) return;
    if (at_x) cross(x, tx);
    if (at_y) cross(y, ty);
    if (at_z) cross(z, tz);
  }
}

// Where several planes of one axis are met at once as far as rounding can tell (the origin is far
// away, or the cells are very thin), the ray is as thick as the blur: goes slab by slab along one
// axis and visits every cell that the ray may pass through, in no particular order within a slab.
template <class Visitor>
void walk_thick(const GridLayout& layout, const Ray& ray, Visitor& visit) {
  std::array<ThickAxis, 3> axes{ThickAxis(layout, ray, 0), ThickAxis(layout, ray, 1),
                                ThickAxis(layout, ray, 2)};
  // March along the axis whose planes follow each other most closely.
  std::size_t marching = 0;
  for (std::size_t a = 1; a < 3; ++a) {
    if (axes[a].spacing() < axes[marching].spacing()) marching = a;
  }
  ThickAxis& a = axes[marching];
  ThickAxis& b = axes[(marching + 1) % 3];
  ThickAxis& c = axes[(marching + 2) % 3];

  for (std::uint32_t i = a.first(); i < a.last(); ++i) {
    const float enter = std::max(a.enter(i), ray.t_min);
    const float leave = std::min(a.leave(i), visit.best());
    if (enter > visit.best()) return;
    if (leave < enter) continue;
    const auto [b_first, b_last] = b.between(enter, leave);
    const auto [c_first, c_last] = c.between(enter, leave);
    for (std::uint32_t k = c_first; k < c_last; ++k) {
      for (std::uint32_t j = b_first; j < b_last; ++j) {
        if (std::max(b.enter(j), c.enter(k)) > std::min(b.leave(j), c.leave(k))) continue;
        if (visit(a.offset(i) + b.offset(j) + c.offset(k))) return;
      }
    }
  }
}

}  // namespace

template <bool AnyHit, class Tester, class Counter>
void Grid::trace(const Ray& ray, Hit& hit, Counter& counter) const {
  if (references_.empty()) return;
  CellVisitor<AnyHit, Tester, Counter> visit(triangles_.data(), cell_starts_.data(),
                                             references_.data(), ray, hit, counter);
  counter.cells([this](std::uint32_t cell) {
    const auto [x, y, z] = layout_.position(cell);
    return layout_.cell_bounds(x, y, z);
  });
  const BoxRay box_ray(ray);
  if (!invertible(box_ray)) return walk_thick(layout_, ray, visit);

  const Bounds bounds = layout_.bounds();
  const BoxStretch stretch = box_stretch(bounds.min, bounds.max, box_ray, ray.t_min, ray.t_max);
  const bool met = stretch.hit() && stretch.enter != kInfinity;
  counter.scene_box(met, stretch.enter, stretch.leave);
  if (!met) return;
  if (GridWalk::planes_apart(layout_, box_ray, stretch.leave)) {
    walk(GridWalk(layout_, ray, box_ray, stretch.enter), visit);
  } else {
    walk_thick(layout_, ray, visit);
  }
}

ENCORE_COMPILE_TRACE(Grid)

}  // namespace encore::accel
