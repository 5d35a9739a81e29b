#pragma once

#include "accel/kernels/wide_tile_packet.h"
#include "accel/tolerance.h"
#include "shaders/shared/gpu_types.h"

namespace encore::accel::ENCORE_ISA {

/// Added where rounding is not relative: far below everything but differences of numbers near the
/// ends of the range.
inline constexpr float kTinyLength = 0x1p-120F;
inline constexpr float kTinySlope = 0x1p-100F;

/// N bundles of rays that all run up or all run down one axis w, each as the space that it sweeps:
/// with t the way along w, between origin + slope * t of the extreme origins and slopes of both
/// other axes (Wald, Boulos and Shirley 2007 bound packets by intervals; taken along w, where the
/// interval of 1 / direction is a point, they are the planes of a frustum, whatever signs the
/// other components have).
///
/// Conservative: distances and slopes are widened by far more than they were rounded.
template <int N>
struct Frustum {
  Floats<N> near_origin, far_origin;  ///< of w: what the rows of the box are relative to
  Floats<N> begin, limit;             ///< along w: where the first starts, where the last ends
  /// Of the rows u lower, u -upper, v lower, v -upper.
  Floats<N> origin[4], slope[4];

  /// Which bundles may meet which boxes before their limit: box_row(k) gives the rows w near, w far
  /// and those above. `enter`: where, along w.
  template <class BoxRow>
  [[gnu::always_inline]] Mask<N> meets(const BoxRow& box_row, Floats<N>& enter) const {
    enter = max((box_row(0) - near_origin) * Floats<N>::all(kNarrow), begin);
    const Floats<N> minus_far = (box_row(1) - far_origin) * Floats<N>::all(kWiden);
    const Floats<N> leave = min(minus_far ^ Floats<N>::all(-0.0F), limit);
    const auto inside = [&](int k) {
      return box_row(2 + k) - origin[k] <= max(slope[k] * enter, slope[k] * leave);
    };
    return (enter <= leave) & inside(0) & inside(1) & inside(2) & inside(3);
  }
};

/// Least and greatest of something.
template <int N>
struct Range {
  Floats<N> least, greatest;
};

/// The range of each group of `values`.
[[gnu::always_inline]] inline Range<kGroups> group_ranges(const float* values) {
  constexpr int kParts = kLanes / 4;
  alignas(64) float least[kGroups], greatest[kGroups];
  for (int four = 0; four < kGroups; four += 4) {
    Floats<4> low[4], high[4];
    for (int k = 0; k < 4; ++k) {
      const float* const group = values + (four + k) * kLanes;
      low[k] = high[k] = Floats<4>::load(group);
      for (int part = 1; part < kParts; ++part) {
        const Floats<4> more = Floats<4>::load(group + 4 * part);
        low[k] = min(low[k], more);
        high[k] = max(high[k], more);
      }
    }
    transpose(low[0], low[1], low[2], low[3]);
    transpose(high[0], high[1], high[2], high[3]);
    min(min(low[0], low[1]), min(low[2], low[3])).store(least + four);
    max(max(high[0], high[1]), max(high[2], high[3])).store(greatest + four);
  }
  return {Floats<kGroups>::load(least), Floats<kGroups>::load(greatest)};
}

/// The greatest of N numbers, none of them NaN.
template <int N>
[[gnu::always_inline]] inline float greatest_of(const Floats<N>& values) {
  if constexpr (N > 4) {
    alignas(64) float lane[N];
    values.store(lane);
    Floats<4> four = Floats<4>::load(lane);
    for (int i = 4; i < N; i += 4) four = max(four, Floats<4>::load(lane + i));
    return greatest_of(four);
  } else {
#if defined(__SSE4_2__)
    const __m128 two = _mm_max_ps(values.v, _mm_movehl_ps(values.v, values.v));
    return _mm_cvtss_f32(_mm_max_ss(two, _mm_movehdup_ps(two)));
#else
    const float* const lane = values.lane;
    const float low = lane[0] > lane[1] ? lane[0] : lane[1];
    const float high = lane[2] > lane[3] ? lane[2] : lane[3];
    return low > high ? low : high;
#endif
  }
}
template <int N>
[[gnu::always_inline]] inline float least_of(const Floats<N>& values) {
  return -greatest_of(Floats<N>::all(0.0F) - values);
}
#if defined(ENCORE_AVX512)
template <>
[[gnu::always_inline]] inline float greatest_of(const Floats<16>& values) {
  const __m256 high = _mm512_extractf32x8_ps(values.v, 1);
  const __m256 eight = _mm256_max_ps(_mm512_castps512_ps256(values.v), high);
  const __m128 four = _mm_max_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps(eight, 1));
  return greatest_of(Floats<4>{four});
}
#endif

