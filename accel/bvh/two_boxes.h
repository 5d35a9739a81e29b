#pragma once

#include "accel/box_hit.h"
#include "accel/bvh/four_floats.h"
#include "accel/tolerance.h"
#include "scene/ray.h"
#include "shaders/shared/gpu_types.h"

#include <limits>

namespace encore::accel {

/// 1 / component of a ray direction, for slab tests that take min and max of both planes' distances
/// instead of looking at the sign: +inf for either zero, so that a plane through the origin gives
/// 0 * inf = NaN and is dropped; else plane_inverse().
inline float slab_inverse(float component) {
  return component == 0.0F ? std::numeric_limits<float>::infinity() : plane_inverse(component);
}

/// Where a ray enters two boxes, and which of them it meets at all.
struct TwoEntries {
  float left;
  float right;
  unsigned hits;  ///< bit 0: left, bit 1: right
};

/// A ray prepared to be tested against the two children of a node at once. Decides as
/// box_stretch() of box_hit.h does, with the same widening (Ize 2013), for every ray whose
/// direction has no negative zeros; for those it is exact where box_stretch() is merely on the safe
/// side.
template <class F4>
class TwoBoxRay {
 public:
  explicit TwoBoxRay(const scene::Ray& ray)
      : origin_xy_(F4::of(ray.origin.x, ray.origin.x, ray.origin.y, ray.origin.y)),
        origin_z_(F4::all(ray.origin.z)),
        t_min_(F4::all(ray.t_min)) {
    const float x = slab_inverse(ray.direction.x);
    const float y = slab_inverse(ray.direction.y);
    inverse_xy_ = F4::of(x, x, y, y);
    inverse_z_ = F4::all(slab_inverse(ray.direction.z));
  }

  /// Tests children[0] and children[1] over [t_min, t_max].
  [[nodiscard]] TwoEntries test(const gpu::BvhNode* children, float t_max) const {
    const auto* words = reinterpret_cast<const char*>(children);
    const F4 left_min = F4::load(words);
    const F4 left_max = F4::load(words + 16);
    const F4 right_min = F4::load(words + 32);
    const F4 right_max = F4::load(words + 48);

    // Distances to all planes: x and y as (left x, right x, left y, right y), z as (left min,
    // right min, left max, right max). The nodes' integer members are shuffled out before any
    // arithmetic.
    const F4 lower_xy = (interleave_low(left_min, right_min) - origin_xy_) * inverse_xy_;
    const F4 upper_xy = (interleave_low(left_max, right_max) - origin_xy_) * inverse_xy_;
    const F4 lower_z =
        (low_halves(interleave_high(left_min, right_min), interleave_high(left_max, right_max)) -
         origin_z_) *
        inverse_z_;
    const F4 upper_z = high_half(lower_z);

    // The order of the operands matters: with an infinite inverse, a lower plane through the origin
    // must not constrain the entry (NaN), the upper one not the exit.
    const F4 near_xy = min(upper_xy, lower_xy);
    const F4 far_xy = max(lower_xy, upper_xy);
    const F4 near_z = min(upper_z, lower_z);
    const F4 far_z = max(lower_z, upper_z);
    const F4 enter = max(near_z, max(high_half(near_xy), max(near_xy, t_min_)));
    const F4 leave = min(far_z, min(high_half(far_xy), min(far_xy, F4::all(t_max))));
    const unsigned hits = less_equal(enter * F4::all(kNarrow), leave * F4::all(kWiden));
    return {enter.template get<0>(), enter.template get<1>(), hits & 3U};
  }

 private:
  F4 origin_xy_, inverse_xy_;
  F4 origin_z_, inverse_z_;
  F4 t_min_;
};

}  // namespace encore::accel
