#pragma once

#include "renderer/surface_light.h"

#if defined(__SSE2__)
#include <emmintrin.h>

namespace encore::renderer {

/// Two doubles, one of each surface.
struct PairOfDoubles {
  __m128d v;
  static PairOfDoubles all(double x) { return {_mm_set1_pd(x)}; }
  friend PairOfDoubles operator+(PairOfDoubles a, PairOfDoubles b) {
    return {_mm_add_pd(a.v, b.v)};
  }
  friend PairOfDoubles operator-(PairOfDoubles a, PairOfDoubles b) {
    return {_mm_sub_pd(a.v, b.v)};
  }
  friend PairOfDoubles operator*(PairOfDoubles a, PairOfDoubles b) {
    return {_mm_mul_pd(a.v, b.v)};
  }
  friend PairOfDoubles inverse_root(PairOfDoubles a) {
    return {_mm_div_pd(_mm_set1_pd(1.0), _mm_sqrt_pd(a.v))};
  }
  /// All bits where a < b.
  friend PairOfDoubles less(PairOfDoubles a, PairOfDoubles b) { return {_mm_cmplt_pd(a.v, b.v)}; }
  friend PairOfDoubles select(PairOfDoubles mask, PairOfDoubles a, PairOfDoubles b) {
    return {_mm_or_pd(_mm_and_pd(mask.v, a.v), _mm_andnot_pd(mask.v, b.v))};
  }
  [[nodiscard]] unsigned signs() const { return static_cast<unsigned>(_mm_movemask_pd(v)); }
  [[nodiscard]] double of(int i) const { return _mm_cvtsd_f64(i == 0 ? v : _mm_unpackhi_pd(v, v)); }
};

struct PairOfVectors {
  PairOfDoubles x, y, z;

  /// From two vectors, in the first three of each four floats.
  static PairOfVectors of(__m128 a, __m128 b) {
    const __m128 xy = _mm_unpacklo_ps(a, b);
    return {{_mm_cvtps_pd(xy)},
            {_mm_cvtps_pd(_mm_movehl_ps(xy, xy))},
            {_mm_cvtps_pd(_mm_unpackhi_ps(a, b))}};
  }
  static PairOfVectors all(const glm::vec3& v) {
    return {PairOfDoubles::all(v.x), PairOfDoubles::all(v.y), PairOfDoubles::all(v.z)};
  }
  friend PairOfVectors operator+(const PairOfVectors& a, const PairOfVectors& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend PairOfVectors operator-(const PairOfVectors& a, const PairOfVectors& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend PairOfVectors operator*(const PairOfVectors& a, PairOfDoubles b) {
    return {a.x * b, a.y * b, a.z * b};
  }
  friend PairOfDoubles dot(const PairOfVectors& a, const PairOfVectors& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  friend PairOfVectors cross(const PairOfVectors& a, const PairOfVectors& b) {
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
  }
  friend PairOfVectors select(PairOfDoubles mask, const PairOfVectors& a, const PairOfVectors& b) {
    return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
  }
  /// The vectors, turned round where `mask` has a sign.
  [[nodiscard]] PairOfVectors turned(PairOfDoubles mask) const {
    const __m128d sign = _mm_and_pd(mask.v, _mm_set1_pd(-0.0));
    return {{_mm_xor_pd(x.v, sign)}, {_mm_xor_pd(y.v, sign)}, {_mm_xor_pd(z.v, sign)}};
  }
};

/// lit_surface() and add_light() for two rays at once, operation for operation: the same bits.
template <ShadingNeeds kNeeds>
class SurfacePair {
 public:
  SurfacePair(const ShadingScene& input, const scene::Ray& ray_a, const scene::Hit& a,
              const scene::Ray& ray_b, const scene::Hit& b) {
    const auto* const triangles = input.triangles->triangles.data();
    const scene::Triangle &first = triangles[a.triangle], &second = triangles[b.triangle];
    set_material(*input.scene, first, 0);
    set_material(*input.scene, second, 1);
    const auto vectors = [](const glm::vec3& p, const glm::vec3& q) {
      return PairOfVectors::of(_mm_loadu_ps(&p.x), _mm_loadu_ps(&q.x));
    };
    // Each is followed by another number.
    const PairOfVectors corner = vectors(first.v0, second.v0);
    const PairOfVectors edge1 = vectors(first.v1, second.v1) - corner;
    const PairOfVectors edge2 = vectors(first.v2, second.v2) - corner;
    const PairOfDoubles everywhere = PairOfDoubles::all(-0.0), zero = PairOfDoubles::all(0.0);
    view_ = vectors(ray_a.direction, ray_b.direction).turned(everywhere);
    const PairOfDoubles u{_mm_setr_pd(a.u, b.u)}, v{_mm_setr_pd(a.v, b.v)};

    PairOfVectors normal = cross(edge1, edge2);
    normal = normal.turned(less(dot(normal, view_), zero));
    if constexpr (kNeeds.normals) {
      const auto& p = input.triangles->normals[a.triangle];
      const auto& q = input.triangles->normals[b.triangle];
      const PairOfVectors smooth = vectors(p[0], q[0]) * (PairOfDoubles::all(1.0) - u - v) +
                                   vectors(p[1], q[1]) * u +
                                   PairOfVectors::of(last_of(p), last_of(q)) * v;
      const PairOfDoubles is_there = less(zero, dot(smooth, smooth));
      normal = select(is_there, smooth.turned(less(dot(smooth, normal), zero)), normal);
    }
    const PairOfDoubles squared = dot(normal, normal);
    normal_ = select(less(zero, squared), normal * inverse_root(squared), view_);
    point_ = corner + edge1 * u + edge2 * v;
  }

  void add(const scene::Light& light, Reflected (&sums)[2]) const {
    const PairOfVectors to_light = PairOfVectors::all(light.position) - point_;
    const PairOfDoubles along_normal = dot(normal_, to_light);
    const unsigned lit = less(PairOfDoubles::all(0.0), along_normal).signs();
    if (lit == 0) return;
    const PairOfDoubles inverse_distance = inverse_root(dot(to_light, to_light));
    const PairOfDoubles cosine = along_normal * inverse_distance;
    PairOfDoubles mirrored{};
    if constexpr (kNeeds.specular) {
      mirrored = PairOfDoubles::all(2.0) * cosine * dot(normal_, view_) -
                 dot(to_light, view_) * inverse_distance;
    }
    for (int i = 0; i < 2; ++i) {
      if ((lit >> static_cast<unsigned>(i) & 1U) == 0) continue;
      sums[i].diffuse += light.color * static_cast<float>(cosine.of(i));
      if constexpr (kNeeds.specular) {
        const LitSurface& surface = surfaces_[i];
        add_highlight(surface, light, mirrored.of(i), sums[i]);
      }
    }
  }

  /// For surface_color(): point and normals are not in it.
  [[nodiscard]] const LitSurface& surface(int i) const { return surfaces_[i]; }

 private:
  void set_material(const scene::Scene& scene, const scene::Triangle& triangle, int i) {
    surfaces_[i].set_material<kNeeds>(material_of(scene, triangle));
  }
  /// The last of three corners, which nothing need follow.
  static __m128 last_of(const std::array<glm::vec3, 3>& corners) {
    const __m128 z_xyz = _mm_loadu_ps(&corners[1].z);
    return _mm_shuffle_ps(z_xyz, z_xyz, _MM_SHUFFLE(3, 3, 2, 1));
  }

  PairOfVectors point_, normal_, view_;
  LitSurface surfaces_[2];
};

}  // namespace encore::renderer

#endif
