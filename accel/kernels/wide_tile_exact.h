#pragma once

#include "accel/kernels/wide_tile_doubles.h"
#include "accel/kernels/wide_tile_triangles.h"
#include "accel/triangle_hit.h"

namespace encore::accel::ENCORE_ISA {

/// What decide_hit() (accel/triangle_hit.h) says of a ray and the triangle that it hits: t, u and
/// v.
inline void settle_alone(const TraceScene& scene, RayPacket& packet, int i) {
  const scene::Ray& ray = scene.rays[packet.place[i]];
  scene::Hit hit;
  hit.t = ray.t_max;
  hit.triangle = scene::kNoHit;
  hit.u = hit.v = 0.0F;
  decide_hit(ray, scene.triangles[packet.triangle[i]], packet.triangle[i], hit);
  packet.t[i] = hit.t;
  packet.u[i] = hit.u;
  packet.v[i] = hit.v;
}

#if defined(__SSE4_2__)

/// The hit triangles of a group's rays, one loop for each triangle that there is; `axis`: which
/// coordinate comes first, which second and third. Rays without a hit take any other's.
[[gnu::always_inline]] inline Corners<kLanes> hit_corners(const scene::Triangle* triangles,
                                                          const std::uint32_t* ids, unsigned found,
                                                          const int (&axis)[3]) {
  using F = Floats<kLanes>;
  const F all_ids = F::load(ids);
  Corners<kLanes> corners{};
  auto same = Mask<kLanes>::of_bits((1U << kLanes) - 1U);
  for (unsigned left = found; left != 0;) {
    const std::uint32_t id = ids[__builtin_ctz(left)];
    const auto take = [&](Points<kLanes>& to, const glm::vec3& vertex) {
      const float* const from = &vertex.x;
      to.x = select(same, F::all(from[axis[0]]), to.x);
      to.y = select(same, F::all(from[axis[1]]), to.y);
      to.z = select(same, F::all(from[axis[2]]), to.z);
    };
    if (left != found) same = same_bits(all_ids, F::all_bits(id));
    left &= ~same_bits(all_ids, F::all_bits(id)).bits();
    take(corners.v0, triangles[id].v0);
    take(corners.v1, triangles[id].v1);
    take(corners.v2, triangles[id].v2);
  }
  return corners;
}

struct ExactVector {
  Doubles x, y, z;
  friend ExactVector operator-(const ExactVector& a, const ExactVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
};
[[gnu::always_inline]] inline Doubles largest(const ExactVector& a) {
  return largest(abs(a.x), largest(abs(a.y), abs(a.z)));
}

struct ExactHits {
  Doubles t, u, v;
  unsigned plain;  ///< bit i is not set where ray i has to be looked at alone
};

/// decide_hit() for half of a group, operation for operation, but for what is rare. All axes are in
/// the order kx, ky, kz.
template <int kHalf>
[[gnu::always_inline]] inline ExactHits exact_hits(const Corners<kLanes>& corners,
                                                   const Points<kLanes>& from,
                                                   const Points<kLanes>& to, int kz) {
  const auto vector = [](const Points<kLanes>& p) __attribute__((always_inline)) {
    return ExactVector{Doubles::of_half<kHalf>(p.x), Doubles::of_half<kHalf>(p.y),
                       Doubles::of_half<kHalf>(p.z)};
  };
  const ExactVector v0 = vector(corners.v0), v1 = vector(corners.v1), v2 = vector(corners.v2);
  const ExactVector origin = vector(from), direction = vector(to);
  const Doubles shear_x = direction.x / direction.z, shear_y = direction.y / direction.z;
  struct Sheared {
    Doubles x, y;
  };
  const auto shear = [&](const ExactVector& p) __attribute__((always_inline)) {
    return Sheared{p.x - shear_x * p.z, p.y - shear_y * p.z};
  };
  const ExactVector a = v0 - origin;
  const Sheared sa = shear(a), sb = shear(v1 - origin), sc = shear(v2 - origin);
  unsigned odd = 0;
  const auto edge = [&](const Sheared& p, const Sheared& q) __attribute__((always_inline)) {
    const Doubles forward = p.x * q.y, backward = p.y * q.x;
    odd |= equal(forward, backward);
    return forward - backward;
  };
  const Doubles weight_a = edge(sc, sb), weight_b = edge(sa, sc), weight_c = edge(sb, sa);
  const ExactVector e1 = v1 - v0, e2 = v2 - v0;
  const ExactVector normal{e1.y * e2.z - e2.y * e1.z, e1.z * e2.x - e2.z * e1.x,
                           e1.x * e2.y - e2.x * e1.y};
  // Sums go in the order of the axes as they were.
  const auto dot = [&](const ExactVector& p, const ExactVector& q) __attribute__((always_inline)) {
    const Doubles x = p.x * q.x, y = p.y * q.y, z = p.z * q.z;
    if (kz == 2) return x + y + z;
    return kz == 0 ? z + x + y : y + z + x;
  };
  const Doubles slope = dot(direction, normal);
  const Doubles steep = largest(direction) * largest(e1) * largest(e2);
  const Doubles inverse_sum = Doubles::all(1.0) / (weight_a + weight_b + weight_c);
  // Twice the limit below which the triangle's box is asked.
  const unsigned plain = less(steep * Doubles::all(0x1p-19), abs(slope));
  return {dot(a, normal) / slope, weight_b * inverse_sum, weight_c * inverse_sum, plain & ~odd};
}

/// The same for the rays of a group that have found something, if they share their kz: which of
/// them have to be looked at alone.
[[gnu::always_inline]] inline unsigned settle_group(const TraceScene& scene, RayPacket& packet,
                                                    int first, unsigned found, int kz) {
  using F = Floats<kLanes>;
  const int kx = kz == 2 ? 0 : kz + 1;
  const int axis[3] = {kx, kx == 2 ? 0 : kx + 1, kz};
  const auto load = [&](const float(&of)[3][kPacketRays]) __attribute__((always_inline)) {
    return Points<kLanes>{F::load(of[axis[0]] + first), F::load(of[axis[1]] + first),
                          F::load(of[axis[2]] + first)};
  };
  const Corners<kLanes> corners =
      hit_corners(scene.triangles, packet.triangle + first, found, axis);
  const Points<kLanes> origin = load(packet.origin), direction = load(packet.direction);
  const ExactHits low = exact_hits<0>(corners, origin, direction, kz);
  const ExactHits high = exact_hits<1>(corners, origin, direction, kz);
  const auto hit = Mask<kLanes>::of_bits(found);
  const auto store = [&](const Doubles& a, const Doubles& b, float* to) {
    select(hit, Doubles::round(a, b), F::load(to)).store(to);
  };
  store(low.t, high.t, packet.t + first);
  store(low.u, high.u, packet.u + first);
  store(low.v, high.v, packet.v + first);
  return found & ~(low.plain | high.plain << kDoubles);
}

#endif

/// Of the best triangles that have been found for a packet's rays, the hits: as decide_hit().
inline void settle_precise(const TraceScene& scene, RayPacket& packet) {
  using F = Floats<kLanes>;
  constexpr unsigned kAll = (1U << kLanes) - 1U;
  for (int group = 0; group < kGroups; ++group) {
    const int first = group * kLanes;
    const F ids = F::load(packet.triangle + first);
    const unsigned found = kAll & ~same_bits(ids, F::all_bits(scene::kNoHit)).bits();
    if (found == 0) continue;
    unsigned alone = found;
#if defined(__SSE4_2__)
    for (int kz = 0; kz < 3; ++kz) {
      if ((found & ~packet.settling.along[kz][group]) != 0) continue;
      alone = settle_group(scene, packet, first, found, kz);
      break;
    }
#endif
    for (; alone != 0; alone &= alone - 1) {
      settle_alone(scene, packet, first + __builtin_ctz(alone));
    }
  }
}

}  // namespace encore::accel::ENCORE_ISA
