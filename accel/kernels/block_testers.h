#pragma once

#include "accel/kernels/moller_trumbore.h"
#include "accel/kernels/watertight.h"
#include "accel/triangle_hit.h"
#include "accel/triangle_settle.h"
#include "accel/wide/wide_tree.h"
#include "scene/ray.h"
#include "scene/triangle.h"

#include <cstdint>

namespace encore::accel::ENCORE_ISA {

// One ray against blocks of four triangles, in two steps, so that a loop over several rays can do
// the first one for all of them, without a branch, before it asks for any outcome:
//
//   start(ray)         nothing hit so far
//   look(block)        whether anything of the block may be hit
//   look_both(...)     the same for two rays side by side, each with its block: of what it returns
//                      the lowest four bits are the first one's, the next four the second one's
//   judge(block, ids)  after a look() that says so: true if the best hit changed
//   limit()            how far to go on: no less than the true distance of the best hit
//   hit                the best hit; if kNeedsFinish only its triangle, the rest is decide_hit()'s
//
// Numbers are kept one by one and spread when they are used, which a load does for nothing.

/// scene::Hit without its constructor, which would be a function that others share.
struct BestHit {
  float t;
  std::uint32_t triangle;
  float u, v;
};

[[gnu::always_inline]] inline BestHit miss(const scene::Ray& ray) {
  return {ray.t_max, scene::kNoHit, 0.0F, 0.0F};
}

/// decide_hit() or settle_watertight().
template <class Decide>
[[gnu::always_inline]] inline bool decide(const Decide& by, BestHit& best) {
  scene::Hit hit{best.t, best.triangle, best.u, best.v};
  if (!by(hit)) return false;
  best = {hit.t, hit.triangle, hit.u, hit.v};
  return true;
}
[[gnu::always_inline]] inline bool decide_precisely(const scene::Ray& ray,
                                                    const scene::Triangle* triangles,
                                                    std::uint32_t index, BestHit& best) {
  return decide([&](scene::Hit& hit) { return decide_hit(ray, triangles[index], index, hit); },
                best);
}

/// MollerTrumboreTester's arithmetic.
class MollerTrumboreBlocks {
 public:
  static constexpr bool kNeedsFinish = false;

  [[gnu::always_inline]] void start(const scene::Ray& ray, const scene::Triangle*) {
    origin_ = {ray.origin.x, ray.origin.y, ray.origin.z};
    direction_ = {ray.direction.x, ray.direction.y, ray.direction.z};
    t_min_ = ray.t_min;
    hit = miss(ray);
  }
  [[gnu::always_inline]] float limit() const { return hit.t * (1.0F + 0x1p-12F); }

  [[gnu::always_inline]] bool look(const TriangleBlock& block) {
    const MollerTrumbore<4> four =
        moller_trumbore(corners(block), Points<4>::all(origin_), Points<4>::all(direction_));
    const unsigned inside = four.inside.bits();
    keep(four.distance, four.u, four.v, four.size, inside);
    return inside != 0;
  }

  [[gnu::always_inline]] static unsigned look_both(MollerTrumboreBlocks& a,
                                                   const TriangleBlock& block_a,
                                                   MollerTrumboreBlocks& b,
                                                   const TriangleBlock& block_b) {
    const MollerTrumbore<8> r =
        moller_trumbore(beside(corners(block_a), corners(block_b)),
                        beside(Points<4>::all(a.origin_), Points<4>::all(b.origin_)),
                        beside(Points<4>::all(a.direction_), Points<4>::all(b.direction_)));
    const unsigned inside = r.inside.bits();
    a.keep(low_half(r.distance), low_half(r.u), low_half(r.v), low_half(r.size), inside & 0xFU);
    b.keep(high_half(r.distance), high_half(r.u), high_half(r.v), high_half(r.size), inside >> 4U);
    return inside;
  }

