#pragma once

#include "accel/kernels/points.h"
#include "shaders/shared/tolerance.h"

#include <cstdint>

namespace encore::accel::ENCORE_ISA {

/// A ray as WatertightTester (accel/triangle_watertight.h) has it: the z axis after a permutation
/// and a shear. Everything below takes points whose axes are in the order kx, ky, kz.
struct WatertightRay {
  int kx, ky, kz;
  float shear_x, shear_y, scale;

  WatertightRay() = default;
  template <class Vector>
  [[gnu::always_inline]] explicit WatertightRay(const Vector& direction) {
    const float d[3] = {direction.x, direction.y, direction.z};
    const float x = __builtin_fabsf(d[0]), y = __builtin_fabsf(d[1]), z = __builtin_fabsf(d[2]);
    kz = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
    kx = kz == 2 ? 0 : kz + 1;
    ky = kx == 2 ? 0 : kx + 1;
    const float size = __builtin_fabsf(d[kz]);
    const bool plain = size > ENCORE_WATERTIGHT_SMALL && size < ENCORE_WATERTIGHT_LARGE;
    shear_x = plain ? d[kx] / d[kz] : __builtin_nanf("");
    shear_y = plain ? d[ky] / d[kz] : __builtin_nanf("");
    scale = 1.0F / d[kz];
  }
};

/// Edge functions, which are the vertices' unnormalised weights, and what they say: a lane that is
/// not a candidate is certainly missed, a candidate that is sure is certainly on the ray's line.
template <int N>
struct WatertightWeights {
  Floats<N> a, b, c;
  Mask<N> candidates, sure;
};

/// `a`, `b` and `c`: the vertices as seen from the origin; `along`: largest z of the three.
template <int N>
[[gnu::always_inline]] inline WatertightWeights<N> watertight_weights(
    const Points<N>& a, const Points<N>& b, const Points<N>& c, const Floats<N>& along,
    const Floats<N>& shear_x, const Floats<N>& shear_y) {
  const Floats<N> ax = a.x - shear_x * a.z, ay = a.y - shear_y * a.z;
  const Floats<N> bx = b.x - shear_x * b.z, by = b.y - shear_y * b.z;
  const Floats<N> cx = c.x - shear_x * c.z, cy = c.y - shear_y * c.z;
  WatertightWeights<N> w;
  w.a = cx * by - cy * bx;
  w.b = ax * cy - ay * cx;
  w.c = bx * ay - by * ax;
  const Floats<N> lateral = max(largest(Points<N>{ax, bx, cx}), largest(Points<N>{ay, by, cy}));
  const Floats<N> error = Floats<N>::all(ENCORE_WATERTIGHT_RESULT) * lateral * (lateral + along) *
                              Floats<N>::all(ENCORE_WATERTIGHT_ERROR) +
                          Floats<N>::all(ENCORE_FILTER_UNDERFLOW);
  const Floats<N> minus_error = error ^ Floats<N>::all(-0.0F);
  const Floats<N> low = min(w.a, min(w.b, w.c));
  const Floats<N> high = max(w.a, max(w.b, w.c));
  const Mask<N> missed = (low < minus_error) & (high > error);
  w.candidates = Mask<N>::of_bits(~missed.bits());
  w.sure = (low > error) | (high < minus_error);
  return w;
}
template <int N>
[[gnu::always_inline]] inline WatertightWeights<N> watertight_weights(const Corners<N>& triangle,
                                                                      const Points<N>& origin,
                                                                      const Floats<N>& shear_x,
                                                                      const Floats<N>& shear_y) {
  const Points<N> a = triangle.v0 - origin;
  const Points<N> b = triangle.v1 - origin;
  const Points<N> c = triangle.v2 - origin;
  return watertight_weights(a, b, c, largest(Points<N>{a.z, b.z, c.z}), shear_x, shear_y);
}

/// How far rounding of the normal may move the heights of points of the triangle, in units of the
/// roundoff: WatertightTester::normal_error(). `edge`: the largest component of the edges.
template <int N>
[[gnu::always_inline]] inline Floats<N> watertight_normal_error(const Points<N>& e1,
                                                                const Points<N>& e2,
                                                                const Floats<N>& edge) {
  const Floats<N> x = (abs(e1.y * e2.z) + abs(e1.z * e2.y)) * max(abs(e1.x), abs(e2.x));
  const Floats<N> y = (abs(e1.z * e2.x) + abs(e1.x * e2.z)) * max(abs(e1.y), abs(e2.y));
  const Floats<N> z = (abs(e1.x * e2.y) + abs(e1.y * e2.x)) * max(abs(e1.z), abs(e2.z));
  return Floats<N>::all(ENCORE_WATERTIGHT_NORMAL) * max(x, max(y, z)) +
         Floats<N>::all(ENCORE_WATERTIGHT_NORMAL_UNDERFLOW) * edge;
}

/// What the distances of N pairs have of the triangle and the origin alone: the dividend, and where
/// it is as precise as the tester wants it, and where at least its sign is certain.
template <int N>
struct WatertightHeight {
  Floats<N> above;
  Floats<N> least_slope;  ///< from which on decide_hit() does not ask the triangle's box
  Mask<N> precise, has_sign;
};

/// `x`, `y`, `z`: the terms of normal times first vertex as seen from the origin, in the order of
/// the axes as they were; `edge`: the largest component of the edges; `normal_error`: see above.
template <int N>
[[gnu::always_inline]] inline WatertightHeight<N> watertight_height(const Floats<N>& x,
                                                                    const Floats<N>& y,
                                                                    const Floats<N>& z,
                                                                    const Floats<N>& edge,
                                                                    const Floats<N>& normal_error) {
  const auto all = [](float number) __attribute__((always_inline)) {
    return Floats<N>::all(number);
  };
  WatertightHeight<N> r;
  r.above = x + y + z;
  const Floats<N> size = abs(r.above);
  const Floats<N> heights = abs(x) + abs(y) + abs(z);
  const Floats<N> error = normal_error + all(5.0F) * heights;
  const Mask<N> in_range = (edge > all(ENCORE_WATERTIGHT_EDGE_SMALL)) &
                           (edge < all(ENCORE_WATERTIGHT_EDGE_LARGE)) &
                           (size > all(ENCORE_WATERTIGHT_SMALL));
  r.precise = in_range & (error < all(128.0F) * size);
  r.least_slope = all(0x1p-19F) * edge * edge;
  r.has_sign = in_range & (error < all(0x1p+22F) * size);
  return r;
}

/// What distances take of N rays: WatertightRay's numbers and where the rays begin and end.
template <int N>
struct WatertightStretch {
  Floats<N> shear_x, shear_y, scale, t_min, t_max;
};

/// The distances of N pairs whose weights are sure. Where `sure`, t is within the tester's bound of
/// the true distance and not so near t_min or t_max that it could lie beyond them. Where `behind`,
/// the triangle is certainly behind the origin: of the bound's two sums, in units of the roundoff,
/// each is below its number's 2^-22, so signs are certain where distances need not be. (A ray that
/// leaves a surface has its first triangle there, too near for its distance.) Where `ahead`, signs
/// are certain too and t is within a factor of two, which leaves it between t_min and t_max.
template <int N>
struct WatertightDistances {
  Floats<N> t;
  Mask<N> sure, behind, ahead;
};

/// `n`: the normal, its axes in the order kx, ky, kz.
template <int N>
[[gnu::always_inline]] inline WatertightDistances<N> watertight_distances(
    const WatertightHeight<N>& height, const Points<N>& n, const WatertightStretch<N>& ray) {
  const auto all = [](float x) __attribute__((always_inline)) {
    return Floats<N>::all(x);
  };
  const Floats<N> sx = n.x * ray.shear_x, sy = n.y * ray.shear_y;
  const Floats<N> down = sx + sy + n.z;
  const Floats<N> steep = abs(down);
  const Floats<N> error = all(5.0F) * (abs(sx) + abs(sy) + abs(n.z));
  const Floats<N> small = all(ENCORE_WATERTIGHT_SMALL);
  const Mask<N> in_range = steep > small;
  WatertightDistances<N> r;
  r.t = height.above / down * ray.scale;
  const Floats<N> size = abs(r.t);
  const Floats<N> near = all(4 * ENCORE_WATERTIGHT_DISTANCE) * size;
  const Mask<N> at_an_end = (abs(r.t - ray.t_min) <= near) | (abs(r.t - ray.t_max) <= near);
  r.sure = without(height.precise & in_range & (error < all(120.0F) * steep) & (size > small) &
                       (size < all(ENCORE_WATERTIGHT_LARGE)),
                   at_an_end);
  const Floats<N> zero = all(0.0F);
  const Mask<N> has_sign = height.has_sign & in_range & (error < all(0x1p+22F) * steep);
  r.behind = has_sign & (r.t < zero) & (ray.t_min >= zero);
  r.ahead = has_sign & (steep > height.least_slope) & (r.t > small) &
            (r.t < all(ENCORE_WATERTIGHT_LARGE)) & (all(0.5F) * r.t > ray.t_min) &
            (all(2.0F) * r.t < ray.t_max);
  return r;
}

}  // namespace encore::accel::ENCORE_ISA