/// A packet's frustums: of the whole, for the eight boxes of a node at once, and of its groups, for
/// one box at a time.
struct PacketFrustums {
  Frustum<8> whole;
  Frustum<kGroups> groups;
  int axis[3];                             ///< w, u, v
  int rows[6];                             ///< of a gpu::WideNode, in the order of Frustum::meets()
  bool down;                               ///< all rays go down w
  bool common_origin;                      ///< all rays start at one point
  alignas(64) float along[kPacketRays];    ///< how far a ray gets along w by one t
  alignas(64) float inverse[kPacketRays];  ///< 1 / along
  /// Where along w the rays start; limits count from 0.
  alignas(64) float start[kPacketRays];

  /// False for rays that are not coherent enough to go together.
  bool set(const RayPacket& packet);

 private:
  bool set_way(const RayPacket& packet);
  bool set_slopes(const RayPacket& packet, int u, int k);
  bool find_common_origin(const RayPacket& packet) const;
  void set_common_origin(const RayPacket& packet);
  void set_origins(const RayPacket& packet);
  bool set_ends(const RayPacket& packet, float first, float last);
};

/// The widest bundle that goes together, in directions' slopes.
inline constexpr float kWidestSlopes = 0.5F;
inline constexpr float kSteepestSlope = 16.0F;

/// Chooses the axis that the first ray mostly runs along; the others must do so too.
inline bool PacketFrustums::set_way(const RayPacket& packet) {
  using F = Floats<kLanes>;
  const auto size = [&](int a) { return __builtin_fabsf(packet.direction[a][0]); };
  int w = size(0) > size(1) ? 0 : 1;
  if (size(2) > size(w)) w = 2;
  down = packet.direction[w][0] < 0.0F;
  axis[0] = w;
  axis[1] = w == 2 ? 0 : w + 1;
  axis[2] = axis[1] == 2 ? 0 : axis[1] + 1;
  const F sign = F::all(down ? -0.0F : 0.0F);
  constexpr unsigned kAll = (1U << kLanes) - 1U;
  unsigned plain = kAll;
  for (int i = 0; i < kPacketRays; i += kLanes) {
    const F a = F::load(packet.direction[w] + i) ^ sign;
    const F t = F::load(packet.t + i);
    const F sum = F::load(packet.origin[0] + i) + F::load(packet.origin[1] + i) +
                  F::load(packet.origin[2] + i);
    // What lies behind the origins is outside of the frustums.
    const auto forward = F::load(packet.t_min + i) >= F::all(0.0F);
    plain &=
        (forward & (a > F::all(0x1p-60F)) & (a < F::all(0x1p60F)) & (t == t) & (sum == sum)).bits();
    a.store(along + i);
    (F::all(1.0F) / a).store(inverse + i);
  }
  return plain == kAll;
}

template <int N>
[[gnu::always_inline]] inline Floats<N> outward(const Floats<N>& slope) {
  return slope + (abs(slope) * Floats<N>::all(kPlaneSlack) + Floats<N>::all(kTinySlope));
}