  [[gnu::always_inline]] bool judge(const TriangleBlock&, const std::uint32_t* ids) {
    const Floats<4> inverse = Floats<4>::all(1.0F) / Floats<4>::load(results_[3]);
    (Floats<4>::load(results_[0]) * inverse).store(results_[0]);
    inverse.store(results_[3]);
    bool changed = false;
    for (unsigned left = inside_; left != 0; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      const float t = results_[0][lane];
      if (!(t > t_min_ && t <= kLargestFloat)) continue;
      if (!(t < hit.t || (t == hit.t && ids[lane] < hit.triangle))) continue;
      hit.t = t;
      hit.triangle = ids[lane];
      hit.u = results_[1][lane] * results_[3][lane];
      hit.v = results_[2][lane] * results_[3][lane];
      changed = true;
    }
    return changed;
  }

  BestHit hit;

 private:
  static constexpr float kLargestFloat = 0x1.fffffep+127F;

  [[gnu::always_inline]] static Corners<4> corners(const TriangleBlock& block) {
    const float* const from = block.corner[0][0];
    return {Points<4>::load(from, 4), Points<4>::load(from + 12, 4), Points<4>::load(from + 24, 4)};
  }

  [[gnu::always_inline]] void keep(const Floats<4>& distance, const Floats<4>& u,
                                   const Floats<4>& v, const Floats<4>& size, unsigned inside) {
    distance.store(results_[0]);
    u.store(results_[1]);
    v.store(results_[2]);
    size.store(results_[3]);
    inside_ = inside;
  }

  struct Vector {
    float x, y, z;
  };
  Vector origin_, direction_;
  float t_min_;
  unsigned inside_;
  alignas(16) float results_[4][4];  // distance, u, v, size
};

/// WatertightTester's arithmetic; or, if `Precise`, the same to find out which triangle it is,
/// whose hit decide_hit() then tells. Its verdicts are decide_hit()'s own wherever they are sure.
template <bool Precise>
class DoubtingBlocks {
 public:
  static constexpr bool kNeedsFinish = Precise;

  [[gnu::always_inline]] void start(const scene::Ray& ray, const scene::Triangle* triangles) {
    ray_ = &ray;
    triangles_ = triangles;
    turned_ = WatertightRay(ray.direction);
    const float* const origin = &ray.origin.x;
    origin_ = {origin[turned_.kx], origin[turned_.ky], origin[turned_.kz]};
    hit = miss(ray);
    exact_ = false;
  }
  [[gnu::always_inline]] float limit() const {
    return hit.t * (1.0F + 2 * ENCORE_WATERTIGHT_DISTANCE);
  }

  [[gnu::always_inline]] bool look(const TriangleBlock& block) {
    const WatertightWeights<4> w =
        watertight_weights(turned(block), Points<4>::all(origin_), Floats<4>::all(turned_.shear_x),
                           Floats<4>::all(turned_.shear_y));
    const unsigned candidates = w.candidates.bits();
    keep(w.a, w.b, w.c, candidates, w.sure.bits());
    return candidates != 0;
  }

  [[gnu::always_inline]] static unsigned look_both(DoubtingBlocks& a, const TriangleBlock& block_a,
                                                   DoubtingBlocks& b,
                                                   const TriangleBlock& block_b) {
    const WatertightWeights<8> w = watertight_weights(
        beside(a.turned(block_a), b.turned(block_b)),
        beside(Points<4>::all(a.origin_), Points<4>::all(b.origin_)),
        beside(Floats<4>::all(a.turned_.shear_x), Floats<4>::all(b.turned_.shear_x)),
        beside(Floats<4>::all(a.turned_.shear_y), Floats<4>::all(b.turned_.shear_y)));
    const unsigned candidates = w.candidates.bits(), sure = w.sure.bits();
    a.keep(low_half(w.a), low_half(w.b), low_half(w.c), candidates & 0xFU, sure & 0xFU);
    b.keep(high_half(w.a), high_half(w.b), high_half(w.c), candidates >> 4U, sure >> 4U);
    return candidates;
  }

