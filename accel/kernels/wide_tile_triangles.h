#pragma once

#include "accel/kernels/points.h"
#include "accel/kernels/wide_tile_packet.h"
#include "accel/triangle_hit.h"
#include "accel/triangle_settle.h"
#include "accel/wide/wide_tree.h"
#include "scene/triangle.h"
#include "shaders/shared/tolerance.h"

namespace encore::accel::ENCORE_ISA {

/// The four triangles of a block as all rays of a packet need them, to be read one at a time.
/// Operation for operation what accel/triangle_*.h computes.
struct PreparedBlock {
  enum {
    kV0 = 0,
    kE1 = 3,
    kE2 = 6,
    kS = 9,
    kQ = 12,
    kDistance = 15,
    kEdge = 16,
    kReach = 17,
    kError = 18,
    kRows = 19
  };
  alignas(16) float row[kRows][4];
  int count;  ///< triangles, repetitions left out

  [[gnu::always_inline]] void store(int at, const Points<4>& p) {
    p.x.store(row[at]);
    p.y.store(row[at + 1]);
    p.z.store(row[at + 2]);
  }
  template <int N>
  [[gnu::always_inline]] Points<N> get(int at, int lane) const {
    return {Floats<N>::all(row[at][lane]), Floats<N>::all(row[at + 1][lane]),
            Floats<N>::all(row[at + 2][lane])};
  }
};

/// TriangleFilter's bound of its errors.
template <int N>
[[gnu::always_inline]] inline Floats<N> filter_error(const Floats<N>& edge,
                                                     const Floats<N>& reach) {
  return Floats<N>::all(ENCORE_FILTER_LARGEST) * edge * reach *
             Floats<N>::all(ENCORE_FILTER_ERROR) +
         Floats<N>::all(ENCORE_FILTER_UNDERFLOW);
}

/// `origin`: of all rays, if they have one in common.
template <bool kCommon, bool kFilter>
[[gnu::always_inline]] inline void prepare(const TriangleBlock& block, const std::uint32_t* ids,
                                           const float* origin, PreparedBlock& to) {
  const float* const from = block.corner[0][0];
  const Points<4> v0 = Points<4>::load(from, 4);
  const Points<4> e1 = Points<4>::load(from + 12, 4) - v0;
  const Points<4> e2 = Points<4>::load(from + 24, 4) - v0;
  to.store(PreparedBlock::kE1, e1);
  to.store(PreparedBlock::kE2, e2);
  if constexpr (kCommon) {
    const Points<4> o{Floats<4>::all(origin[0]), Floats<4>::all(origin[kPacketRays]),
                      Floats<4>::all(origin[2 * kPacketRays])};
    const Points<4> s = o - v0;
    const Points<4> q = cross(s, e1);
    to.store(PreparedBlock::kS, s);
    to.store(PreparedBlock::kQ, q);
    dot(e2, q).store(to.row[PreparedBlock::kDistance]);
    if constexpr (kFilter) {
      const Floats<4> edge = max(largest(e1), largest(e2));
      const Floats<4> reach = max(edge, largest(s));
      edge.store(to.row[PreparedBlock::kEdge]);
      reach.store(to.row[PreparedBlock::kReach]);
      filter_error(edge, reach).store(to.row[PreparedBlock::kError]);
    }
  } else {
    to.store(PreparedBlock::kV0, v0);
    if constexpr (kFilter) max(largest(e1), largest(e2)).store(to.row[PreparedBlock::kEdge]);
  }
  int count = 4;
  while (count > 1 && ids[count - 1] == ids[count - 2]) --count;
  to.count = count;
}

/// What the single-precision tests compute of a triangle and a group's rays.
struct Weights {
  Floats<kLanes> size, u, v, distance, sign;
};

template <bool kCommon>
[[gnu::always_inline]] inline Weights weigh(const PreparedBlock& block, int lane,
                                            const Points<kLanes>& origin,
                                            const Points<kLanes>& direction, Points<kLanes>& s) {
  using F = Floats<kLanes>;
  const auto e1 = block.get<kLanes>(PreparedBlock::kE1, lane);
  const auto e2 = block.get<kLanes>(PreparedBlock::kE2, lane);
  const auto p = cross(direction, e2);
  const F det = dot(e1, p);
  Weights w;
  w.sign = det & F::all(-0.0F);
  w.size = det ^ w.sign;
  if constexpr (kCommon) {
    s = block.get<kLanes>(PreparedBlock::kS, lane);
    w.u = dot(s, p) ^ w.sign;
    w.v = dot(direction, block.get<kLanes>(PreparedBlock::kQ, lane)) ^ w.sign;
    w.distance = F::all(block.row[PreparedBlock::kDistance][lane]);
  } else {
    s = origin - block.get<kLanes>(PreparedBlock::kV0, lane);
    w.u = dot(s, p) ^ w.sign;
    const auto q = cross(s, e1);
    w.v = dot(direction, q) ^ w.sign;
    w.distance = dot(e2, q);
  }
  return w;
}

/// Where the rays of a group have their origins, directions and best hits in the packet.
struct GroupRays {
  RayPacket& packet;
  int first;

