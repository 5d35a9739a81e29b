#pragma once

#include "scene/triangle.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>

namespace encore::accel {

/// Corner `corner` (0, 1, 2) of triangles[index[0 .. 4)] as structure of arrays.
inline void gather_corners(const scene::Triangle* triangles, const std::uint32_t* index, int corner,
                           __m128& x, __m128& y, __m128& z) {
  // Load vertex by vertex and transpose; the fourth lane of each load holds the triangle's other
  // members and is not used.
  const auto load = [&](int lane) {
    return _mm_loadu_ps(reinterpret_cast<const float*>(triangles + index[lane]) + 4 * corner);
  };
  const __m128 r0 = load(0), r1 = load(1), r2 = load(2), r3 = load(3);
  const __m128 xy01 = _mm_unpacklo_ps(r0, r1), xy23 = _mm_unpacklo_ps(r2, r3);
  const __m128 zw01 = _mm_unpackhi_ps(r0, r1), zw23 = _mm_unpackhi_ps(r2, r3);
  x = _mm_movelh_ps(xy01, xy23);
  y = _mm_movehl_ps(xy23, xy01);
  z = _mm_movelh_ps(zw01, zw23);
}

/// a b - c d
inline __m128 difference(__m128 a, __m128 b, __m128 c, __m128 d) {
  return _mm_sub_ps(_mm_mul_ps(a, b), _mm_mul_ps(c, d));
}
inline __m128 dot(__m128 ax, __m128 ay, __m128 az, __m128 bx, __m128 by, __m128 bz) {
  return _mm_add_ps(_mm_add_ps(_mm_mul_ps(ax, bx), _mm_mul_ps(ay, by)), _mm_mul_ps(az, bz));
}
/// The largest magnitude of the three.
inline __m128 largest(__m128 x, __m128 y, __m128 z) {
  const __m128 sign_bit = _mm_set1_ps(-0.0F);
  return _mm_max_ps(_mm_andnot_ps(sign_bit, x),
                    _mm_max_ps(_mm_andnot_ps(sign_bit, y), _mm_andnot_ps(sign_bit, z)));
}

/// Four points by axis.
struct FourPoints {
  __m128 axis[3];
  const __m128& operator[](int i) const { return axis[i]; }
  friend FourPoints operator-(const FourPoints& a, const glm::vec3& b) {
    return {{_mm_sub_ps(a.axis[0], _mm_set1_ps(b.x)), _mm_sub_ps(a.axis[1], _mm_set1_ps(b.y)),
             _mm_sub_ps(a.axis[2], _mm_set1_ps(b.z))}};
  }
};

/// Four triangles of a list of references, from `first` on; where fewer are left, the last one is
/// repeated and `lanes` has no bit for the repetitions.
struct FourTriangles {
  std::uint32_t index[4];
  unsigned lanes;
  FourPoints v0, v1, v2;

  FourTriangles(const scene::Triangle* triangles, const std::uint32_t* references,
                std::uint32_t first, std::uint32_t count)
      : index{references[first], references[std::min(first + 1, count - 1)],
              references[std::min(first + 2, count - 1)],
              references[std::min(first + 3, count - 1)]},
        lanes(count - first < 4 ? (1U << (count - first)) - 1U : 0xFU) {
    gather_corners(triangles, index, 0, v0.axis[0], v0.axis[1], v0.axis[2]);
    gather_corners(triangles, index, 1, v1.axis[0], v1.axis[1], v1.axis[2]);
    gather_corners(triangles, index, 2, v2.axis[0], v2.axis[1], v2.axis[2]);
  }
};

}  // namespace encore::accel

#endif
