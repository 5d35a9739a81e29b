#include "accel/grid/grid_walk.h"

#include "accel/tolerance.h"

#include <cmath>
#include <limits>

namespace encore::accel {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

bool invertible(const BoxRay& box_ray) {
  return !std::isnan(box_ray.inverse.x) && !std::isnan(box_ray.inverse.y) &&
         !std::isnan(box_ray.inverse.z);
}

GridWalk::GridWalk(const GridLayout& layout, const scene::Ray& ray, const BoxRay& box_ray,
                   float enter) {
  const float earliest = enter * kNarrow;
  for (int axis = 0; axis < 3; ++axis) {
    const float* const planes = layout.planes(axis);
    const std::uint32_t last = layout.size(axis) - 1;
    const float origin = ray.origin[axis];
    const float inverse = box_ray.inverse[axis];
    const auto stride = static_cast<std::int32_t>(layout.stride(axis));
    Axis& a = axes[static_cast<std::size_t>(axis)];

    if (ray.direction[axis] == 0.0F) {
      // Parallel: the ray stays in one cell. Inside a plane that is the cell above it, to which all
      // triangles that touch the plane belong.
      cell += layout.cell_of(axis, origin) * layout.stride(axis);
      a = {kInfinity, origin, 0.0F, planes, 0, 0, 0};
      continue;
    }

    // Start from a guess and correct it until the cell's own exit is not certainly behind, but the
    // exit of the cell before it is.
    const auto certainly_behind = [&](std::uint32_t plane) {
      return (planes[plane] - origin) * inverse * kWiden < earliest;
    };
    std::uint32_t i = layout.cell_of(axis, origin + ray.direction[axis] * enter);
    if (box_ray.negative[axis] == 0) {
      while (i > 0 && !certainly_behind(i)) --i;
      while (i < last && certainly_behind(i + 1)) ++i;
      a = {0.0F, origin, inverse, planes + i + 1, 1, stride, last - i};
    } else {
      while (i < last && !certainly_behind(i + 1)) ++i;
      while (i > 0 && certainly_behind(i)) --i;
      a = {0.0F, origin, inverse, planes + i, -1, -stride, i};
    }
    a.next_t = (*a.plane - origin) * inverse;
    cell += i * layout.stride(axis);
  }
}

bool GridWalk::planes_apart(const GridLayout& layout, const BoxRay& box_ray, float leave) {
  for (int axis = 0; axis < 3; ++axis) {
    // Parallel axes have an infinite reciprocal (times 0: NaN) and pass; an axis with a single cell
    // has no plane to confuse with another.
    if (layout.size(axis) > 1 &&
        layout.smallest_gap(axis) * std::fabs(box_ray.inverse[axis]) <= 8 * kPlaneSlack * leave) {
      return false;
    }
  }
  return true;
}

ThickAxis::ThickAxis(const GridLayout& layout, const scene::Ray& ray, int axis)
    : planes_(layout.planes(axis)),
      size_(layout.size(axis)),
      stride_(layout.stride(axis)),
      origin_(ray.origin[axis]),
      inverse_(plane_inverse(ray.direction[axis])),
      spacing_(kInfinity),
      forward_(!std::signbit(ray.direction[axis])),
      timed_(std::isfinite(inverse_)),
      first_(0),
      last_(size_) {
  if (timed_) {
    spacing_ = (plane_t(size_) - plane_t(0)) / static_cast<float>(size_);
  } else if (ray.direction[axis] == 0.0F) {
    // Outside the box the ray never enters it.
    const bool inside = origin_ >= planes_[0] && origin_ <= planes_[size_];
    forward_ = true;
    first_ = inside ? layout.cell_of(axis, origin_) : 0;
    last_ = inside ? first_ + 1 : 0;
  }
}

float ThickAxis::enter(std::uint32_t cell) const {
  return timed_ ? plane_t(cell) * kNarrow : -kInfinity;
}

float ThickAxis::leave(std::uint32_t cell) const {
  return timed_ ? plane_t(cell + 1) * kWiden : kInfinity;
}

std::pair<std::uint32_t, std::uint32_t> ThickAxis::between(float from, float to) {
  while (first_ < last_ && leave(first_) < from) ++first_;
  std::uint32_t last = first_;
  while (last < last_ && enter(last) <= to) ++last;
  return {first_, last};
}

}  // namespace encore::accel