inline bool PacketFrustums::set_slopes(const RayPacket& packet, int u, int k) {
  using F = Floats<kLanes>;
  alignas(64) float slopes[kPacketRays];
  for (int i = 0; i < kPacketRays; i += kLanes) {
    (F::load(packet.direction[u] + i) * F::load(inverse + i)).store(slopes + i);
  }
  const Range<kGroups> range = group_ranges(slopes);
  const float least = least_of(range.least), greatest = greatest_of(range.greatest);
  if (!(least >= -kSteepestSlope && greatest <= kSteepestSlope &&
        greatest - least <= kWidestSlopes)) {
    return false;
  }
  groups.slope[k] = outward(range.greatest);
  groups.slope[k + 1] = outward(Floats<kGroups>::all(0.0F) - range.least);
  whole.slope[k] = outward(Floats<8>::all(greatest));
  whole.slope[k + 1] = outward(Floats<8>::all(-least));
  return true;
}

inline bool PacketFrustums::find_common_origin(const RayPacket& packet) const {
  using F = Floats<kLanes>;
  constexpr unsigned kAll = (1U << kLanes) - 1U;
  unsigned same = kAll;
  for (const auto& origin : packet.origin) {
    const F first = F::all(origin[0]);
    for (int i = 0; i < kPacketRays; i += kLanes) same &= (F::load(origin + i) == first).bits();
  }
  return same == kAll;
}

inline void PacketFrustums::set_common_origin(const RayPacket& packet) {
  using G = Floats<kGroups>;
  const float w = down ? -packet.origin[axis[0]][0] : packet.origin[axis[0]][0];
  whole.near_origin = Floats<8>::all(w);
  whole.far_origin = Floats<8>::all(-w);
  groups.near_origin = G::all(w);
  groups.far_origin = G::all(-w);
  for (int k = 0; k < 4; ++k) {
    const float o = packet.origin[axis[1 + k / 2]][0];
    const float end = (k % 2 == 0 ? o : -o) + kTinyLength;
    whole.origin[k] = Floats<8>::all(end);
    groups.origin[k] = G::all(end);
  }
}

inline void PacketFrustums::set_origins(const RayPacket& packet) {
  using G = Floats<kGroups>;
  for (int i = 0; i < 3; ++i) {
    const Range<kGroups> range = group_ranges(packet.origin[axis[i]]);
    const float least = least_of(range.least), greatest = greatest_of(range.greatest);
    const G minus_least = G::all(0.0F) - range.least;
    if (i == 0) {
      groups.near_origin = down ? minus_least : range.greatest;
      groups.far_origin = down ? range.greatest : minus_least;
      whole.near_origin = Floats<8>::all(down ? -least : greatest);
      whole.far_origin = Floats<8>::all(down ? greatest : -least);
      continue;
    }
    const int k = 2 * (i - 1);
    groups.origin[k] = range.greatest + G::all(kTinyLength);
    groups.origin[k + 1] = minus_least + G::all(kTinyLength);
    whole.origin[k] = Floats<8>::all(greatest + kTinyLength);
    whole.origin[k + 1] = Floats<8>::all(-least + kTinyLength);
  }
}

