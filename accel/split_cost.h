#pragma once

#include "accel/settings.h"
#include "scene/bounds.h"

#include <cstddef>

namespace encore::accel {

/// The surface area heuristic for splitting one box across one axis (MacDonald and Booth 1990; the
/// constants and the empty bonus of Pharr and Humphreys 2004): a split costs one step, and each
/// side's triangle tests times the chance that a ray through the box meets that side, which is the
/// quotient of the surface areas.
///
/// All in double, so that boxes of size 1e18 or 1e-18 neither overflow nor vanish. A box without
/// area (a line or a point) has its sides' lengths compared instead.
class SplitCost {
 public:
  SplitCost(const scene::Bounds& box, int axis, const KdTreeSettings& settings)
      : traversal_(settings.traversal_cost),
        intersection_(settings.intersection_cost),
        empty_factor_(1.0 - double(settings.empty_bonus)),
        lower_end_(box.min[axis]),
        upper_end_(box.max[axis]) {
    const int v = (axis + 1) % 3;
    const int w = (axis + 2) % 3;
    const double size_v = double(box.max[v]) - double(box.min[v]);
    const double size_w = double(box.max[w]) - double(box.min[w]);
    const double length = upper_end_ - lower_end_;
    // Half the area of a slice of this box is cap_ + rim_ * its length.
    cap_ = size_v * size_w;
    rim_ = size_v + size_w;
    if (cap_ + rim_ * length == 0.0) rim_ = 1.0;
    const double whole = cap_ + rim_ * length;
    per_area_ = whole > 0.0 ? 1.0 / whole : 0.0;
  }

  /// Cost of leaving `count` triangles unsplit.
  [[nodiscard]] double leaf(std::size_t count) const { return intersection_ * double(count); }

  /// Cost of splitting at `position`, which lies inside the box, into children of that many
  /// triangles.
  [[nodiscard]] double split(double position, std::size_t lower, std::size_t upper) const {
    const double factor = lower == 0 || upper == 0 ? empty_factor_ : 1.0;
    return traversal_ + intersection_ * per_area_ * factor * tests(position, lower, upper);
  }

 private:
  [[nodiscard]] double tests(double position, std::size_t lower, std::size_t upper) const {
    return double(lower) * (cap_ + rim_ * (position - lower_end_)) +
           double(upper) * (cap_ + rim_ * (upper_end_ - position));
  }

  double traversal_;
  double intersection_;
  double empty_factor_;
  double lower_end_;
  double upper_end_;
  double cap_;
  double rim_;
  double per_area_;
};

}  // namespace encore::accel
