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

/// Fills in rays, places must be there, and no hits.
inline void load_rays(const scene::Ray* rays, RayPacket& packet) {
  for (int i = 0; i < kPacketRays; i += 4) {
    Floats<4> low[4], high[4];
    for (int k = 0; k < 4; ++k) {
      const auto* ray = reinterpret_cast<const float*>(rays + packet.place[i + k]);
      low[k] = Floats<4>::load(ray);
      high[k] = Floats<4>::load(ray + 4);
    }
    transpose(low[0], low[1], low[2], low[3]);
    transpose(high[0], high[1], high[2], high[3]);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis].store(packet.origin[axis] + i);
      high[axis].store(packet.direction[axis] + i);
    }
    low[3].store(packet.t_min + i);
    high[3].store(packet.t + i);
    Floats<4>::all_bits(scene::kNoHit).store(packet.triangle + i);
    Floats<4>::all(0.0F).store(packet.u + i);
    Floats<4>::all(0.0F).store(packet.v + i);
  }
}

inline void store_hits(const RayPacket& packet, scene::Hit* hits) {
  for (int i = 0; i < kPacketRays; i += 4) {
    Floats<4> t = Floats<4>::load(packet.t + i), triangle = Floats<4>::load(packet.triangle + i);
    Floats<4> u = Floats<4>::load(packet.u + i), v = Floats<4>::load(packet.v + i);
    transpose(t, triangle, u, v);
    t.store(hits + packet.place[i]);
    triangle.store(hits + packet.place[i + 1]);
    u.store(hits + packet.place[i + 2]);
    v.store(hits + packet.place[i + 3]);
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

}  // namespace encore::accel::ENCORE_ISA
