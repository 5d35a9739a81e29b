#pragma once

#include "accel/kernels/exact_hit.h"
#include "accel/kernels/watertight.h"
#include "accel/kernels/wide_tile_frustum.h"
#include "accel/kernels/wide_tile_triangles.h"
#include "accel/triangle_hit.h"
#include "accel/triangle_settle.h"

namespace encore::accel::ENCORE_ISA {

/// Fills in RayPacket::settling, before any hit, from directions whose components all lie far from
/// the ends of the range, as PacketFrustums::set() makes sure of.
inline void set_settling(RayPacket& packet, bool common_origin) {
  using F = Floats<kLanes>;
  SettlingRays& to = packet.settling;
  for (int i = 0; i < kPacketRays; i += kLanes) {
    const Points<kLanes> d = Points<kLanes>::load(packet.direction[0] + i, kPacketRays);
    const F x = abs(d.x), y = abs(d.y), z = abs(d.z);
    // Of the largest number the exponent alone, and its reciprocal, are powers of two.
    const F power = max(x, max(y, z)) & F::all_bits(0x7F800000U);
    const F unit = F::all(1.0F) / power;
    (d.x * unit).store(to.direction[0] + i);
    (d.y * unit).store(to.direction[1] + i);
    (d.z * unit).store(to.direction[2] + i);

    // WatertightRay's axes and numbers.
    const Mask<kLanes> is_x = (x > y) & (x > z);
    const Mask<kLanes> is_y = without(y > z, x > y);
    const F dx = select(is_x, d.y, select(is_y, d.z, d.x));
    const F dy = select(is_x, d.z, select(is_y, d.x, d.y));
    const F dz = select(is_x, d.x, select(is_y, d.y, d.z));
    (dx / dz).store(to.shear_x + i);
    (dy / dz).store(to.shear_y + i);
    (F::all(1.0F) / dz).store(to.scale + i);
    F::load(packet.t + i).store(to.t_max + i);
    constexpr unsigned kAll = (1U << kLanes) - 1U;
    to.along[0][i / kLanes] = is_x.bits();
    to.along[1][i / kLanes] = is_y.bits();
    to.along[2][i / kLanes] = ~(is_x.bits() | is_y.bits()) & kAll;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const float* const origin = packet.origin[axis];
    to.lowest[axis] = to.highest[axis] = origin[0];
    if (common_origin) continue;
    F low = F::load(origin), high = low;
    for (int i = kLanes; i < kPacketRays; i += kLanes) {
      low = min(low, F::load(origin + i));
      high = max(high, F::load(origin + i));
    }
    to.lowest[axis] = least_of(low);
    to.highest[axis] = greatest_of(high);
  }
}

/// Fills in what WatertightTester's arithmetic takes of a block's triangles alone, once the first
/// of them is not certainly missed.
template <bool kCommon>
[[gnu::always_inline]] inline void settle_block(PreparedBlock& block, const float* origin) {
  if (block.settled) return;
  block.settled = true;
  const auto row = [&](int at) __attribute__((always_inline)) {
    return Points<4>::load(block.row[at], 4);
  };
  const Points<4> e1 = row(PreparedBlock::kE1), e2 = row(PreparedBlock::kE2);
  const Points<4> n = cross(e1, e2);
  block.store(PreparedBlock::kNormal, n);
  const Floats<4> edge = max(largest(e1), largest(e2));
  const Floats<4> normal_error = watertight_normal_error(e1, e2, edge);
  if constexpr (kCommon) {
    for (int axis = 0; axis < 3; ++axis) {
      const Floats<4> o = Floats<4>::all(origin[axis * kPacketRays]);
      Floats<4> seen[3];
      for (int vertex = 0; vertex < 3; ++vertex) {
        seen[vertex] = block.coordinates(vertex, axis) - o;
        seen[vertex].store(block.row[PreparedBlock::kSeen + 3 * vertex + axis]);
      }
      largest(Points<4>{seen[0], seen[1], seen[2]}).store(block.row[PreparedBlock::kAlong + axis]);
    }
    const Points<4> a = row(PreparedBlock::kSeen);
    const WatertightHeight<4> height =
        watertight_height(n.x * a.x, n.y * a.y, n.z * a.z, edge, normal_error);
    height.above.store(block.row[PreparedBlock::kAbove]);
    block.precise_heights = height.precise.bits();
  } else {
    edge.store(block.row[PreparedBlock::kLongest]);
    normal_error.store(block.row[PreparedBlock::kNormalError]);
  }
}

/// Finds the triangle that decide_hit() prefers, in single precision where that is certain, like
/// DoubtingBlocks (block_testers.h) does for one ray: what TriangleFilter's test
/// (triangle_filter.h) does not throw out, WatertightTester's judges (triangle_watertight.h), and
/// what that leaves in doubt, double precision. The hit is WatertightTester's; or, if kPrecise,
/// only its triangle is to be used, and the rest comes from decide_hit() once it is certain which
/// one it is (wide_tile_exact.h).
template <bool kPrecise>
struct DoubtingPackets {
  static constexpr bool kFilter = true;
  /// Whether test_few() is quicker. What the filter leaves is judged triangle by triangle.
  static constexpr bool few_pay(bool any_hit) { return any_hit; }
  static constexpr float kReach = 1.0F + 2 * ENCORE_WATERTIGHT_DISTANCE;

