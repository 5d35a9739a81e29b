#pragma once

#include "accel/simd/floats.h"
#include "scene/ray.h"

#include <cstddef>
#include <cstdint>

namespace encore::accel::ENCORE_ISA {

/// Rays that go through the tree together: a square of 8 x 8 where the rectangle has room for it.
inline constexpr int kPacketRays = 64;
/// The packet's rays by registers: a group each, again as square as can be.
#if defined(ENCORE_AVX512)
inline constexpr int kLanes = 16;
#elif defined(__AVX2__)
inline constexpr int kLanes = 8;
#else
inline constexpr int kLanes = 4;
#endif
inline constexpr int kGroups = kPacketRays / kLanes;

/// Of a packet's rays what doubts are settled with, in the modes that have doubts.
struct alignas(64) SettlingRays {
  /// TriangleFilter's: the direction times a power of two, its largest component in [1, 2).
  float direction[3][kPacketRays];
  /// WatertightRay's numbers, and bit by bit the rays of each group whose kz is an axis.
  float shear_x[kPacketRays], shear_y[kPacketRays], scale[kPacketRays];
  float t_max[kPacketRays];
  unsigned along[3][kGroups];
  float lowest[3], highest[3];  ///< where the rays start
};

/// 64 rays and their best hits as structure of arrays: element group * kLanes + lane.
struct alignas(64) RayPacket {
  float origin[3][kPacketRays];
  float t_min[kPacketRays];
  float direction[3][kPacketRays];
  /// Of the best hit, at first the ray's t_max; any-hit: -inf once the ray is blocked.
  float t[kPacketRays];
  std::uint32_t triangle[kPacketRays];
  float u[kPacketRays], v[kPacketRays];
  /// 1 / direction for slab tests; see slab_inverse().
  float inverse[3][kPacketRays];
  /// Where the rays come from and the hits go to. What a packet has too few of repeats others.
  std::uint32_t place[kPacketRays];
  SettlingRays settling;
};

/// Four rows of four floats become four columns.
[[gnu::always_inline]] inline void transpose(Floats<4>& a, Floats<4>& b, Floats<4>& c,
                                             Floats<4>& d) {
#if defined(__SSE4_2__)
  _MM_TRANSPOSE4_PS(a.v, b.v, c.v, d.v);
#else
  const Floats<4> rows[4] = {a, b, c, d};
  for (int i = 0; i < 4; ++i) {
    a.lane[i] = rows[i].lane[0];
    b.lane[i] = rows[i].lane[1];
    c.lane[i] = rows[i].lane[2];
    d.lane[i] = rows[i].lane[3];
  }
#endif
}

#if defined(__AVX2__)
/// The same for each four lanes of wider registers.
[[gnu::always_inline]] inline void transpose(Floats<kLanes>& a, Floats<kLanes>& b,
                                             Floats<kLanes>& c, Floats<kLanes>& d) {
#if defined(ENCORE_AVX512)
#define ENCORE_WIDE(NAME) _mm512_##NAME
#else
#define ENCORE_WIDE(NAME) _mm256_##NAME
#endif
  const auto low_ab = ENCORE_WIDE(castps_pd)(ENCORE_WIDE(unpacklo_ps)(a.v, b.v));
  const auto low_cd = ENCORE_WIDE(castps_pd)(ENCORE_WIDE(unpacklo_ps)(c.v, d.v));
  const auto high_ab = ENCORE_WIDE(castps_pd)(ENCORE_WIDE(unpackhi_ps)(a.v, b.v));
  const auto high_cd = ENCORE_WIDE(castps_pd)(ENCORE_WIDE(unpackhi_ps)(c.v, d.v));
  a.v = ENCORE_WIDE(castpd_ps)(ENCORE_WIDE(unpacklo_pd)(low_ab, low_cd));
  b.v = ENCORE_WIDE(castpd_ps)(ENCORE_WIDE(unpackhi_pd)(low_ab, low_cd));
  c.v = ENCORE_WIDE(castpd_ps)(ENCORE_WIDE(unpacklo_pd)(high_ab, high_cd));
  d.v = ENCORE_WIDE(castpd_ps)(ENCORE_WIDE(unpackhi_pd)(high_ab, high_cd));
#undef ENCORE_WIDE
}
#endif

/// A register of fours from, or to, address(0), address(1), …
template <class Address>
[[gnu::always_inline]] inline Floats<kLanes> load_fours(const Address& address) {
  const auto four = [&](int i) __attribute__((always_inline)) {
    return Floats<4>::load(address(i));
  };
#if defined(ENCORE_AVX512)
  const __m512 one = _mm512_castps128_ps512(four(0).v);
  const __m512 two = _mm512_insertf32x4(one, four(1).v, 1);
  return {_mm512_insertf32x4(_mm512_insertf32x4(two, four(2).v, 2), four(3).v, 3)};
#elif defined(__AVX2__)
  return {_mm256_insertf128_ps(_mm256_castps128_ps256(four(0).v), four(1).v, 1)};
#else
  return four(0);
#endif
}
template <class Address>
[[gnu::always_inline]] inline void store_fours(const Floats<kLanes>& fours,
                                               const Address& address) {
#if defined(ENCORE_AVX512)
  Floats<4>{_mm512_castps512_ps128(fours.v)}.store(address(0));
  Floats<4>{_mm512_extractf32x4_ps(fours.v, 1)}.store(address(1));
  Floats<4>{_mm512_extractf32x4_ps(fours.v, 2)}.store(address(2));
  Floats<4>{_mm512_extractf32x4_ps(fours.v, 3)}.store(address(3));
#elif defined(__AVX2__)
  Floats<4>{_mm256_castps256_ps128(fours.v)}.store(address(0));
  Floats<4>{_mm256_extractf128_ps(fours.v, 1)}.store(address(1));
#else
  fours.store(address(0));
#endif
}

/// Fills in rays, places must be there, and no hits.
inline void load_rays(const scene::Ray* rays, RayPacket& packet) {
  using F = Floats<kLanes>;
  for (int i = 0; i < kPacketRays; i += kLanes) {
    F low[4], high[4];
    for (int k = 0; k < 4; ++k) {
      const auto ray = [&](int four) __attribute__((always_inline)) {
        return reinterpret_cast<const float*>(rays + packet.place[i + 4 * four + k]);
      };
      low[k] = load_fours(ray);
      high[k] = load_fours([&](int four) __attribute__((always_inline)) { return ray(four) + 4; });
    }
    transpose(low[0], low[1], low[2], low[3]);
    transpose(high[0], high[1], high[2], high[3]);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis].store(packet.origin[axis] + i);
      high[axis].store(packet.direction[axis] + i);
    }
    low[3].store(packet.t_min + i);
    high[3].store(packet.t + i);
    F::all_bits(scene::kNoHit).store(packet.triangle + i);
    F::all(0.0F).store(packet.u + i);
    F::all(0.0F).store(packet.v + i);
  }
}

