#pragma once

#include "accel/four_triangles.h"
#include "accel/triangle_hit.h"
#include "shaders/shared/tolerance.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace encore::accel {

/// Tests triangles against one ray: a single-precision Möller–Trumbore test (1997) throws out what
/// is certainly missed, decide_hit() judges the rest. The filter carries a bound of its own
/// rounding errors, so it can never throw out a hit, and what it lets through by mistake costs
/// time, not correctness: results do not depend on it, nor on how many triangles go at once.
///
/// Error bound: with unit roundoff r, every sum of products below is off by at most 42 r times
/// (largest direction component) * (largest edge component) * (largest of edge and origin-to-vertex
/// component); the test on u + v <= det adds three of those. The direction is scaled by a power of
/// two so that its largest component lies in [1, 2); then 32 * edge * reach exceeds every
/// intermediate result, and computing the bound through it makes the bound infinite, which rejects
/// nothing, whenever one of them may have overflowed. kUnderflow covers products that fall below
/// the normal range.
class TriangleFilter {
 public:
  explicit TriangleFilter(const scene::Ray& ray)
      : ray_(ray), direction_(scaled_to_one(ray.direction)) {}

  /// How far to search for a hit that is to replace one at `best` (triangle_tester.h).
  static float reach(float best) { return best; }

  /// Tests one triangle; true if it became the best hit.
  bool test(const scene::Triangle* triangles, std::uint32_t index, scene::Hit& best) const {
    const scene::Triangle& triangle = triangles[index];
    if (certainly_missed(triangle)) return false;
    return decide_hit(ray_, triangle, index, best);
  }

  /// Tests triangles[references[0 .. count)]; true if the best hit changed.
  bool test(const scene::Triangle* triangles, const std::uint32_t* references, std::uint32_t count,
            scene::Hit& best) const {
    bool changed = false;
#if defined(__SSE2__)
    std::uint32_t i = 0;
    for (; i + 2 <= count; i += 4) {
      // A last group of two or three repeats its last triangle.
      const std::uint32_t last = count - 1;
      const std::uint32_t four[4] = {references[i], references[i + 1],
                                     references[std::min(i + 2, last)],
                                     references[std::min(i + 3, last)]};
      unsigned candidates = candidates_of_four(triangles, four);
      if (count - i < 4) candidates &= (1U << (count - i)) - 1U;
      while (candidates != 0) {
        const auto lane = static_cast<unsigned>(__builtin_ctz(candidates));
        candidates &= candidates - 1;
        changed |= decide_hit(ray_, triangles[four[lane]], four[lane], best);
      }
    }
    if (i < count) changed |= test(triangles, references[i], best);
#else
    for (std::uint32_t i = 0; i < count; ++i) changed |= test(triangles, references[i], best);
#endif
    return changed;
  }

 private:
  static constexpr float kLargestResult = ENCORE_FILTER_LARGEST;
  static constexpr float kErrorFactor = ENCORE_FILTER_ERROR;
  static constexpr float kUnderflow = ENCORE_FILTER_UNDERFLOW;
  static_assert(kErrorFactor == 2 * 136 * 0x1p-24F / kLargestResult && kUnderflow == 0x1p-116F);

  static float largest(const glm::vec3& v) {
    return std::max(std::fabs(v.x), std::max(std::fabs(v.y), std::fabs(v.z)));
  }

  /// The direction times a power of two that brings its largest component into [1, 2); directions
  /// below the normal range end up smaller, which is as good.
  static glm::vec3 scaled_to_one(const glm::vec3& direction) {
    const auto exponent = std::bit_cast<std::uint32_t>(largest(direction)) >> 23U;
    const auto scale = std::bit_cast<double>(std::uint64_t{1023 + 127 - exponent} << 52U);
    return glm::vec3(glm::dvec3(direction) * scale);
  }

