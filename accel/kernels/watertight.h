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

template <int N>
[[gnu::always_inline]] inline WatertightWeights<N> watertight_weights(const Corners<N>& triangle,
                                                                      const Points<N>& origin,
                                                                      Floats<N> shear_x,
                                                                      Floats<N> shear_y) {
  const Points<N> a = triangle.v0 - origin;
  const Points<N> b = triangle.v1 - origin;
  const Points<N> c = triangle.v2 - origin;
  const Floats<N> ax = a.x - shear_x * a.z, ay = a.y - shear_y * a.z;
  const Floats<N> bx = b.x - shear_x * b.z, by = b.y - shear_y * b.z;
  const Floats<N> cx = c.x - shear_x * c.z, cy = c.y - shear_y * c.z;
  WatertightWeights<N> w;
  w.a = cx * by - cy * bx;
  w.b = ax * cy - ay * cx;
  w.c = bx * ay - by * ax;
  const Floats<N> lateral = max(largest(Points<N>{ax, bx, cx}), largest(Points<N>{ay, by, cy}));
  const Floats<N> along = largest(Points<N>{a.z, b.z, c.z});
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

/// The distances of N pairs whose weights are sure. Where `sure`, t is within the tester's bound of
/// the true distance and not so near t_min or t_max that it could lie beyond them. Where `behind`,
/// the triangle is certainly behind the origin: of the bound's two sums, in units of the roundoff,
/// each is below its number's 2^-22, so signs are certain where distances need not be. (A ray that
/// leaves a surface has its first triangle there, too near for its distance.)
template <int N>
struct WatertightDistances {
  Floats<N> t;
  Mask<N> sure, behind;
};

/// `kz` is the ray's, the same for all N.
template <int N>
[[gnu::always_inline]] inline WatertightDistances<N> watertight_distances(
    const Corners<N>& triangle, const Points<N>& origin, const WatertightRay& ray, float t_min,
    float t_max) {
  const auto all = [](float x) __attribute__((always_inline)) {
    return Floats<N>::all(x);
  };
  const Points<N> a = triangle.v0 - origin;
  const Points<N> e1 = triangle.v1 - triangle.v0;
  const Points<N> e2 = triangle.v2 - triangle.v0;
  const Points<N> n = cross(e1, e2);
  // Sums go in the order of the axes as they were.
  const Floats<N> hx = n.x * a.x, hy = n.y * a.y, hz = n.z * a.z;
  const Floats<N> h0 = ray.kz == 2 ? hx : ray.kz == 0 ? hz : hy;
  const Floats<N> h1 = ray.kz == 2 ? hy : ray.kz == 0 ? hx : hz;
  const Floats<N> h2 = ray.kz == 2 ? hz : ray.kz == 0 ? hy : hx;
  const Floats<N> sx = n.x * all(ray.shear_x), sy = n.y * all(ray.shear_y);
  const Floats<N> above = h0 + h1 + h2;
  const Floats<N> down = sx + sy + n.z;
  const Floats<N> heights = abs(h0) + abs(h1) + abs(h2);
  const Floats<N> slopes = abs(sx) + abs(sy) + abs(n.z);
  const Floats<N> edge = max(largest(e1), largest(e2));
  const Floats<N> small = all(ENCORE_WATERTIGHT_SMALL);
  const Mask<N> in_range = (edge > all(ENCORE_WATERTIGHT_EDGE_SMALL)) &
                           (edge < all(ENCORE_WATERTIGHT_EDGE_LARGE)) & (abs(above) > small) &
                           (abs(down) > small);
  const Floats<N> above_error = all(32.0F) * edge * edge * edge + all(5.0F) * heights;
  const Floats<N> down_error = all(5.0F) * slopes;
  const Mask<N> precise =
      (above_error < all(128.0F) * abs(above)) & (down_error < all(120.0F) * abs(down));
  WatertightDistances<N> r;
  r.t = above / down * all(ray.scale);
  const Floats<N> size = abs(r.t);
  const Floats<N> near = all(4 * ENCORE_WATERTIGHT_DISTANCE) * size;
  const Mask<N> at_an_end = (abs(r.t - all(t_min)) <= near) | (abs(r.t - all(t_max)) <= near);
  r.sure = without(in_range & precise & (size > small) & (size < all(ENCORE_WATERTIGHT_LARGE)),
                   at_an_end);
  const Floats<N> zero = all(0.0F);
  r.behind = in_range & (above_error < all(0x1p+22F) * abs(above)) &
             (down_error < all(0x1p+22F) * abs(down)) & (r.t < zero) & (all(t_min) >= zero);
  return r;
}

}  // namespace encore::accel::ENCORE_ISA