/// Rays that end before they begin hit nothing: they get the way of one that may, so that they do
/// not keep a packet from going together. False if there is none.
inline bool fill_idle_rays(RayPacket& packet) {
  using F = Floats<kLanes>;
  constexpr unsigned kAll = (1U << kLanes) - 1U;
  const auto active = [&](int i) __attribute__((always_inline)) {
    return F::load(packet.t_min + i) < F::load(packet.t + i);
  };
  unsigned all = kAll;
  int any = -1;
  for (int i = kPacketRays; (i -= kLanes) >= 0;) {
    const unsigned rays = active(i).bits();
    all &= rays;
    if (rays != 0) any = i + __builtin_ctz(rays);
  }
  if (all == kAll) return true;
  if (any < 0) return false;
  for (int i = 0; i < kPacketRays; i += kLanes) {
    const Mask<kLanes> rays = active(i);
    for (int axis = 0; axis < 3; ++axis) {
      float* const origin = packet.origin[axis];
      float* const direction = packet.direction[axis];
      // The one that the others follow comes to stand where it is.
      select(rays, F::load(origin + i), F::all(origin[any])).store(origin + i);
      select(rays, F::load(direction + i), F::all(direction[any])).store(direction + i);
    }
  }
  return true;
}

inline void store_hits(const RayPacket& packet, scene::Hit* hits) {
  using F = Floats<kLanes>;
  for (int i = 0; i < kPacketRays; i += kLanes) {
    F row[4] = {F::load(packet.t + i), F::load(packet.triangle + i), F::load(packet.u + i),
                F::load(packet.v + i)};
    transpose(row[0], row[1], row[2], row[3]);
    for (int k = 0; k < 4; ++k) {
      store_fours(
          row[k], [&](int four) __attribute__((always_inline)) {
            return hits + packet.place[i + 4 * four + k];
          });
    }
  }
}