  template <bool kAnyHit, bool kCommon>
  [[gnu::always_inline]] static bool test(const TraceScene& scene, PreparedBlock& block,
                                          const std::uint32_t* ids, const GroupRays& rays,
                                          Mask<kLanes> active, unsigned triangles) {
    const Points<kLanes> origin = kCommon ? Points<kLanes>{} : rays.origin();
    const Points<kLanes> direction = rays.filter_direction();
    bool changed = false;
    for (; triangles != 0; triangles &= triangles - 1) {
      const int lane = __builtin_ctz(triangles);
      const Filtered filtered = filter<kCommon>(OneTriangle{block, lane}, origin, direction);
      const Mask<kLanes> left = without(active, filtered.missed);
      if (left.bits() == 0) continue;
      const unsigned hit =
          judge_all<kAnyHit, kCommon>(scene, block, lane, ids[lane], rays, left, filtered.inside);
      if (hit == 0) continue;
      changed = true;
      if constexpr (kAnyHit) {
        active = without(active, Mask<kLanes>::of_bits(hit));
        if (active.bits() == 0) return true;
      }
    }
    return changed;
  }
  /// The same for a few rays.
  template <bool kAnyHit, bool kCommon>
  [[gnu::always_inline]] static bool test_few(const TraceScene& scene, PreparedBlock& block,
                                              const std::uint32_t* ids, const GroupRays& rays,
                                              const FewRays& few) {
    const Points<kLanes> origin = kCommon ? Points<kLanes>{} : rays.origin(few);
    const Filtered filtered =
        filter<kCommon>(FourTriangles{block}, origin, rays.filter_direction(few));
    const unsigned left = few.lanes() & ~filtered.missed.bits();
    if (left == 0) return false;
    const unsigned inside = filtered.inside.bits() & few.lanes();
    unsigned blocked = 0;
    bool changed = false;
    for (int k = 0; k < block.count; ++k) {
      const unsigned mine = few.rays_of(left, k) & ~blocked;
      if (mine == 0) continue;
      const unsigned hit =
          judge_all<kAnyHit, kCommon>(scene, block, k, ids[k], rays, Mask<kLanes>::of_bits(mine),
                                      Mask<kLanes>::of_bits(few.rays_of(inside, k)));
      changed |= hit != 0;
      if constexpr (kAnyHit) blocked |= hit;
    }
    return changed;
  }

 private:
  /// What TriangleFilter's test is certain of.
  struct Filtered {
    Mask<kLanes> missed, inside;
  };

  template <bool kCommon, class Triangles>
  [[gnu::always_inline]] static Filtered filter(const Triangles& triangles,
                                                const Points<kLanes>& origin,
                                                const Points<kLanes>& direction) {
    using F = Floats<kLanes>;
    const Weights w = weigh<kCommon>(triangles, origin, direction);
    const F error = triangles.number(PreparedBlock::kError);
    const F minus_error = error ^ F::all(-0.0F);
    Mask<kLanes> outside = (w.u < minus_error) | (w.v < minus_error) | (w.u + w.v > w.size + error);
    if constexpr (!kCommon) {
      // Most rays that leave a surface have its triangles right behind them.
      outside = outside | ((w.distance ^ w.sign) < triangles.number(PreparedBlock::kBehind));
    }
    // The bound is as good for certain hits as for certain misses.
    return {outside & (w.size > error),
            (w.u > error) & (w.v > error) & (w.u + w.v < w.size - error)};
  }