/// Rays that end, between two cross-sections: where all begin (`first`, in the packet's own
/// direction of w) and where all have ended. A line is inside of what lines through the extreme
/// points of both are, so bundles that come together, as rays towards a light do, stay as narrow as
/// they are.
inline bool PacketFrustums::set_ends(const RayPacket& packet, float first, float last) {
  using F = Floats<kLanes>;
  using G = Floats<kGroups>;
  // What taking the points may be off by, in ulps of the numbers on the way; with room.
  constexpr float kRounding = 0x1p-20F;
  const float way = last - first;
  if (!(way > 0x1p-60F && way < 0x1p60F)) return false;
  whole.near_origin = Floats<8>::all(first);
  whole.far_origin = Floats<8>::all(-first);
  groups.near_origin = G::all(first);
  groups.far_origin = G::all(-first);
  const F length = F::all(way);
  for (int k = 0; k < 4; k += 2) {
    const int u = axis[1 + k / 2];
    alignas(64) float begin[kPacketRays], end[kPacketRays];
    F size = F::all(0.0F), steepest = F::all(0.0F);
    for (int i = 0; i < kPacketRays; i += kLanes) {
      const F slope = F::load(packet.direction[u] + i) * F::load(inverse + i);
      const F origin = F::load(packet.origin[u] + i);
      const F at = origin - slope * F::load(start + i);
      at.store(begin + i);
      (at + slope * length).store(end + i);
      steepest = max(steepest, abs(slope));
      size = max(size, abs(origin));
    }
    const float steep = greatest_of(steepest);
    if (!(steep <= kSteepestSlope)) return false;
    const float slack = (greatest_of(size) + steep * way) * kRounding + kTinyLength;
    const Range<kGroups> from = group_ranges(begin), to = group_ranges(end);
    const float way_back = 1.0F / way;
    const auto upper = [&](int side, const G& group_from, const G& group_to) {
      const G a = group_from + G::all(slack), b = group_to + G::all(slack);
      groups.origin[k + side] = a;
      groups.slope[k + side] = outward((b - a) * G::all(way_back));
      const float all_a = greatest_of(a), all_b = greatest_of(b);
      whole.origin[k + side] = Floats<8>::all(all_a);
      whole.slope[k + side] = outward(Floats<8>::all((all_b - all_a) * way_back));
    };
    const G zero = G::all(0.0F);
    upper(0, from.greatest, to.greatest);
    upper(1, zero - from.least, zero - to.least);
  }
  return true;
}

inline bool PacketFrustums::set(const RayPacket& packet) {
  using F = Floats<kLanes>;
  if (!set_way(packet)) return false;
  rows[0] = 16 * axis[0] + (down ? 8 : 0);
  rows[1] = 16 * axis[0] + (down ? 0 : 8);
  for (int k = 0; k < 4; ++k) rows[2 + k] = 16 * axis[1 + k / 2] + 8 * (k % 2);

  common_origin = find_common_origin(packet);
  const F zero = F::all(0.0F);
  for (int i = 0; i < kPacketRays; i += kLanes) zero.store(start + i);
  whole.begin = Floats<8>::all(0.0F);
  groups.begin = Floats<kGroups>::all(0.0F);
  if (!common_origin) {
    // Rays that all end: along w, from the first start to the last end.
    const F sign = F::all(down ? -0.0F : 0.0F);
    F begin = F::all(__builtin_inff()), end = F::all(-__builtin_inff());
    for (int i = 0; i < kPacketRays; i += kLanes) {
      const F at = F::load(packet.origin[axis[0]] + i) ^ sign;
      begin = min(begin, at);
      end = max(end, at + F::load(packet.t + i) * F::load(along + i));
    }
    const float first = least_of(begin), last = greatest_of(end);
    if (last < 0x1p60F) {
      const F from = F::all(first);
      for (int i = 0; i < kPacketRays; i += kLanes) {
        ((F::load(packet.origin[axis[0]] + i) ^ sign) - from).store(start + i);
      }
      const float slack = (__builtin_fabsf(first) + __builtin_fabsf(last)) * 0x1p-20F;
      groups.begin = group_ranges(start).least * Floats<kGroups>::all(kNarrow);
      return set_ends(packet, first, last + slack);
    }
  }
  if (!set_slopes(packet, axis[1], 0) || !set_slopes(packet, axis[2], 2)) return false;
  if (common_origin) {
    set_common_origin(packet);
  } else {
    set_origins(packet);
  }
  return true;
}

}  // namespace encore::accel::ENCORE_ISA