  [[gnu::always_inline]] Points<kLanes> origin() const {
    return Points<kLanes>::load(packet.origin[0] + first, kPacketRays);
  }
  [[gnu::always_inline]] Points<kLanes> direction() const {
    return Points<kLanes>::load(packet.direction[0] + first, kPacketRays);
  }
  /// Lane by lane, from the caller's own rays.
  [[gnu::always_inline]] scene::Hit hit(int lane) const {
    scene::Hit best;
    best.t = packet.t[first + lane];
    best.triangle = packet.triangle[first + lane];
    best.u = packet.u[first + lane];
    best.v = packet.v[first + lane];
    return best;
  }
  [[gnu::always_inline]] void set_hit(int lane, const scene::Hit& best) const {
    packet.t[first + lane] = best.t;
    packet.triangle[first + lane] = best.triangle;
    packet.u[first + lane] = best.u;
    packet.v[first + lane] = best.v;
  }
};

/// What is the same for all triangles of a trace.
struct TraceScene {
  WideView tree;
  const scene::Triangle* triangles;
  const scene::Ray* rays;  ///< what RayPacket::place counts from
};

/// Holds a block's triangles against the `active` rays of a group; true if a best hit changed.
struct MollerTrumborePackets {
  static constexpr bool kFilter = false;
  static constexpr float kReach = 1.0F + 0x1p-12F;

  template <bool kAnyHit, bool kCommon>
  [[gnu::always_inline]] static bool test(const TraceScene&, const PreparedBlock& block,
                                          const std::uint32_t* ids, const GroupRays& rays,
                                          Mask<kLanes> active) {
    using F = Floats<kLanes>;
    const F zero = F::all(0.0F);
    const Points<kLanes> origin = kCommon ? Points<kLanes>{} : rays.origin();
    const Points<kLanes> direction = rays.direction();
    bool changed = false;
    for (int lane = 0; lane < block.count; ++lane) {
      Points<kLanes> s;
      const Weights w = weigh<kCommon>(block, lane, origin, direction, s);
      const Mask<kLanes> inside =
          active & (w.size > zero) & (w.u >= zero) & (w.v >= zero) & (w.u + w.v <= w.size);
      if (inside.bits() == 0) continue;
      changed |= accept<kAnyHit>(inside, w, ids[lane], rays);
    }
    return changed;
  }

 private:
  template <bool kAnyHit>
  [[gnu::always_inline]] static bool accept(Mask<kLanes> inside, const Weights& w, std::uint32_t id,
                                            const GroupRays& rays) {
    using F = Floats<kLanes>;
    RayPacket& packet = rays.packet;
    const int first = rays.first;
    const F inverse = F::all(1.0F) / w.size;
    const F t = (w.distance ^ w.sign) * inverse;
    const F best = F::load(packet.t + first);
    Mask<kLanes> better = inside & (t > F::load(packet.t_min + first)) &
                          (t <= F::all(0x1.fffffep+127F)) & (t <= best);
    if (better.bits() == 0) return false;
    const F now = F::load(packet.triangle + first);
    if constexpr (!kAnyHit) {
      for (unsigned same = (better & (t == best)).bits(); same != 0; same &= same - 1) {
        const int lane = __builtin_ctz(same);
        if (id < packet.triangle[first + lane]) continue;
        better = without(better, Mask<kLanes>::of_bits(1U << lane));
      }
      select(better, w.u * inverse, F::load(packet.u + first)).store(packet.u + first);
      select(better, w.v * inverse, F::load(packet.v + first)).store(packet.v + first);
    }
    select(better, F::all_bits(id), now).store(packet.triangle + first);
    const F new_t = kAnyHit ? F::all(-__builtin_inff()) : t;
    select(better, new_t, best).store(packet.t + first);
    return true;
  }
};

struct SettlePrecise {
  static bool settle(const scene::Ray& ray, const scene::Triangle* triangles, std::uint32_t id,
                     scene::Hit& best) {
    return decide_hit(ray, triangles[id], id, best);
  }
};
struct SettleWatertight {
  static bool settle(const scene::Ray& ray, const scene::Triangle* triangles, std::uint32_t id,
                     scene::Hit& best) {
    return settle_watertight(ray, triangles, id, best);
  }
};

/// Finds out which triangle decide_hit() would prefer, in single precision where that is certain:
/// t is known to kNear, u and v are not kept. What is to be told of the hit is computed once it is
/// certain which one it is (wide_tile_exact.h).
///
/// TriangleFilter's test (accel/triangle_filter.h) is sure of a miss beyond its error bound, and so
/// it is of a hit on the other side of it. The determinant is a sum of products of direction and
/// two edges, hence off by 42 r times their largest components with r = 2^-24 and the direction's
/// below 2, the distance by 42 r times those of two edges and the way to a vertex: where they are
/// more than kSure times what they may be off by, t is right to 2 / kSure and a little.
struct DoubtingPackets {
  static constexpr bool kFilter = true;
  static constexpr float kSure = 0x1p12F;
  static constexpr float kNear = 0x1.4p-10F;
  static constexpr float kReach = 1.0F + kNear;