  [[gnu::always_inline]] bool judge(const TriangleBlock& block, const std::uint32_t* ids) {
    const auto all = [](float x) __attribute__((always_inline)) {
      return Floats<4>::all(x);
    };
    const Corners<4> triangle = turned(block);
    const Points<4> a = triangle.v0 - Points<4>::all(origin_);
    const Points<4> e1 = triangle.v1 - triangle.v0, e2 = triangle.v2 - triangle.v0;
    const Points<4> n = cross(e1, e2);
    const Floats<4> edge = max(largest(e1), largest(e2));
    const Floats<4> x = n.x * a.x, y = n.y * a.y, z = n.z * a.z;
    const int kz = turned_.kz;
    const WatertightHeight<4> height =
        watertight_height(kz == 2   ? x
                          : kz == 0 ? z
                                    : y,
                          kz == 2   ? y
                          : kz == 0 ? x
                                    : z,
                          kz == 2   ? z
                          : kz == 0 ? y
                                    : x,
                          edge, watertight_normal_error(e1, e2, edge));
    const WatertightDistances<4> distances =
        watertight_distances<4>(height, n,
                                {all(turned_.shear_x), all(turned_.shear_y), all(turned_.scale),
                                 all(ray_->t_min), all(ray_->t_max)});
    unsigned left = candidates_ & ~(sure_ & distances.behind.bits());
    if (left == 0) return false;
    const unsigned sure = sure_ & distances.sure.bits();
    const Floats<4> b = Floats<4>::load(weights_[1]), c = Floats<4>::load(weights_[2]);
    const Floats<4> inverse = Floats<4>::all(1.0F) / (Floats<4>::load(weights_[0]) + b + c);
    alignas(16) float t[4], u[4], v[4];
    distances.t.store(t);
    (b * inverse).store(u);
    (c * inverse).store(v);
    bool changed = false;
    for (; left != 0; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      const std::uint32_t index = ids[lane];
      // A triangle may be in several leaves, and again in the last lanes of one.
      if (index == hit.triangle) continue;
      if ((sure >> lane & 1U) == 0) {
        changed |= settle(index);
        continue;
      }
      if (!(t[lane] > ray_->t_min && t[lane] < ray_->t_max)) continue;
      if (hit.triangle != scene::kNoHit) {
        const float apart = t[lane] - hit.t;
        if (__builtin_fabsf(apart) <= 4 * ENCORE_WATERTIGHT_DISTANCE * t[lane]) {
          changed |= settle(index);
          continue;
        }
        if (apart > 0.0F) continue;
      }
      hit.t = t[lane];
      hit.triangle = index;
      hit.u = u[lane];
      hit.v = v[lane];
      exact_ = false;
      changed = true;
    }
    return changed;
  }

  BestHit hit;

 private:
  [[gnu::always_inline]] Points<4> turned(const float (&rows)[3][4]) const {
    return {Floats<4>::load(rows[turned_.kx]), Floats<4>::load(rows[turned_.ky]),
            Floats<4>::load(rows[turned_.kz])};
  }
  [[gnu::always_inline]] Corners<4> turned(const TriangleBlock& block) const {
    return {turned(block.corner[0]), turned(block.corner[1]), turned(block.corner[2])};
  }

  [[gnu::always_inline]] void keep(const Floats<4>& a, const Floats<4>& b, const Floats<4>& c,
                                   unsigned candidates, unsigned sure) {
    a.store(weights_[0]);
    b.store(weights_[1]);
    c.store(weights_[2]);
    candidates_ = candidates;
    sure_ = sure;
  }

  /// Holds a triangle in doubt against the best hit.
  [[gnu::noinline]] bool settle(std::uint32_t index) {
    if (!Precise) {
      return decide(
          [&](scene::Hit& best) { return settle_watertight(*ray_, triangles_, index, best); }, hit);
    }
    if (hit.triangle != scene::kNoHit && !exact_) {
      const std::uint32_t best = hit.triangle;
      hit = miss(*ray_);
      decide_precisely(*ray_, triangles_, best, hit);
      exact_ = true;
    }
    if (!decide_precisely(*ray_, triangles_, index, hit)) return false;
    exact_ = true;
    return true;
  }

  const scene::Ray* ray_;
  const scene::Triangle* triangles_;
  WatertightRay turned_;
  struct Vector {
    float x, y, z;
  };
  Vector origin_;
  bool exact_;  ///< whether `hit` is decide_hit()'s; only if Precise
  unsigned candidates_, sure_;
  alignas(16) float weights_[3][4];
};

using PreciseBlocks = DoubtingBlocks<true>;
using WatertightBlocks = DoubtingBlocks<false>;

}  // namespace encore::accel::ENCORE_ISA
