#pragma once

#include "accel/box_hit.h"
#include "accel/grid/grid_layout.h"
#include "scene/ray.h"

#include <array>
#include <cstdint>
#include <utility>

namespace encore::accel {

/// Whether each direction component is 0 or has a plane_inverse(). Others (beyond about 1e38 or
/// below 1e-38) give no plane distances.
[[nodiscard]] bool invertible(const BoxRay& box_ray);

/// The start of a grid traversal (Amanatides and Woo 1987). Unlike the paper, plane distances are
/// not accumulated: each comes from the stored plane and the ray's own origin, and so has a
/// relative error of at most 1.5 ulp in the last cell as in the first.
struct GridWalk {
  struct Axis {
    float next_t;  ///< distance of the next plane; infinite if parallel to it
    float origin;
    float inverse;
    const float* plane;        ///< the next plane
    std::int32_t direction;    ///< 1 or -1: where the plane after it is stored
    std::int32_t stride;       ///< leads to the cell beyond it
    std::uint32_t cells_left;  ///< further cells along this axis
  };

  /// The state in the first cell that the ray can possibly be in at the distance `enter`. Where a
  /// plane is met at `enter`, as far as rounding can tell, that is the cell before it.
  GridWalk(const GridLayout& layout, const scene::Ray& ray, const BoxRay& box_ray, float enter);

  /// Whether planes of the same axis can be told apart up to the distance `leave`: ties are then
  /// between different axes only.
  [[nodiscard]] static bool planes_apart(const GridLayout& layout, const BoxRay& box_ray,
                                         float leave);

  std::uint32_t cell = 0;
  std::array<Axis, 3> axes;
};

/// One axis of a ray that is as thick as the rounding of its plane distances. Cells are numbered in
/// the order in which the ray meets them. Along an axis to which it is parallel, it stays in the
/// one cell; along one whose direction component cannot be inverted, it may be in any cell at any
/// time.
class ThickAxis {
 public:
  ThickAxis(const GridLayout& layout, const scene::Ray& ray, int axis);

  /// The cells [first, last) that can matter at all.
  [[nodiscard]] std::uint32_t first() const { return first_; }
  [[nodiscard]] std::uint32_t last() const { return last_; }
  /// Not after the ray enters, and not before it leaves the cell; -inf and inf if not known.
  [[nodiscard]] float enter(std::uint32_t cell) const;
  [[nodiscard]] float leave(std::uint32_t cell) const;
  /// The cells [first, last) that the ray can be in between two distances. Calls must come with
  /// ascending `enter`.
  std::pair<std::uint32_t, std::uint32_t> between(float enter, float leave);
  /// This axis' part of the cell's index.
  [[nodiscard]] std::uint32_t offset(std::uint32_t cell) const {
    return (forward_ ? cell : size_ - 1 - cell) * stride_;
  }
  /// Average distance between planes; infinite if not known.
  [[nodiscard]] float spacing() const { return spacing_; }

 private:
  [[nodiscard]] float plane_t(std::uint32_t plane) const {
    return (planes_[forward_ ? plane : size_ - plane] - origin_) * inverse_;
  }

  const float* planes_;
  std::uint32_t size_;
  std::uint32_t stride_;
  float origin_;
  float inverse_;
  float spacing_;
  bool forward_;
  bool timed_;  // plane distances are known
  std::uint32_t first_;
  std::uint32_t last_;
};

}  // namespace encore::accel
