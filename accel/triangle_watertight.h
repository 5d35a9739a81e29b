#pragma once

#include "accel/four_triangles.h"
#include "accel/triangle_hit.h"
#include "shaders/shared/tolerance.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace encore::accel {

/// Tests triangles against one ray in single precision after Woop, Benthin and Wald (2013): the ray
/// is made the z axis by a permutation and a shear, so that three edge functions of the sheared
/// vertices decide. Where the paper falls back to double precision for an edge function of exactly
/// 0, this does so wherever the sign is not certain; so the hits are those of decide_hit(), and a
/// ray through an edge is seen the same way by both of its triangles.
///
/// The same promise as TriangleFilter's, but for the distance: of the triangles that decide_hit()
/// accepts, `best` becomes the nearest by decide_hit()'s own distances, at equal ones the lowest
/// index. Its t, u and v are single precision's: they depend on ray and triangle alone, and t is
/// off by at most kDistanceError relatively (in practice by a few units of the last place).
///
/// Error of the edge functions: with unit roundoff r, L the largest sheared coordinate and Z the
/// largest origin-relative coordinate along the ray's axis, a vertex relative to the origin is off
/// by r (L + Z), the shear's factor (at most 1) by r, so a sheared coordinate by at most r (2 L +
/// 4 Z), and a difference of two products by 4 L r (2 L + 4 Z) + 4 r L^2 <= 16 r L (L + Z). The
/// bound is twice that, and computed through 8 L (L + Z), which overflows before any intermediate
/// does: an infinite bound is a doubt. ENCORE_FILTER_UNDERFLOW covers what falls below the normal
/// range. A certain sign needs L > 2^-20 (L + Z), so decide_hit(), which is off by some 2^-48
/// (L + Z)^2, sees the same sign and a slope far above ENCORE_SLOPE_ROUNDING.
///
/// Error of the distance t = N . A / N . D, with N = E1 x E2: its x is off by 4 r (|E1y E2z| +
/// |E1z E2y|), y and z alike, which moves t by at most the sum over the axes of that times
/// max(|E1x|, |E2x|), over |N . D|, since the vector from the hit to A lies within the triangle:
/// not at all for a wall across an axis, however large. 16.5 times the largest of the three is
/// more; a 2^-120th of the largest component of the edges is for what falls below the normal range.
/// The dot products are off by 4 r times the sum of their terms' magnitudes each, divisions and the
/// ray's scale add 3 r. A triangle for which those sums do not stay below 2^-16 |t|, as it is seen
/// too nearly edge-on or almost contains the origin, is left to decide_hit(), distance and all. So
/// is one at a distance that is t_min or t_max to within twice that.
class WatertightTester {
 public:
  /// Relative bound of a distance's error, and how close two distances must be for their order to
  /// be left to double precision: more than both errors together.
  static constexpr float kDistanceError = ENCORE_WATERTIGHT_DISTANCE;
  static constexpr float kSameDistance = 4 * ENCORE_WATERTIGHT_DISTANCE;
  static_assert(kDistanceError == 0x1p-16F);

  enum class Verdict { miss, hit, doubt };