  /// Holds a triangle against rays that may hit it, some `inside` for certain; bits of those that
  /// do.
  template <bool kAnyHit, bool kCommon>
  [[gnu::always_inline]] static unsigned judge_all(const TraceScene& scene, PreparedBlock& block,
                                                   int lane, std::uint32_t id,
                                                   const GroupRays& rays, Mask<kLanes> left,
                                                   Mask<kLanes> inside) {
    settle_block<kCommon>(block, rays.packet.origin[0]);
    unsigned hit = 0;
    for (int kz = 0; kz < 3; ++kz) {
      const unsigned along = rays.packet.settling.along[kz][rays.first / kLanes];
      const Mask<kLanes> mine = left & Mask<kLanes>::of_bits(along);
      if (mine.bits() == 0) continue;
      hit |= judge<kAnyHit, kCommon>(scene, block, lane, id, rays, mine, inside, kz);
    }
    return hit;
  }

  /// Holds a triangle against rays whose axis is kz; bits of those that hit it.
  template <bool kAnyHit, bool kCommon>
  [[gnu::always_inline]] static unsigned judge(const TraceScene& scene, const PreparedBlock& block,
                                               int lane, std::uint32_t id, const GroupRays& rays,
                                               Mask<kLanes> left, Mask<kLanes> inside, int kz) {
    using F = Floats<kLanes>;
    RayPacket& packet = rays.packet;
    const SettlingRays& settling = packet.settling;
    const int first = rays.first;
    const int kx = kz == 2 ? 0 : kz + 1;
    const int ky = kx == 2 ? 0 : kx + 1;
    const F t_min = F::load(packet.t_min + first);
    const F best = F::load(packet.t + first);
    const WatertightStretch<kLanes> stretch{
        F::load(settling.shear_x + first), F::load(settling.shear_y + first),
        F::load(settling.scale + first), t_min, F::load(settling.t_max + first)};
    // From here on axes are in the order kx, ky, kz.
    const auto turned = [&](const auto& at) __attribute__((always_inline)) {
      return Points<kLanes>{at(kx), at(ky), at(kz)};
    };
    const auto seen = [&](int vertex) __attribute__((always_inline)) {
      return turned([&](int axis) __attribute__((always_inline)) {
        if constexpr (kCommon) {
          return F::all(block.row[PreparedBlock::kSeen + 3 * vertex + axis][lane]);
        } else {
          return block.template coordinate<kLanes>(vertex, axis, lane) -
                 F::load(packet.origin[axis] + first);
        }
      });
    };
    const Points<kLanes> a = seen(0), b = seen(1), c = seen(2);
    WatertightWeights<kLanes> w;
    w.candidates = w.sure = inside;
    if (!kPrecise || without(left, inside).bits() != 0) {
      F along;
      if constexpr (kCommon) {
        along = F::all(block.row[PreparedBlock::kAlong + kz][lane]);
      } else {
        along = largest(Points<kLanes>{a.z, b.z, c.z});
      }
      w = watertight_weights(a, b, c, along, stretch.shear_x, stretch.shear_y);
    }
    left = left & w.candidates;
    if (left.bits() == 0) return 0;
    const auto normal = [&](int axis) __attribute__((always_inline)) {
      return F::all(block.row[PreparedBlock::kNormal + axis][lane]);
    };
    WatertightHeight<kLanes> height;
    if constexpr (kCommon) {
      height.above = F::all(block.row[PreparedBlock::kAbove][lane]);
      const bool precise = (block.precise_heights >> lane & 1U) != 0;
      height.precise = Mask<kLanes>::of_bits(precise ? ~0U : 0U);
      height.has_sign = Mask<kLanes>::of_bits(0);
      height.least_slope = F::all(0.0F);
    } else {
      const F* const terms[3] = {&a.x, &a.y, &a.z};
      const int x = kz == 2 ? 0 : kz == 0 ? 2 : 1;
      height = watertight_height(normal(0) * *terms[x], normal(1) * *terms[x == 2 ? 0 : x + 1],
                                 normal(2) * *terms[x == 0 ? 2 : x - 1],
                                 F::all(block.row[PreparedBlock::kLongest][lane]),
                                 F::all(block.row[PreparedBlock::kNormalError][lane]));
    }
    const WatertightDistances<kLanes> distances =
        watertight_distances(height, turned(normal), stretch);
    left = without(left, w.sure & distances.behind);
    const F& t = distances.t;
    Mask<kLanes> sure = left & w.sure & distances.sure;
    // The best hit of a ray that has none yet is t_max, which no sure distance is near.
    const Mask<kLanes> near = abs(t - best) <= F::all(4 * ENCORE_WATERTIGHT_DISTANCE) * t;
    Mask<kLanes> hit = sure & (t > t_min) & (t < best);
    if constexpr (kAnyHit) {
      const Mask<kLanes> ahead = left & w.sure & distances.ahead;
      hit = hit | ahead;
      sure = sure | ahead;
    } else {
      hit = without(hit, near);
    }
    take<kAnyHit>(hit, t, id, w, packet, first);
    unsigned changed = hit.bits();
    if (kPrecise && !kAnyHit && changed != 0) __builtin_prefetch(scene.triangles + id);
    unsigned doubts = without(left, sure).bits();
    if constexpr (!kAnyHit) {
      const Mask<kLanes> ties = sure & near;
      if (ties.bits() != 0) {
        const Mask<kLanes> won = win_ties(scene, packet, first, id, ties, doubts);
        changed |= won.bits();
        take<false>(won, t, id, w, packet, first);
      }
    }
    for (; doubts != 0; doubts &= doubts - 1) {
      const int ray = __builtin_ctz(doubts);
      if (settle<kAnyHit>(scene, packet, first + ray, id)) changed |= 1U << ray;
    }
    return changed;
  }

