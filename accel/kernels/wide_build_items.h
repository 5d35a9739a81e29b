#pragma once

#include "accel/kernels/wide_build_boxes.h"

#if defined(__BMI2__)
#include <immintrin.h>
#endif

namespace encore::accel::ENCORE_ISA {

inline void bounds_of_triangles(const scene::Triangle* triangles, std::size_t begin,
                                std::size_t end, WideBox& box) {
  Floats<4> lower = lower_half(Box::load(box.ends));
  Floats<4> upper = minus(upper_half(Box::load(box.ends)));
  for (std::size_t i = begin; i < end; ++i) {
    const Floats<4> a = Floats<4>::load(&triangles[i].v0);
    const Floats<4> b = Floats<4>::load(&triangles[i].v1);
    const Floats<4> c = Floats<4>::load(&triangles[i].v2);
    lower = min(min(min(a, b), c), lower);
    upper = max(max(max(a, b), c), upper);
  }
  join(lower, minus(upper)).store(box.ends);
}

/// The box of a triangle, scaled. The fourth numbers are 0: what lies beside the corners may be any
/// bits, and arithmetic on them slow.
inline Box scaled_box(const scene::Triangle& triangle, const Box& scale, const Box& coordinates) {
  const Floats<4> a = Floats<4>::load(&triangle.v0);
  const Floats<4> b = Floats<4>::load(&triangle.v1);
  const Floats<4> c = Floats<4>::load(&triangle.v2);
  return (join(min(min(a, b), c), minus(max(max(a, b), c))) & coordinates) * scale;
}

inline Box coordinate_lanes() {
  const std::uint32_t all = 0xFFFFFFFFU;
  const std::uint32_t lanes[8] = {all, all, all, 0, all, all, all, 0};
  return Box::load(lanes);
}

inline void items_of_triangles(const scene::Triangle* triangles, std::size_t begin, std::size_t end,
                               float scale, WideItem* items, WideBox& centers) {
  const Box factor = Box::all(scale), coordinates = coordinate_lanes();
  Box points = Box::load(centers.ends);
  for (std::size_t i = begin; i < end; ++i) {
    const Box box = scaled_box(triangles[i], factor, coordinates);
    points = min(points, point_box(center(box)));
    box.store(items[i].lower);
    items[i].triangle = static_cast<std::uint32_t>(i) | WideItem::kTriangleBit;
  }
  points.store(centers.ends);
}

inline std::uint32_t code_of(const std::uint32_t* place, const WideMorton& morton) {
#if defined(__BMI2__)
  return _pdep_u32(place[0], morton.mask[0]) | _pdep_u32(place[1], morton.mask[1]) |
         _pdep_u32(place[2], morton.mask[2]);
#else
  std::uint32_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 3; ++k) code |= morton.spread[axis][k][place[axis] >> (8 * k) & 255U];
  }
  return code;
#endif
}

/// The same without tables, for a few triangles.
inline std::uint32_t deposit_code(const std::uint32_t* place, const WideMorton& morton) {
#if defined(__BMI2__)
  return code_of(place, morton);
#else
  std::uint32_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::uint32_t bits = place[axis];
    for (std::uint32_t mask = morton.mask[axis]; mask != 0; mask &= mask - 1, bits >>= 1) {
      if ((bits & 1U) != 0) code |= mask & (~mask + 1);
    }
  }
  return code;
#endif
}

/// Makes places along the axes of triangles' centres.
class Places {
 public:
  explicit Places(const WideMorton& morton)
      : factor_(Box::all(morton.unit)),
        coordinates_(coordinate_lanes()),
        first_(Floats<4>::load(morton.first)),
        scale_(Floats<4>::load(morton.scale)),
        most_(Floats<4>::load(morton.most)) {}

  void find(const scene::Triangle& triangle, std::uint32_t* places) const {
    const Box box = scaled_box(triangle, factor_, coordinates_);
    const Floats<4> place = min((center(box) - first_) * scale_, most_);
#if defined(__SSE4_2__)
    _mm_storeu_si128(reinterpret_cast<__m128i*>(places), _mm_cvttps_epi32(place.v));
#else
    for (int axis = 0; axis < 3; ++axis) {
      places[axis] = static_cast<std::uint32_t>(place.lane[axis]);
    }
#endif
  }

 private:
  Box factor_, coordinates_;
  Floats<4> first_, scale_, most_;
};

inline void keys_of_triangles(const scene::Triangle* triangles, std::size_t begin, std::size_t end,
                              const WideMorton& morton, std::uint64_t* keys) {
  const Places places(morton);
  for (std::size_t i = begin; i < end; ++i) {
    std::uint32_t place[4];
    places.find(triangles[i], place);
    keys[i] = std::uint64_t{code_of(place, morton)} << 32 | i;
  }
}

inline void centers_of_keys(const scene::Triangle* triangles, const std::uint64_t* keys,
                            std::size_t count, float unit, WideBox& centers) {
  const Box factor = Box::all(unit), coordinates = coordinate_lanes();
  Box points = empty_box();
  for (std::size_t i = 0; i < count; ++i) {
    const scene::Triangle& triangle = triangles[keys[i] & 0xFFFFFFFFU];
    points = min(points, point_box(center(scaled_box(triangle, factor, coordinates))));
  }
  points.store(centers.ends);
}

inline void refine_keys(const scene::Triangle* triangles, const std::uint64_t* keys,
                        std::size_t count, const WideMorton& morton, std::uint64_t* fine) {
  const Places places(morton);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t id = keys[i] & 0xFFFFFFFFU;
    std::uint32_t place[4];
    places.find(triangles[id], place);
    fine[i] = std::uint64_t{deposit_code(place, morton)} << 32 | id;
  }
}

}  // namespace encore::accel::ENCORE_ISA