  template <bool kAnyHit, bool kCommon>
  [[gnu::always_inline]] static bool test(const TraceScene& scene, const PreparedBlock& block,
                                          const std::uint32_t* ids, const GroupRays& rays,
                                          Mask<kLanes> active) {
    using F = Floats<kLanes>;
    const F sign_bit = F::all(-0.0F);
    const Points<kLanes> origin = kCommon ? Points<kLanes>{} : rays.origin();
    const Points<kLanes> direction = rays.direction();
    bool changed = false;
    for (int lane = 0; lane < block.count; ++lane) {
      Points<kLanes> s;
      const Weights w = weigh<kCommon>(block, lane, origin, direction, s);
      const F edge = F::all(block.row[PreparedBlock::kEdge][lane]);
      F reach, error;
      if constexpr (kCommon) {
        reach = F::all(block.row[PreparedBlock::kReach][lane]);
        error = F::all(block.row[PreparedBlock::kError][lane]);
      } else {
        reach = max(edge, largest(s));
        error = filter_error(edge, reach);
      }
      const F minus_error = error ^ sign_bit;
      const F sum = w.u + w.v;
      const Mask<kLanes> outside =
          (w.u < minus_error) | (w.v < minus_error) | (sum > w.size + error);
      const Mask<kLanes> left = without(active, outside & (w.size > error));
      if (left.bits() == 0) continue;
      const Mask<kLanes> inside = (w.u > error) & (w.v > error) & (sum < w.size - error);
      changed |= judge<kAnyHit>(scene, left, inside, w, edge, reach, ids[lane], rays);
    }
    return changed;
  }

 private:
  template <bool kAnyHit>
  [[gnu::always_inline]] static bool judge(const TraceScene& scene, Mask<kLanes> left,
                                           Mask<kLanes> inside, const Weights& w,
                                           const Floats<kLanes>& edge, const Floats<kLanes>& reach,
                                           std::uint32_t id, const GroupRays& rays) {
    using F = Floats<kLanes>;
    RayPacket& packet = rays.packet;
    const int first = rays.first;
    constexpr float kBound = 42 * 0x1p-24F * kSure;
    const F area = edge * edge * F::all(kBound);
    const F tiny = F::all(0x1p-100F);
    const F distance = w.distance ^ w.sign;
    const F t = distance * (F::all(1.0F) / w.size);
    const F best = F::load(packet.t + first);
    const F t_min = F::load(packet.t_min + first);
    const F near = abs(t) * F::all(kNear);
    const Mask<kLanes> known = (w.size > area * F::all(2.0F) + tiny) &
                               (abs(distance) > area * reach + tiny) & (abs(t) < F::all(0x1p100F));
    const Mask<kLanes> too_near = t + near<t_min, too_far = t - near> best;
    left = without(left, known & (too_near | too_far));
    const Mask<kLanes> sure = left & known & inside & (t - near > t_min) & (t + near < best);
    const F new_t = kAnyHit ? F::all(-__builtin_inff()) : t;
    select(sure, new_t, best).store(packet.t + first);
    select(sure, F::all_bits(id), F::load(packet.triangle + first)).store(packet.triangle + first);
    bool changed = sure.bits() != 0;
    for (unsigned doubts = without(left, sure).bits(); doubts != 0; doubts &= doubts - 1) {
      changed |= settle<kAnyHit>(scene, packet, first + __builtin_ctz(doubts), id);
    }
    return changed;
  }

  /// Holds a triangle in doubt against the best hit of one ray.
  template <bool kAnyHit>
  static bool settle(const TraceScene& scene, RayPacket& packet, int i, std::uint32_t id) {
    const std::uint32_t now = packet.triangle[i];
    if (now == id || (kAnyHit && now != scene::kNoHit)) return false;
    const scene::Ray& ray = scene.rays[packet.place[i]];
    scene::Hit best;
    best.t = ray.t_max;
    best.triangle = scene::kNoHit;
    best.u = best.v = 0.0F;
    if (!kAnyHit && now != scene::kNoHit) decide_hit(ray, scene.triangles[now], now, best);
    if (!decide_hit(ray, scene.triangles[id], id, best)) return false;
    packet.t[i] = kAnyHit ? -__builtin_inff() : best.t;
    packet.triangle[i] = id;
    return true;
  }
};

}  // namespace encore::accel::ENCORE_ISA