  /// Makes a triangle the best hit of those rays of a group that `hit` it.
  template <bool kAnyHit>
  [[gnu::always_inline]] static void take(Mask<kLanes> hit, const Floats<kLanes>& t,
                                          std::uint32_t id, const WatertightWeights<kLanes>& w,
                                          RayPacket& packet, int first) {
    using F = Floats<kLanes>;
    const F new_t = kAnyHit ? F::all(-__builtin_inff()) : t;
    select(hit, new_t, F::load(packet.t + first)).store(packet.t + first);
    select(hit, F::all_bits(id), F::load(packet.triangle + first)).store(packet.triangle + first);
    if constexpr (!kAnyHit && !kPrecise) {
      const F inverse = F::all(1.0F) / (w.a + w.b + w.c);
      select(hit, w.b * inverse, F::load(packet.u + first)).store(packet.u + first);
      select(hit, w.c * inverse, F::load(packet.v + first)).store(packet.v + first);
    }
  }

  /// Of rays that hit a triangle for certain, about as far away as their best hit: those of which
  /// it is to become the best hit. Where that is not known they join the `doubts`.
  [[gnu::noinline]] static Mask<kLanes> win_ties(const TraceScene& scene, const RayPacket& packet,
                                                 int first, std::uint32_t id, Mask<kLanes> ties,
                                                 unsigned& doubts) {
    unsigned won = 0;
    for (unsigned left = ties.bits(); left != 0; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      const std::uint32_t now = packet.triangle[first + lane];
      if (now == id) continue;
      const Preferred preferred =
          exactly_preferred(scene.rays[packet.place[first + lane]], scene.triangles, id, now);
      if (preferred == Preferred::first) won |= 1U << lane;
      if (preferred == Preferred::unknown) doubts |= 1U << lane;
    }
    return Mask<kLanes>::of_bits(won);
  }

  /// Holds a triangle in doubt against the best hit of one ray.
  template <bool kAnyHit>
  [[gnu::noinline]] static bool settle(const TraceScene& scene, RayPacket& packet, int i,
                                       std::uint32_t id) {
    const std::uint32_t now = packet.triangle[i];
    if (now == id || (kAnyHit && now != scene::kNoHit)) return false;
    const scene::Ray& ray = scene.rays[packet.place[i]];
    scene::Hit best;
    if constexpr (kAnyHit || kPrecise) {
      best.t = ray.t_max;
      best.triangle = scene::kNoHit;
      best.u = best.v = 0.0F;
      if (now != scene::kNoHit) decide_hit(ray, scene.triangles[now], now, best);
      if (!decide_hit(ray, scene.triangles[id], id, best)) return false;
    } else {
      best.t = packet.t[i];
      best.triangle = now;
      best.u = packet.u[i];
      best.v = packet.v[i];
      if (!settle_watertight(ray, scene.triangles, id, best)) return false;
    }
    packet.t[i] = kAnyHit ? -__builtin_inff() : best.t;
    packet.triangle[i] = id;
    packet.u[i] = best.u;
    packet.v[i] = best.v;
    return true;
  }
};

}  // namespace encore::accel::ENCORE_ISA
