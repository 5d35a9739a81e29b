#pragma once

#include "accel/kernels/points.h"
#include "accel/kernels/wide_tile_few.h"
#include "accel/kernels/wide_tile_packet.h"
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
    kBehind = 16,
    kError = 17,
    // What settle_block() fills in; after the normal the last three where the rays have their
    // origin in common, else the first two.
    kNormal = 18,
    kLongest = 21,
    kNormalError = 22,
    kAbove = 21,
    kSeen = 22,
    kAlong = 31,
    kRows = 34
  };
  alignas(16) float row[kRows][4];
  int count;  ///< triangles, repetitions left out
  /// Where the vertices' coordinates come from: that of a vertex and an axis, and a triangle.
  const float* corners;
  int next_vertex, next_axis;
  bool settled = false;
  unsigned precise_heights = 0;  ///< WatertightHeight::precise, bit by bit

  [[gnu::always_inline]] void store(int at, const Points<4>& p) {
    p.x.store(row[at]);
    p.y.store(row[at + 1]);
    p.z.store(row[at + 2]);
  }
  template <int N>
  [[gnu::always_inline]] Floats<N> coordinate(int vertex, int axis, int lane) const {
    return Floats<N>::all(corners[vertex * next_vertex + axis * next_axis + lane]);
  }
  /// The same for all four triangles; a block of one has it four times.
  [[gnu::always_inline]] Floats<4> coordinates(int vertex, int axis) const {
    const float* const at = corners + vertex * next_vertex + axis * next_axis;
    return next_axis == 4 ? Floats<4>::load(at) : Floats<4>::all(*at);
  }
};

/// TriangleFilter's numbers for four triangles and all rays of a packet at once.
template <bool kCommon>
[[gnu::always_inline]] inline void prepare_filter(const Points<4>& v0, const Points<4>& e1,
                                                  const Points<4>& e2, const RayPacket& packet,
                                                  PreparedBlock& to) {
  using F = Floats<4>;
  const SettlingRays& settling = packet.settling;
  const F edge = max(largest(e1), largest(e2));
  F reach = edge;
  for (int axis = 0; axis < 3; ++axis) {
    const F& v = axis == 0 ? v0.x : axis == 1 ? v0.y : v0.z;
    reach = max(reach, abs(F::all(settling.lowest[axis]) - v));
    if (!kCommon) reach = max(reach, abs(F::all(settling.highest[axis]) - v));
  }
  const F largest_result = F::all(ENCORE_FILTER_LARGEST) * edge * reach;
  const F underflow = F::all(ENCORE_FILTER_UNDERFLOW);
  (largest_result * F::all(ENCORE_FILTER_ERROR) + underflow).store(to.row[PreparedBlock::kError]);
  if (!kCommon) {
    const F behind = largest_result * edge * F::all(ENCORE_FILTER_ERROR) + underflow;
    (behind ^ F::all(-0.0F)).store(to.row[PreparedBlock::kBehind]);
  }
}

/// What tests take of four triangles, `v0` and the edges from it. `packet`: with the origin that
/// its rays have in common, if they do.
template <bool kCommon, bool kFilter>
[[gnu::always_inline]] inline void prepare(const Points<4>& v0, const Points<4>& e1,
                                           const Points<4>& e2, const RayPacket& packet,
                                           PreparedBlock& to) {
  to.store(PreparedBlock::kE1, e1);
  to.store(PreparedBlock::kE2, e2);
  if constexpr (kCommon) {
    const Points<4> o{Floats<4>::all(packet.origin[0][0]), Floats<4>::all(packet.origin[1][0]),
                      Floats<4>::all(packet.origin[2][0])};
    const Points<4> s = o - v0;
    const Points<4> q = cross(s, e1);
    to.store(PreparedBlock::kS, s);
    to.store(PreparedBlock::kQ, q);
    dot(e2, q).store(to.row[PreparedBlock::kDistance]);
  } else {
    to.store(PreparedBlock::kV0, v0);
  }
  if constexpr (kFilter) prepare_filter<kCommon>(v0, e1, e2, packet, to);
}
template <bool kCommon, bool kFilter>
[[gnu::always_inline]] inline void prepare(const TriangleBlock& block, const std::uint32_t* ids,
                                           const RayPacket& packet, PreparedBlock& to) {
  const float* const from = block.corner[0][0];
  const Points<4> v0 = Points<4>::load(from, 4);
  prepare<kCommon, kFilter>(v0, Points<4>::load(from + 12, 4) - v0,
                            Points<4>::load(from + 24, 4) - v0, packet, to);
  to.corners = from;
  to.next_vertex = 12;
  to.next_axis = 4;
  int count = 4;
  while (count > 1 && ids[count - 1] == ids[count - 2]) --count;
  to.count = count;
}

/// What the single-precision tests compute of a triangle and a group's rays.
struct Weights {
  Floats<kLanes> size, u, v, distance, sign;
};

/// One triangle of a block, for all lanes.
struct OneTriangle {
  const PreparedBlock& block;
  int lane;

  [[gnu::always_inline]] Floats<kLanes> number(int at) const {
    return Floats<kLanes>::all(block.row[at][lane]);
  }
};
/// A block's four triangles, for as many rays as FewRays has.
struct FourTriangles {
  const PreparedBlock& block;

  [[gnu::always_inline]] Floats<kLanes> number(int at) const { return repeat_fours(block.row[at]); }
};

