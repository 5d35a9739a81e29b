#pragma once

#include "accel/kernels/points.h"

namespace encore::accel::ENCORE_ISA {

/// What MollerTrumboreTester (accel/triangle_moller_trumbore.h) says of N pairs of a ray and a
/// triangle: where `inside`, the distance is `distance` / `size`, the weights u / size and v /
/// size.
template <int N>
struct MollerTrumbore {
  Mask<N> inside;
  Floats<N> distance, u, v, size;
};

/// N triangles and one ray, or one triangle and N rays: the one that is single is given N times.
template <int N>
[[gnu::always_inline]] inline MollerTrumbore<N> moller_trumbore(const Corners<N>& triangle,
                                                                const Points<N>& origin,
                                                                const Points<N>& direction) {
  const Points<N> e1 = triangle.v1 - triangle.v0;
  const Points<N> e2 = triangle.v2 - triangle.v0;
  const Points<N> s = origin - triangle.v0;
  const Points<N> p = cross(direction, e2);
  const Points<N> q = cross(s, e1);
  const Floats<N> det = dot(e1, p);
  const Floats<N> sign = det & Floats<N>::all(-0.0F);
  MollerTrumbore<N> r;
  r.size = det ^ sign;
  r.u = dot(s, p) ^ sign;
  r.v = dot(direction, q) ^ sign;
  r.distance = dot(e2, q) ^ sign;
  const Floats<N> zero = Floats<N>::all(0.0F);
  // Nothing that is not a number passes.
  r.inside = (r.size > zero) & (r.u >= zero) & (r.v >= zero) & (r.u + r.v <= r.size);
  return r;
}

}  // namespace encore::accel::ENCORE_ISA