  [[nodiscard]] bool certainly_missed(const scene::Triangle& t) const {
    const glm::vec3 e1 = t.v1 - t.v0;
    const glm::vec3 e2 = t.v2 - t.v0;
    const glm::vec3 s = ray_.origin - t.v0;
    const glm::vec3& d = direction_;
    const glm::vec3 p{d.y * e2.z - d.z * e2.y, d.z * e2.x - d.x * e2.z, d.x * e2.y - d.y * e2.x};
    const float edge = std::max(largest(e1), largest(e2));
    const float error =
        kLargestResult * edge * std::max(edge, largest(s)) * kErrorFactor + kUnderflow;
    float det = e1.x * p.x + e1.y * p.y + e1.z * p.z;
    float u = s.x * p.x + s.y * p.y + s.z * p.z;
    if (det < 0) {
      det = -det;
      u = -u;
    }
    if (!(det > error)) return false;
    if (u < -error || u > det + error) return true;
    const glm::vec3 q{s.y * e1.z - s.z * e1.y, s.z * e1.x - s.x * e1.z, s.x * e1.y - s.y * e1.x};
    float v = d.x * q.x + d.y * q.y + d.z * q.z;
    // The sign of det was folded into u above; v needs the same.
    if (e1.x * p.x + e1.y * p.y + e1.z * p.z < 0) v = -v;
    return v < -error || u + v > det + error;
  }

#if defined(__SSE2__)
  /// The same test on four triangles; bit i is set unless triangle i is certainly missed.
  [[nodiscard]] unsigned candidates_of_four(const scene::Triangle* triangles,
                                            const std::uint32_t* four) const {
    __m128 v0x, v0y, v0z, v1x, v1y, v1z, v2x, v2y, v2z;
    gather_corners(triangles, four, 0, v0x, v0y, v0z);
    gather_corners(triangles, four, 1, v1x, v1y, v1z);
    gather_corners(triangles, four, 2, v2x, v2y, v2z);
    const __m128 e1x = _mm_sub_ps(v1x, v0x), e1y = _mm_sub_ps(v1y, v0y), e1z = _mm_sub_ps(v1z, v0z);
    const __m128 e2x = _mm_sub_ps(v2x, v0x), e2y = _mm_sub_ps(v2y, v0y), e2z = _mm_sub_ps(v2z, v0z);
    const __m128 sx = _mm_sub_ps(_mm_set1_ps(ray_.origin.x), v0x);
    const __m128 sy = _mm_sub_ps(_mm_set1_ps(ray_.origin.y), v0y);
    const __m128 sz = _mm_sub_ps(_mm_set1_ps(ray_.origin.z), v0z);
    const __m128 dx = _mm_set1_ps(direction_.x);
    const __m128 dy = _mm_set1_ps(direction_.y);
    const __m128 dz = _mm_set1_ps(direction_.z);

    const __m128 px = difference(dy, e2z, dz, e2y);
    const __m128 py = difference(dz, e2x, dx, e2z);
    const __m128 pz = difference(dx, e2y, dy, e2x);
    const __m128 det_signed = dot(e1x, e1y, e1z, px, py, pz);
    const __m128 sign_bit = _mm_set1_ps(-0.0F);
    const __m128 sign = _mm_and_ps(det_signed, sign_bit);
    const __m128 det = _mm_xor_ps(det_signed, sign);
    const __m128 u = _mm_xor_ps(dot(sx, sy, sz, px, py, pz), sign);
    const __m128 qx = difference(sy, e1z, sz, e1y);
    const __m128 qy = difference(sz, e1x, sx, e1z);
    const __m128 qz = difference(sx, e1y, sy, e1x);
    const __m128 v = _mm_xor_ps(dot(dx, dy, dz, qx, qy, qz), sign);

    const __m128 edge = _mm_max_ps(accel::largest(e1x, e1y, e1z), accel::largest(e2x, e2y, e2z));
    const __m128 reach = _mm_max_ps(edge, accel::largest(sx, sy, sz));
    const __m128 largest_result = _mm_mul_ps(_mm_mul_ps(_mm_set1_ps(kLargestResult), edge), reach);
    const __m128 error =
        _mm_add_ps(_mm_mul_ps(largest_result, _mm_set1_ps(kErrorFactor)), _mm_set1_ps(kUnderflow));
    const __m128 minus_error = _mm_xor_ps(error, sign_bit);
    const __m128 outside =
        _mm_or_ps(_mm_or_ps(_mm_cmplt_ps(u, minus_error), _mm_cmplt_ps(v, minus_error)),
                  _mm_cmpgt_ps(_mm_add_ps(u, v), _mm_add_ps(det, error)));
    const __m128 missed = _mm_and_ps(outside, _mm_cmpgt_ps(det, error));
    return static_cast<unsigned>(_mm_movemask_ps(missed)) ^ 0xFU;
  }
#endif

  const scene::Ray& ray_;
  glm::vec3 direction_;  // for the filter only: scaled
};

}  // namespace encore::accel