template <bool kCommon, class Triangles>
[[gnu::always_inline]] inline Weights weigh(const Triangles& triangles,
                                            const Points<kLanes>& origin,
                                            const Points<kLanes>& direction) {
  using F = Floats<kLanes>;
  const auto point = [&](int at) __attribute__((always_inline)) {
    return Points<kLanes>{triangles.number(at), triangles.number(at + 1), triangles.number(at + 2)};
  };
  const auto e1 = point(PreparedBlock::kE1);
  const auto e2 = point(PreparedBlock::kE2);
  const auto p = cross(direction, e2);
  const F det = dot(e1, p);
  Weights w;
  w.sign = det & F::all(-0.0F);
  w.size = det ^ w.sign;
  if constexpr (kCommon) {
    w.u = dot(point(PreparedBlock::kS), p) ^ w.sign;
    w.v = dot(direction, point(PreparedBlock::kQ)) ^ w.sign;
    w.distance = triangles.number(PreparedBlock::kDistance);
  } else {
    const auto s = origin - point(PreparedBlock::kV0);
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
  [[gnu::always_inline]] Points<kLanes> origin(const FewRays& few) const {
    return few.points(packet.origin[0] + first, kPacketRays);
  }
  [[gnu::always_inline]] Points<kLanes> direction(const FewRays& few) const {
    return few.points(packet.direction[0] + first, kPacketRays);
  }
  /// The one that TriangleFilter's bound holds for.
  [[gnu::always_inline]] Points<kLanes> filter_direction() const {
    return Points<kLanes>::load(packet.settling.direction[0] + first, kPacketRays);
  }
  [[gnu::always_inline]] Points<kLanes> filter_direction(const FewRays& few) const {
    return few.points(packet.settling.direction[0] + first, kPacketRays);
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
  /// Whether test_few() is quicker.
  static constexpr bool few_pay(bool /*any_hit*/) { return true; }
  static constexpr float kReach = 1.0F + 0x1p-12F;

  template <bool kAnyHit, bool kCommon>
  [[gnu::always_inline]] static bool test(const TraceScene&, const PreparedBlock& block,
                                          const std::uint32_t* ids, const GroupRays& rays,
                                          Mask<kLanes> active, unsigned triangles) {
    using F = Floats<kLanes>;
    const F zero = F::all(0.0F);
    const Points<kLanes> origin = kCommon ? Points<kLanes>{} : rays.origin();
    const Points<kLanes> direction = rays.direction();
    bool changed = false;
    for (; triangles != 0; triangles &= triangles - 1) {
      const int lane = __builtin_ctz(triangles);
      const Weights w = weigh<kCommon>(OneTriangle{block, lane}, origin, direction);
      const Mask<kLanes> inside =
          active & (w.size > zero) & (w.u >= zero) & (w.v >= zero) & (w.u + w.v <= w.size);
      if (inside.bits() == 0) continue;
      changed |= accept<kAnyHit>(inside, w, ids[lane], rays);
    }
    return changed;
  }

  /// The same for a few rays.
  template <bool kAnyHit, bool kCommon>
  [[gnu::always_inline]] static bool test_few(const TraceScene&, const PreparedBlock& block,
                                              const std::uint32_t* ids, const GroupRays& rays,
                                              const FewRays& few) {
    using F = Floats<kLanes>;
    const F zero = F::all(0.0F);
    const Points<kLanes> origin = kCommon ? Points<kLanes>{} : rays.origin(few);
    const Weights w = weigh<kCommon>(FourTriangles{block}, origin, rays.direction(few));
    const Mask<kLanes> hit =
        (w.size > zero) & (w.u >= zero) & (w.v >= zero) & (w.u + w.v <= w.size);
    unsigned inside = hit.bits() & few.lanes();
    if (inside == 0) return false;
    const F inverse = F::all(1.0F) / w.size;
    alignas(64) float t[kLanes], u[kLanes], v[kLanes];
    ((w.distance ^ w.sign) * inverse).store(t);
    (w.u * inverse).store(u);
    (w.v * inverse).store(v);
    RayPacket& packet = rays.packet;
    bool changed = false;
    for (; inside != 0; inside &= inside - 1) {
      const int lane = __builtin_ctz(inside);
      const int i = rays.first + few.ray(lane);
      const std::uint32_t id = ids[lane % 4];
      if (!(t[lane] > packet.t_min[i] && t[lane] <= kLargest && t[lane] <= packet.t[i])) continue;
      if (!kAnyHit && t[lane] == packet.t[i] && id >= packet.triangle[i]) continue;
      packet.t[i] = kAnyHit ? -__builtin_inff() : t[lane];
      packet.triangle[i] = id;
      packet.u[i] = u[lane];
      packet.v[i] = v[lane];
      changed = true;
    }
    return changed;
  }

 private:
  static constexpr float kLargest = 0x1.fffffep+127F;

  template <bool kAnyHit>
  [[gnu::always_inline]] static bool accept(Mask<kLanes> inside, const Weights& w, std::uint32_t id,
                                            const GroupRays& rays) {
    using F = Floats<kLanes>;
    RayPacket& packet = rays.packet;
    const int first = rays.first;
    const F inverse = F::all(1.0F) / w.size;
    const F t = (w.distance ^ w.sign) * inverse;
    const F best = F::load(packet.t + first);
    Mask<kLanes> better =
        inside & (t > F::load(packet.t_min + first)) & (t <= F::all(kLargest)) & (t <= best);
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

}  // namespace encore::accel::ENCORE_ISA
