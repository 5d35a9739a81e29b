#pragma once

#include "accel/simd/floats.h"
#include "accel/tolerance.h"
#include "scene/ray.h"
#include "shaders/shared/gpu_types.h"

#include <cstdint>

namespace encore::accel::ENCORE_ISA {

/// A ray, ready for the slab test of boxes that hold lower ends and turned upper ends
/// (gpu::WideNode). Near planes' distances are (plane - near_origin) * near_factor, far planes'
/// with their sign turned (plane - far_origin) * far_factor, where `plane` is what the node holds:
/// of an axis the lower ends first, but for rays that go down the turned upper ends.
///
/// The factors are 1 / |component|, narrowed and widened as accel/tolerance.h says, so that
/// near <= far decides. For a component of 0 both are infinite: planes before and behind the origin
/// give infinite distances, one through it gives NaN, which max() drops. Where the reciprocal
/// leaves the normal range the factors keep it between them. So at least one plane of an empty
/// place in a node always excludes it.
struct SlabFactors {
  Floats<4> near_origin, far_origin;  ///< x, y, z and a number without meaning
  Floats<4> near_factor, far_factor;
  unsigned down;  ///< bit a: the ray goes down along axis a
  /// Whether origin and direction are numbers. Rays of others hit nothing and must not be traced,
  /// as no comparison would keep them out of the empty places of a node.
  bool numbers;

  [[gnu::always_inline]] explicit SlabFactors(const scene::Ray& ray) {
    using F = Floats<4>;
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
    near_factor = select(tiny, zero, narrowed);
    far_factor = select(tiny, F::all(kSmallest), inverse * F::all(kWiden));
    const F turned = origin ^ F::all(-0.0F);
    near_origin = select(goes_down, turned, origin);
    far_origin = select(goes_down, origin, turned);
    down = goes_down.bits();
    const F no_number = (origin - origin) + (direction - direction);
    numbers = ((no_number == zero).bits() & 7U) == 7U;
  }
};

/// A ray against the eight boxes of a node.
class SlabRay {
 public:
  /// False for a ray that must not be traced.
  [[gnu::always_inline]] bool prepare(const scene::Ray& ray) {
    const SlabFactors factors(ray);
    factors.near_origin.store(near_origin_);
    factors.far_origin.store(far_origin_);
    factors.near_factor.store(near_factor_);
    factors.far_factor.store(far_factor_);
    for (unsigned axis = 0; axis < 3; ++axis) {
      const std::uint32_t down = factors.down >> axis & 1U;
      near_row_[axis] = 16 * axis + 8 * down;
      far_row_[axis] = 16 * axis + 8 * (down ^ 1U);
    }
    start_ = ray.t_min * kNarrow + 0.0F;  // no -0 (child_order.h)
    return factors.numbers;
  }

  /// How far to go on from now on.
  [[gnu::always_inline]] void set_limit(float limit) { limit_ = limit; }
  [[gnu::always_inline]] float limit() const { return limit_; }

  /// Which children of the node may be met before the limit; enter says where.
  [[gnu::always_inline]] Mask<8> test(const gpu::WideNode& node, Floats<8>& enter) const {
    using F = Floats<8>;
    const F near_x = near(node, 0), near_y = near(node, 1), near_z = near(node, 2);
    const F far_x = minus_far(node, 0), far_y = minus_far(node, 1), far_z = minus_far(node, 2);
    // Whatever may be NaN comes first, and is dropped.
    enter = max(near_x, max(near_y, max(near_z, F::all(start_))));
    const F minus_leave = max(far_x, max(far_y, max(far_z, F::all(-limit_))));
    return enter <= (minus_leave ^ F::all(-0.0F));
  }

 private:
  [[gnu::always_inline]] Floats<8> near(const gpu::WideNode& node, int axis) const {
    return (Floats<8>::load(node.bounds + near_row_[axis]) - Floats<8>::all(near_origin_[axis])) *
           Floats<8>::all(near_factor_[axis]);
  }
  [[gnu::always_inline]] Floats<8> minus_far(const gpu::WideNode& node, int axis) const {
    return (Floats<8>::load(node.bounds + far_row_[axis]) - Floats<8>::all(far_origin_[axis])) *
           Floats<8>::all(far_factor_[axis]);
  }

  alignas(16) float near_origin_[4], far_origin_[4], near_factor_[4], far_factor_[4];
  std::uint32_t near_row_[3], far_row_[3];
  float start_, limit_;
};

}  // namespace encore::accel::ENCORE_ISA
