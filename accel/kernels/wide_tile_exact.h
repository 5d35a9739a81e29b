#pragma once

#include "accel/kernels/wide_tile_doubles.h"
#include "accel/kernels/wide_tile_triangles.h"

namespace encore::accel::ENCORE_ISA {

/// What decide_hit() (accel/triangle_hit.h) or settle_watertight() says of a ray and the triangle
/// that it hits: t, u and v.
template <class Settle>
inline void settle_alone(const TraceScene& scene, RayPacket& packet, int i) {
  const scene::Ray& ray = scene.rays[packet.place[i]];
  scene::Hit hit;
  hit.t = ray.t_max;
  hit.triangle = scene::kNoHit;
  hit.u = hit.v = 0.0F;
  Settle::settle(ray, scene.triangles, packet.triangle[i], hit);
  packet.t[i] = hit.t;
  packet.u[i] = hit.u;
  packet.v[i] = hit.v;
}

#if defined(__SSE4_2__)

/// The triangles of some of a packet's rays by corner and axis; rays without a hit take any other.
struct HitCorners {
  alignas(64) float corner[3][3][kDoubles < 4 ? 4 : kDoubles];

  [[gnu::always_inline]] void load(const scene::Triangle* triangles, const std::uint32_t* ids,
                                   unsigned found) {
    const std::uint32_t any = ids[__builtin_ctz(found)];
    for (int i = 0; i < kDoubles; i += 4) {
      for (int c = 0; c < 3; ++c) {
        Floats<4> row[4];
        for (int k = 0; k < 4; ++k) {
          const bool has = i + k < kDoubles && (found >> (i + k) & 1U) != 0;
          const std::uint32_t id = has ? ids[i + k] : any;
          row[k] = Floats<4>::load(reinterpret_cast<const float*>(triangles + id) + 4 * c);
        }
        transpose(row[0], row[1], row[2], row[3]);
        for (int axis = 0; axis < 3; ++axis) row[axis].store(corner[c][axis] + i);
      }
    }
  }
};

struct ExactVector {
  Doubles x, y, z;
  friend ExactVector operator-(const ExactVector& a, const ExactVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
};
[[gnu::always_inline]] inline Doubles dot(const ExactVector& a, const ExactVector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[gnu::always_inline]] inline Doubles largest(const ExactVector& a) {
  return largest(abs(a.x), largest(abs(a.y), abs(a.z)));
}

/// decide_hit() for kDoubles rays, operation for operation, but for what is rare: bit i of the
/// result is not set where ray i has to be looked at alone.
[[gnu::always_inline]] inline unsigned exact_hits(const HitCorners& of, RayPacket& packet, int i,
                                                  const int (&turn)[3]) {
  const auto vector = [](const float* x, const float* y, const float* z) {
    return ExactVector{Doubles::of(x), Doubles::of(y), Doubles::of(z)};
  };
  const auto& c = of.corner;
  const ExactVector v0 = vector(c[0][0], c[0][1], c[0][2]);
  const ExactVector v1 = vector(c[1][0], c[1][1], c[1][2]);
  const ExactVector v2 = vector(c[2][0], c[2][1], c[2][2]);
  const ExactVector origin =
      vector(packet.origin[0] + i, packet.origin[1] + i, packet.origin[2] + i);
  const ExactVector direction =
      vector(packet.direction[0] + i, packet.direction[1] + i, packet.direction[2] + i);
  const auto axis = [&](const ExactVector& p, int k) {
    return turn[k] == 0 ? p.x : turn[k] == 1 ? p.y : p.z;
  };
  const Doubles shear_x = axis(direction, 0) / axis(direction, 2);
  const Doubles shear_y = axis(direction, 1) / axis(direction, 2);
  struct Sheared {
    Doubles x, y;
  };
  const auto shear = [&](const ExactVector& p) {
    return Sheared{axis(p, 0) - shear_x * axis(p, 2), axis(p, 1) - shear_y * axis(p, 2)};
  };
  const ExactVector a = v0 - origin;
  const Sheared sa = shear(a), sb = shear(v1 - origin), sc = shear(v2 - origin);
  unsigned odd = 0;
  const auto edge = [&](const Sheared& p, const Sheared& q) {
    const Doubles forward = p.x * q.y, backward = p.y * q.x;
    odd |= equal(forward, backward);
    return forward - backward;
  };
  const Doubles weight_a = edge(sc, sb), weight_b = edge(sa, sc), weight_c = edge(sb, sa);
  const ExactVector e1 = v1 - v0, e2 = v2 - v0;
  const ExactVector normal{e1.y * e2.z - e2.y * e1.z, e1.z * e2.x - e2.z * e1.x,
                           e1.x * e2.y - e2.x * e1.y};
  const Doubles slope = dot(direction, normal);
  const Doubles steep = largest(direction) * largest(e1) * largest(e2);
  // Twice the limit below which the triangle's box is asked.
  const unsigned plain = less(steep * Doubles::all(0x1p-19), abs(slope));
  (dot(a, normal) / slope).round_to(packet.t + i);
  const Doubles inverse_sum = Doubles::all(1.0) / (weight_a + weight_b + weight_c);
  (weight_b * inverse_sum).round_to(packet.u + i);
  (weight_c * inverse_sum).round_to(packet.v + i);
  return plain & ~odd;
}

/// The axis that decide_hit() makes the ray's own, or -1 if it is not the same for all.
[[gnu::always_inline]] inline int turned_axis(const RayPacket& packet, int i) {
  const auto size = [&](int axis) { return abs(Doubles::of(packet.direction[axis] + i)); };
  constexpr unsigned kAll = (1U << kDoubles) - 1U;
  const Doubles x = size(0), y = size(1), z = size(2);
  const unsigned x_over_y = less(y, x), x_over_z = less(z, x), y_over_z = less(z, y);
  const unsigned is_x = x_over_y & x_over_z, is_y = ~x_over_y & y_over_z & kAll;
  if (is_x == kAll) return 0;
  if (is_y == kAll) return 1;
  return (is_x | is_y) == 0 ? 2 : -1;
}

#endif

/// Of the best triangles that have been found for a packet's rays, the hits: as decide_hit().
inline void settle_precise(const TraceScene& scene, RayPacket& packet) {
#if defined(__SSE4_2__)
  for (int i = 0; i < kPacketRays; i += kDoubles) {
    unsigned found = 0;
    for (int k = 0; k < kDoubles; ++k) {
      found |= unsigned{packet.triangle[i + k] != scene::kNoHit} << k;
    }
    if (found == 0) continue;
    unsigned alone = found;
    const int kz = turned_axis(packet, i);
    if (kz >= 0) {
      const int kx = kz == 2 ? 0 : kz + 1;
      const int turn[3] = {kx, kx == 2 ? 0 : kx + 1, kz};
      alignas(64) float t[kDoubles], zero[kDoubles];
      for (int k = 0; k < kDoubles; ++k) {
        t[k] = packet.t[i + k];
        zero[k] = 0.0F;
      }
      HitCorners corners;
      corners.load(scene.triangles, packet.triangle + i, found);
      alone &= ~exact_hits(corners, packet, i, turn);
      for (unsigned missed = ~found & ((1U << kDoubles) - 1U); missed != 0; missed &= missed - 1) {
        const int k = __builtin_ctz(missed);
        packet.t[i + k] = t[k];
        packet.u[i + k] = packet.v[i + k] = zero[k];
      }
    }
    for (; alone != 0; alone &= alone - 1) {
      settle_alone<SettlePrecise>(scene, packet, i + __builtin_ctz(alone));
    }
  }
#else
  for (int i = 0; i < kPacketRays; ++i) {
    if (packet.triangle[i] != scene::kNoHit) settle_alone<SettlePrecise>(scene, packet, i);
  }
#endif
}

inline void settle_watertight(const TraceScene& scene, RayPacket& packet) {
  for (int i = 0; i < kPacketRays; ++i) {
    if (packet.triangle[i] != scene::kNoHit) settle_alone<SettleWatertight>(scene, packet, i);
  }
}

}  // namespace encore::accel::ENCORE_ISA
