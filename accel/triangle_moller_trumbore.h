#pragma once

#include "accel/four_triangles.h"
#include "scene/ray.h"
#include "scene/triangle.h"

#include <cstdint>
#include <limits>

namespace encore::accel {

/// Tests triangles against one ray by Möller and Trumbore (1997) in single precision and nothing
/// else: from both sides, edges included, no tolerance but that a determinant of exactly 0 is no
/// hit. At equal t the lower index wins.
///
/// Barycentric weights are compared before they are divided (as in the paper's branch that culls),
/// so the decision needs sums and products only, which every device rounds alike.
///
/// There is no bound on what this gets wrong: next to an edge a ray may miss both triangles or hit
/// either beside it, and distances to triangles that are thin, edge-on or far away may be off by
/// any amount. So structures agree on ordinary rays, where the distance is known to better than
/// reach() allows for; where it is not, each finds what it happens to test.
class MollerTrumboreTester {
 public:
  explicit MollerTrumboreTester(const scene::Ray& ray) : ray_(ray) {}

  /// How far to search for a hit that is to replace one at `best`: leaves room for the rounding of
  /// distances to triangles that are in good shape.
  static float reach(float best) { return best * (1.0F + 0x1p-12F); }

  /// Tests one triangle; true if it became the best hit.
  bool test(const scene::Triangle* triangles, std::uint32_t index, scene::Hit& best) const {
    const scene::Triangle& t = triangles[index];
    const glm::vec3 e1 = t.v1 - t.v0;
    const glm::vec3 e2 = t.v2 - t.v0;
    const glm::vec3 s = ray_.origin - t.v0;
    const glm::vec3& d = ray_.direction;
    const glm::vec3 p{d.y * e2.z - d.z * e2.y, d.z * e2.x - d.x * e2.z, d.x * e2.y - d.y * e2.x};
    const float det = e1.x * p.x + e1.y * p.y + e1.z * p.z;
    const float sign = det < 0 ? -1.0F : 1.0F;
    const float u = (s.x * p.x + s.y * p.y + s.z * p.z) * sign;
    const glm::vec3 q{s.y * e1.z - s.z * e1.y, s.z * e1.x - s.x * e1.z, s.x * e1.y - s.y * e1.x};
    const float v = (d.x * q.x + d.y * q.y + d.z * q.z) * sign;
    const float size = det * sign;
    // Nothing that is not a number passes.
    if (!(size > 0 && u >= 0 && v >= 0 && u + v <= size)) return false;
    return accept(index, (e2.x * q.x + e2.y * q.y + e2.z * q.z) * sign, u, v, size, best);
  }

  /// Tests triangles[references[0 .. count)]; true if the best hit changed.
  bool test(const scene::Triangle* triangles, const std::uint32_t* references, std::uint32_t count,
            scene::Hit& best) const {
    bool changed = false;
#if defined(__SSE2__)
    std::uint32_t i = 0;
    for (; i + 2 <= count; i += 4) changed |= test_four(triangles, references, i, count, best);
    if (i < count) changed |= test(triangles, references[i], best);
#else
    for (std::uint32_t i = 0; i < count; ++i) changed |= test(triangles, references[i], best);
#endif
    return changed;
  }

 private:
  bool accept(std::uint32_t index, float distance, float u, float v, float size,
              scene::Hit& best) const {
    const float inverse = 1.0F / size;
    const float t = distance * inverse;
    if (!(t > ray_.t_min && t <= std::numeric_limits<float>::max())) return false;
    if (!(t < best.t || (t == best.t && index < best.triangle))) return false;
    best = {t, index, u * inverse, v * inverse};
    return true;
  }

#if defined(__SSE2__)
  /// The same, operation for operation, on four triangles.
  bool test_four(const scene::Triangle* triangles, const std::uint32_t* references,
                 std::uint32_t first, std::uint32_t count, scene::Hit& best) const {
    const FourTriangles four(triangles, references, first, count);
    const FourPoints &v0 = four.v0, &v1 = four.v1, &v2 = four.v2;
    const __m128 e1x = _mm_sub_ps(v1[0], v0[0]), e2x = _mm_sub_ps(v2[0], v0[0]);
    const __m128 e1y = _mm_sub_ps(v1[1], v0[1]), e2y = _mm_sub_ps(v2[1], v0[1]);
    const __m128 e1z = _mm_sub_ps(v1[2], v0[2]), e2z = _mm_sub_ps(v2[2], v0[2]);
    const __m128 sx = _mm_sub_ps(_mm_set1_ps(ray_.origin.x), v0[0]);
    const __m128 sy = _mm_sub_ps(_mm_set1_ps(ray_.origin.y), v0[1]);
    const __m128 sz = _mm_sub_ps(_mm_set1_ps(ray_.origin.z), v0[2]);
    const __m128 dx = _mm_set1_ps(ray_.direction.x);
    const __m128 dy = _mm_set1_ps(ray_.direction.y);
    const __m128 dz = _mm_set1_ps(ray_.direction.z);

    const __m128 px = difference(dy, e2z, dz, e2y);
    const __m128 py = difference(dz, e2x, dx, e2z);
    const __m128 pz = difference(dx, e2y, dy, e2x);
    const __m128 det = dot(e1x, e1y, e1z, px, py, pz);
    const __m128 sign = _mm_and_ps(det, _mm_set1_ps(-0.0F));
    const __m128 size = _mm_xor_ps(det, sign);
    const __m128 u = _mm_xor_ps(dot(sx, sy, sz, px, py, pz), sign);
    const __m128 qx = difference(sy, e1z, sz, e1y);
    const __m128 qy = difference(sz, e1x, sx, e1z);
    const __m128 qz = difference(sx, e1y, sy, e1x);
    const __m128 v = _mm_xor_ps(dot(dx, dy, dz, qx, qy, qz), sign);

    const __m128 zero = _mm_setzero_ps();
    const __m128 inside =
        _mm_and_ps(_mm_and_ps(_mm_cmpgt_ps(size, zero), _mm_cmpge_ps(u, zero)),
                   _mm_and_ps(_mm_cmpge_ps(v, zero), _mm_cmple_ps(_mm_add_ps(u, v), size)));
    unsigned left = static_cast<unsigned>(_mm_movemask_ps(inside)) & four.lanes;
    if (left == 0) return false;

    alignas(16) float results[4][4];  // distance, u, v, size
    _mm_store_ps(results[0], _mm_xor_ps(dot(e2x, e2y, e2z, qx, qy, qz), sign));
    _mm_store_ps(results[1], u);
    _mm_store_ps(results[2], v);
    _mm_store_ps(results[3], size);
    bool changed = false;
    for (; left != 0; left &= left - 1) {
      const auto lane = static_cast<unsigned>(__builtin_ctz(left));
      changed |= accept(four.index[lane], results[0][lane], results[1][lane], results[2][lane],
                        results[3][lane], best);
    }
    return changed;
  }
#endif

  const scene::Ray& ray_;
};

}  // namespace encore::accel
