#pragma once

#include "accel/simd/floats.h"
#include "accel/tolerance.h"
#include "scene/ray.h"
#include "shaders/shared/gpu_types.h"

#include <cstdint>

namespace encore::accel::ENCORE_ISA {

/// A ray against the eight boxes of a node (gpu::WideNode), which holds lower ends and turned upper
/// ends. An axis' near row are the lower ends, but for rays that go down the turned upper ends; its
/// far row is the other one. With the origin turned likewise, near planes' distances are
/// (row - origin) * near_factor, far planes' (row + origin) * far_factor.
///
/// The factors are 1 / |component| and -1 / |component|, narrowed and widened as accel/tolerance.h
/// says, so that near <= far decides. For a component of 0 both are infinite: planes before and
/// behind the origin give infinite distances, one through it gives NaN, which max() and min() drop.
/// Where the reciprocal leaves the normal range the factors keep it between them. So at least one
/// plane of an empty place in a node always excludes it.
class SlabRay {
 public:
  /// False for a ray whose origin or direction are no numbers: it hits nothing and must not be
  /// traced, as no comparison would keep it out of the empty places of a node.
  [[gnu::always_inline]] bool prepare(const scene::Ray& ray) {
    using F = Floats<4>;  // x, y, z and a number without meaning
    constexpr float kLargest = 0x1.fffffep+127F;
    constexpr float kSmallest = 0x1p-126F;
    const F origin = F::load(&ray.origin.x);
    const F direction = F::load(&ray.direction.x);
    const F zero = F::all(0.0F);
    const Mask<4> goes_down = direction < zero;
    const F size = abs(direction);
    const F inverse = F::all(1.0F) / size;
    const Mask<4> tiny = inverse < F::all(kSmallest);
    const Mask<4> huge = (inverse > F::all(kLargest)) & (size > zero);
    const F narrowed = select(huge, F::all(kLargest), inverse * F::all(kNarrow));
    select(tiny, zero, narrowed).store(near_factor_);
    select(tiny, F::all(-kSmallest), inverse * F::all(-kWiden)).store(far_factor_);
    select(goes_down, origin ^ F::all(-0.0F), origin).store(origin_);
    const unsigned down = goes_down.bits();
    for (unsigned axis = 0; axis < 3; ++axis) near_row_[axis] = 16 * axis + 8 * (down >> axis & 1U);
    start_ = ray.t_min * kNarrow + 0.0F;  // no -0 (child_order.h)
    const F no_number = (origin - origin) + (direction - direction);
    return ((no_number == zero).bits() & 7U) == 7U;
  }

  /// How far to go on from now on.
  [[gnu::always_inline]] void set_limit(float limit) { limit_ = limit; }
  [[gnu::always_inline]] float limit() const { return limit_; }

  /// Which children of the node may be met before the limit; enter says where.
  [[gnu::always_inline]] Mask<8> test(const gpu::WideNode& node, Floats<8>& enter) const {
    using F = Floats<8>;
    const Ends x = ends(node, 0), y = ends(node, 1), z = ends(node, 2);
    // Whatever may be NaN comes first, and is dropped.
    enter = max(x.near, max(y.near, max(z.near, F::all(start_))));
    return enter <= min(x.far, min(y.far, min(z.far, F::all(limit_))));
  }

 private:
  struct Ends {
    Floats<8> near, far;
  };
  [[gnu::always_inline]] Ends ends(const gpu::WideNode& node, int axis) const {
    using F = Floats<8>;
    const std::uint32_t near_row = near_row_[axis];
    const F origin = F::all(origin_[axis]);
    return {(F::load(node.bounds + near_row) - origin) * F::all(near_factor_[axis]),
            (F::load(node.bounds + (near_row ^ 8U)) + origin) * F::all(far_factor_[axis])};
  }

  alignas(16) float origin_[4], near_factor_[4], far_factor_[4];
  std::uint32_t near_row_[3];
  float start_, limit_;
};

}  // namespace encore::accel::ENCORE_ISA