  explicit WatertightTester(const scene::Ray& ray) : ray_(ray) {
    const glm::vec3& d = ray.direction;
    const glm::vec3 size{std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)};
    kz_ = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    kx_ = kz_ == 2 ? 0 : kz_ + 1;
    ky_ = kx_ == 2 ? 0 : kx_ + 1;
    // Directions whose length or its reciprocal is near the ends of the range: everything is a
    // doubt, as comparisons with NaN are false.
    const bool plain = size[kz_] > kSmall && size[kz_] < kLarge;
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    shear_x_ = plain ? d[kx_] / d[kz_] : kNaN;
    shear_y_ = plain ? d[ky_] / d[kz_] : kNaN;
    scale_ = 1.0F / d[kz_];
  }

  /// How far to search for a hit that is to replace one at `best`: no less than the true distance
  /// of that one, so nothing is passed over that precise arithmetic would visit.
  static float reach(float best) { return best * (1.0F + 2 * kDistanceError); }

  /// Tests one triangle; true if it became the best hit.
  bool test(const scene::Triangle* triangles, std::uint32_t index, scene::Hit& best) const {
    Weights w;
    const Verdict verdict = judge(triangles[index], w);
    if (verdict == Verdict::miss) return false;
    return accept(triangles, index, verdict, w, best);
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

  /// What single precision alone says of a triangle, its distance aside.
  [[nodiscard]] Verdict judge(const scene::Triangle& triangle) const {
    Weights unused;
    return judge(triangle, unused);
  }
  /// Whether the test of this triangle takes double precision, a near tie with another hit aside.
  [[nodiscard]] bool doubtful(const scene::Triangle& triangle) const {
    Weights w;
    float t;
    const Verdict verdict = judge(triangle, w);
    return verdict == Verdict::doubt ||
           (verdict == Verdict::hit && distance(triangle, t) == Verdict::doubt);
  }

 private:
  /// Edge functions: unnormalised barycentric weights of the vertices.
  struct Weights {
    float a, b, c;
  };

  static constexpr float kSmall = ENCORE_WATERTIGHT_SMALL;
  static constexpr float kLarge = ENCORE_WATERTIGHT_LARGE;
  static_assert(kSmall == 0x1p-100F && kLarge == 0x1p+100F);
  static_assert(ENCORE_WATERTIGHT_RESULT * ENCORE_WATERTIGHT_ERROR == 2 * 16 * 0x1p-24F);
  static_assert(ENCORE_WATERTIGHT_EDGE_SMALL == 0x1p-40F &&
                ENCORE_WATERTIGHT_EDGE_LARGE == 0x1p+40F);

  static float largest(float a, float b, float c) {
    return std::max(std::fabs(a), std::max(std::fabs(b), std::fabs(c)));
  }

  /// How far rounding of the normal may move the heights of points of the triangle, in units of the
  /// roundoff.
  static float normal_error(const glm::vec3& e1, const glm::vec3& e2, float edge) {
    const auto magnitude = [](float p, float q) { return std::fabs(p) + std::fabs(q); };
    const auto wider = [](float p, float q) { return std::max(std::fabs(p), std::fabs(q)); };
    const float x = magnitude(e1.y * e2.z, e1.z * e2.y) * wider(e1.x, e2.x);
    const float y = magnitude(e1.z * e2.x, e1.x * e2.z) * wider(e1.y, e2.y);
    const float z = magnitude(e1.x * e2.y, e1.y * e2.x) * wider(e1.z, e2.z);
    return ENCORE_WATERTIGHT_NORMAL * std::max(x, std::max(y, z)) +
           ENCORE_WATERTIGHT_NORMAL_UNDERFLOW * edge;
  }

  [[nodiscard]] Verdict judge(const scene::Triangle& t, Weights& w) const {
    const glm::vec3 a = t.v0 - ray_.origin;
    const glm::vec3 b = t.v1 - ray_.origin;
    const glm::vec3 c = t.v2 - ray_.origin;
    const float ax = a[kx_] - shear_x_ * a[kz_], ay = a[ky_] - shear_y_ * a[kz_];
    const float bx = b[kx_] - shear_x_ * b[kz_], by = b[ky_] - shear_y_ * b[kz_];
    const float cx = c[kx_] - shear_x_ * c[kz_], cy = c[ky_] - shear_y_ * c[kz_];
    w = {cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax};
    const float lateral = std::max(largest(ax, bx, cx), largest(ay, by, cy));
    const float along = largest(a[kz_], b[kz_], c[kz_]);
    const float error =
        ENCORE_WATERTIGHT_RESULT * lateral * (lateral + along) * ENCORE_WATERTIGHT_ERROR +
        ENCORE_FILTER_UNDERFLOW;
    const float low = std::min(w.a, std::min(w.b, w.c));
    const float high = std::max(w.a, std::max(w.b, w.c));
    if (low < -error && high > error) return Verdict::miss;
    return low > error || high < -error ? Verdict::hit : Verdict::doubt;
  }

  /// The distance of a certain hit, within the bound; a miss if it is certainly not on the ray.
  [[nodiscard]] Verdict distance(const scene::Triangle& triangle, float& t) const {
    const glm::vec3 a = triangle.v0 - ray_.origin;
    const glm::vec3 e1 = triangle.v1 - triangle.v0;
    const glm::vec3 e2 = triangle.v2 - triangle.v0;
    const glm::vec3 n{e1.y * e2.z - e1.z * e2.y, e1.z * e2.x - e1.x * e2.z,
                      e1.x * e2.y - e1.y * e2.x};
    const glm::vec3 height{n.x * a.x, n.y * a.y, n.z * a.z};
    const glm::vec3 slope{n[kx_] * shear_x_, n[ky_] * shear_y_, n[kz_]};
    const float above = height.x + height.y + height.z;
    const float down = slope.x + slope.y + slope.z;
    const float edge = std::max(largest(e1.x, e1.y, e1.z), largest(e2.x, e2.y, e2.z));
    const float heights = std::fabs(height.x) + std::fabs(height.y) + std::fabs(height.z);
    const float slopes = std::fabs(slope.x) + std::fabs(slope.y) + std::fabs(slope.z);
    // In units of the roundoff: 256 of them are the bound.
    const bool sure = edge > ENCORE_WATERTIGHT_EDGE_SMALL && edge < ENCORE_WATERTIGHT_EDGE_LARGE &&
                      std::fabs(above) > kSmall && std::fabs(down) > kSmall &&
                      normal_error(e1, e2, edge) + 5.0F * heights < 128.0F * std::fabs(above) &&
                      5.0F * slopes < 120.0F * std::fabs(down);
    if (!sure) return Verdict::doubt;
    t = above / down * scale_;
    const float size = std::fabs(t);
    if (!(size > kSmall && size < kLarge)) return Verdict::doubt;
    if (std::fabs(t - ray_.t_min) <= kSameDistance * size ||
        std::fabs(t - ray_.t_max) <= kSameDistance * size) {
      return Verdict::doubt;
    }
    return t > ray_.t_min && t < ray_.t_max ? Verdict::hit : Verdict::miss;
  }

  /// Holds a triangle that is not certainly missed against the best hit; see
  /// triangle_watertight.cpp.
  bool accept(const scene::Triangle* triangles, std::uint32_t index, Verdict verdict,
              const Weights& w, scene::Hit& best) const;

#if defined(__SSE2__)
  bool test_four(const scene::Triangle* triangles, const std::uint32_t* references,
                 std::uint32_t first, std::uint32_t count, scene::Hit& best) const {
    // A last group of two or three repeats its last triangle.
    const FourTriangles four(triangles, references, first, count);
    const FourPoints a = four.v0 - ray_.origin;
    const FourPoints b = four.v1 - ray_.origin;
    const FourPoints c = four.v2 - ray_.origin;
    const __m128 sx = _mm_set1_ps(shear_x_), sy = _mm_set1_ps(shear_y_);
    const auto sheared = [](__m128 x, __m128 s, __m128 z) {
      return _mm_sub_ps(x, _mm_mul_ps(s, z));
    };
    const __m128 ax = sheared(a[kx_], sx, a[kz_]), ay = sheared(a[ky_], sy, a[kz_]);
    const __m128 bx = sheared(b[kx_], sx, b[kz_]), by = sheared(b[ky_], sy, b[kz_]);
    const __m128 cx = sheared(c[kx_], sx, c[kz_]), cy = sheared(c[ky_], sy, c[kz_]);
    const __m128 wa = difference(cx, by, cy, bx);
    const __m128 wb = difference(ax, cy, ay, cx);
    const __m128 wc = difference(bx, ay, by, ax);
    const __m128 lateral = _mm_max_ps(accel::largest(ax, bx, cx), accel::largest(ay, by, cy));
    const __m128 along = accel::largest(a[kz_], b[kz_], c[kz_]);
    const __m128 result = _mm_mul_ps(_mm_mul_ps(_mm_set1_ps(ENCORE_WATERTIGHT_RESULT), lateral),
                                     _mm_add_ps(lateral, along));
    const __m128 error = _mm_add_ps(_mm_mul_ps(result, _mm_set1_ps(ENCORE_WATERTIGHT_ERROR)),
                                    _mm_set1_ps(ENCORE_FILTER_UNDERFLOW));
    const __m128 minus_error = _mm_xor_ps(error, _mm_set1_ps(-0.0F));
    const __m128 low = _mm_min_ps(wa, _mm_min_ps(wb, wc));
    const __m128 high = _mm_max_ps(wa, _mm_max_ps(wb, wc));
    const __m128 missed = _mm_and_ps(_mm_cmplt_ps(low, minus_error), _mm_cmpgt_ps(high, error));
    unsigned left = (static_cast<unsigned>(_mm_movemask_ps(missed)) ^ 0xFU) & four.lanes;
    if (left == 0) return false;

    const auto sure = static_cast<unsigned>(
        _mm_movemask_ps(_mm_or_ps(_mm_cmpgt_ps(low, error), _mm_cmplt_ps(high, minus_error))));
    alignas(16) float weights[3][4];
    _mm_store_ps(weights[0], wa);
    _mm_store_ps(weights[1], wb);
    _mm_store_ps(weights[2], wc);
    bool changed = false;
    for (; left != 0; left &= left - 1) {
      const auto lane = static_cast<unsigned>(__builtin_ctz(left));
      const Verdict verdict = (sure >> lane & 1U) != 0 ? Verdict::hit : Verdict::doubt;
      changed |= accept(triangles, four.index[lane], verdict,
                        {weights[0][lane], weights[1][lane], weights[2][lane]}, best);
    }
    return changed;
  }
#endif

  const scene::Ray& ray_;
  int kx_, ky_, kz_;
  float shear_x_, shear_y_, scale_;
};

}  // namespace encore::accel