inline void store_blocked(const RayPacket& packet, std::uint8_t* blocked) {
  for (int i = 0; i < kPacketRays; ++i) {
    blocked[packet.place[i]] = packet.triangle[i] != scene::kNoHit ? 1 : 0;
  }
}

/// The places of a block of rays in a rectangle `width` wide: `columns` * `rows` == kPacketRays,
/// both powers of two, of which the rectangle has only `has_columns` and `has_rows`; what is beyond
/// repeats the last column or row. Groups take squares, or two squares side by side.
inline void set_places(std::size_t width, std::uint32_t columns, std::uint32_t has_columns,
                       std::uint32_t has_rows, std::uint32_t (&place)[kPacketRays]) {
  const std::uint32_t rows = kPacketRays / columns;
  std::uint32_t group_columns = kLanes == 4 ? 2 : 4;
  if (group_columns > columns) group_columns = columns;
  if (kLanes / group_columns > rows) group_columns = kLanes / rows;
  const std::uint32_t group_rows = kLanes / group_columns;
  const std::uint32_t across = columns / group_columns;
  for (std::uint32_t i = 0; i < kPacketRays; ++i) {
    const std::uint32_t group = i / kLanes, lane = i % kLanes;
    std::uint32_t x = group % across * group_columns + lane % group_columns;
    std::uint32_t y = group / across * group_rows + lane / group_columns;
    if (x >= has_columns) x = has_columns - 1;
    if (y >= has_rows) y = has_rows - 1;
    place[i] = static_cast<std::uint32_t>(y * width + x);
  }
}

/// Has a rectangle of rays or answers, whose rows lie `width` of them apart, on its way from memory
/// while others are traced: eight rows apart are more than the processor foresees. Into the second
/// cache: so many lines on their way into the first would fill its queue, and what is traced
/// meanwhile would wait for a place in it.
template <class Element>
[[gnu::always_inline]] inline void prefetch_rows(const Element* from, std::size_t first,
                                                 std::size_t width, std::uint32_t columns,
                                                 std::uint32_t rows) {
  constexpr int kRead = 0, kSecondCache = 2;
  const auto start = reinterpret_cast<std::uintptr_t>(from) + first * sizeof(Element);
  for (std::uint32_t row = 0; row < rows; ++row) {
    const std::uintptr_t at = start + row * width * sizeof(Element);
    for (std::uint32_t i = 0; i < columns * sizeof(Element); i += 64) {
      __builtin_prefetch(reinterpret_cast<const void*>(at + i), kRead, kSecondCache);
    }
  }
}

/// The same for the rays and the places of the answers of a packet to come, some after the one
/// whose first ray is at (x, y). Behind a rectangle often comes another one; nothing is read there.
template <class Answer>
[[gnu::always_inline]] inline void prefetch_packet(const scene::Ray* rays, const Answer* answers,
                                                   std::size_t x, std::size_t y, std::size_t width,
                                                   std::uint32_t columns, std::uint32_t rows) {
  constexpr std::size_t kPacketsAhead = 4;
  const std::size_t ahead = kPacketsAhead * columns;
  const std::size_t to = x + (width < ahead ? width : ahead);
  const std::size_t first = to < width ? y * width + to : (y + rows) * width + (to - width);
  prefetch_rows(rays, first, width, columns, rows);
  prefetch_rows(answers, first, width, columns, rows);
}

}  // namespace encore::accel::ENCORE_ISA
