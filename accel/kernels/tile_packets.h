#pragma once

#include "accel/kernels/wide_tile_doubts.h"
#include "accel/kernels/wide_tile_exact.h"
#include "accel/kernels/wide_tile_frustum.h"
#include "accel/kernels/wide_tile_triangles.h"
#include "accel/simd/tile_job.h"

namespace encore::accel::ENCORE_ISA {

/// A packet as the thesis' structures trace it: 64 rays, the frustum around them, and the tests of
/// one triangle against all that may meet it.
template <class TesterType, bool kAnyHitOf, bool kCommonOf>
class TilePacket {
 public:
  using Tester = TesterType;
  using F = Floats<kLanes>;
  using Rays = Mask<kLanes>;
  static constexpr bool kAnyHit = kAnyHitOf;

  TilePacket(const scene::Triangle* triangles, const scene::Ray* rays, RayPacket& packet,
             PacketFrustums& frustums)
      : packet_(packet), frustums_(frustums), scene_{WideView{}, triangles, rays} {
    for (int group = 0; group < kGroups; ++group) limit_group(group);
    limit_whole();
  }

  [[nodiscard]] const RayPacket& packet() const { return packet_; }
  [[nodiscard]] const PacketFrustums& frustums() const { return frustums_; }
  [[nodiscard]] const scene::Triangle& triangle(std::uint32_t id) const {
    return scene_.triangles[id];
  }
  /// How far along the frustum's axis the packet still has to be followed.
  [[nodiscard]] float limit() const { return limit_; }
  /// Whether the rays have turned out to have so little in common that each costs less alone. What
  /// was found so far is then lost.
  [[nodiscard]] bool scattered() const {
    return tests_ > kLeastTests && lanes_ < kLeastLanes * tests_;
  }
  /// How far each ray of a group has to be followed.
  [[gnu::always_inline]] F reach(int group) const {
    return F::load(packet_.t + group * kLanes) * F::all(Tester::kReach);
  }

  /// Which of a group's rays meet a box before their best hits, as a slab test of each alone.
  [[gnu::always_inline]] Rays meets_box(int group, const float* low, const float* high) const {
    const int first = group * kLanes;
    F enter = F::load(packet_.t_min + first);
    F leave = reach(group);
    for (int axis = 0; axis < 3; ++axis) {
      const F origin = F::load(packet_.origin[axis] + first);
      const F inverse = F::load(packet_.inverse[axis] + first);
      const F lower = (F::all(low[axis]) - origin) * inverse;
      const F upper = (F::all(high[axis]) - origin) * inverse;
      // In this order: what is not a number never excludes.
      enter = max(min(upper, lower), enter);
      leave = min(max(lower, upper), leave);
    }
    return enter * F::all(kNarrow) <= leave * F::all(kWiden);
  }

  /// Holds a triangle against the `active` rays of all groups; limits follow.
  [[gnu::always_inline]] void test(std::uint32_t id, const Rays (&active)[kGroups]) {
    PreparedBlock block;
    prepare_one(scene_.triangles[id], block);
    ++tests_;
    unsigned changed = 0;
    for (int group = 0; group < kGroups; ++group) {
      const unsigned bits = active[group].bits();
      if (bits == 0) continue;
      lanes_ += static_cast<unsigned>(__builtin_popcount(bits));
      const GroupRays rays{packet_, group * kLanes};
      if (Tester::template test<kAnyHit, kCommonOf>(scene_, block, &id, rays, active[group], 1U)) {
        changed |= 1U << group;
      }
    }
    if (changed == 0) return;
    for (; changed != 0; changed &= changed - 1) limit_group(__builtin_ctz(changed));
    limit_whole();
  }

 private:
  /// The triangle alone in the block's first lane; operation for operation prepare().
  [[gnu::always_inline]] void prepare_one(const scene::Triangle& t, PreparedBlock& to) const {
    const auto four = [](const glm::vec3& v) { return Points<4>::all(v); };
    const Points<4> v0 = four(t.v0);
    prepare<kCommonOf, Tester::kFilter>(v0, four(t.v1) - v0, four(t.v2) - v0, packet_, to);
    to.count = 1;
    to.corners = &t.v0.x;
    to.next_vertex = static_cast<int>(sizeof(scene::Triangle) / sizeof(float) / 3);
    to.next_axis = 1;
  }

  [[gnu::always_inline]] void limit_group(int group) {
    const int first = group * kLanes;
    F limit = reach(group) * F::load(frustums_.along + first);
    if constexpr (!kCommonOf) limit = limit + F::load(frustums_.start + first);
    group_limit_[group] = greatest_of(limit) * kWiden + kTinyLength;
  }
  [[gnu::always_inline]] void limit_whole() {
    frustums_.groups.limit = Floats<kGroups>::load(group_limit_);
    limit_ = greatest_of(frustums_.groups.limit);
  }

  static constexpr unsigned kLeastTests = 48, kLeastLanes = 2;

  RayPacket& packet_;
  PacketFrustums& frustums_;
  TraceScene scene_;
  unsigned tests_ = 0;  ///< of a triangle against some rays
  unsigned lanes_ = 0;  ///< those rays, summed
  float limit_ = 0;
  alignas(64) float group_limit_[kGroups];
};

/// 1 / direction, NaN where that leaves the normal range. For zeros infinite: plane_inverse() if
/// `keep_sign`, else slab_inverse().
inline void set_packet_inverses(RayPacket& packet, bool keep_sign) {
  using F = Floats<kLanes>;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < kPacketRays; i += kLanes) {
      const F direction = F::load(packet.direction[axis] + i);
      const F inverse = F::all(1.0F) / direction;
      const F size = abs(inverse);
      const auto normal = (size >= F::all(0x1p-126F)) & (size <= F::all(0x1.fffffep+127F));
      const F infinite = keep_sign ? inverse : F::all(__builtin_inff());
      const F odd = select(direction == F::all(0.0F), infinite, F::all(__builtin_nanf("")));
      select(normal, inverse, odd).store(packet.inverse[axis] + i);
    }
  }
}

/// How a mode finds hits, in the order of IntersectionMode, and what it then tells of them.
template <int kMode>
struct TilePlan {
  using Tester = DoubtingPackets<kMode == 0>;
  static void finish(const scene::Triangle* triangles, const scene::Ray* rays, RayPacket& packet) {
    if (kMode == 0) settle_precise(TraceScene{WideView{}, triangles, rays}, packet);
  }
};
template <>
struct TilePlan<1> {
  using Tester = MollerTrumborePackets;
  static void finish(const scene::Triangle*, const scene::Ray*, RayPacket&) {}
};

/// Traces one packet by Trace<TilePacket>(view, packet).run(); false if its rays are too different
/// and have to be traced alone.
template <template <class> class Trace, class Tester, bool kAnyHit, class View>
bool trace_tile_packet(const View& view, const scene::Triangle* triangles, const scene::Ray* rays,
                       RayPacket& packet) {
  if (!fill_idle_rays(packet)) return true;
  PacketFrustums frustums;
  if (!frustums.set(packet)) return false;
  if constexpr (Tester::kFilter) set_settling(packet, frustums.common_origin);
  const auto run = [&](auto& tile) {
    Trace<std::remove_reference_t<decltype(tile)>> trace(view, tile);
    return trace.run();
  };
  constexpr bool kKeepSign = Trace<TilePacket<Tester, kAnyHit, true>>::kKeepSign;
  set_packet_inverses(packet, kKeepSign);
  if (frustums.common_origin) {
    TilePacket<Tester, kAnyHit, true> tile(triangles, rays, packet, frustums);
    return run(tile);
  }
  TilePacket<Tester, kAnyHit, false> tile(triangles, rays, packet, frustums);
  return run(tile);
}

/// All packets of a rectangle: 8 x 8 rays where it has room for that, else whatever shape fits.
template <template <class> class Trace, int kMode, bool kAnyHit, class View>
void trace_tile(const View& view, const TileJob& job) {
  using Plan = TilePlan<kMode>;
  std::size_t columns = 8;
  while (columns > 1 && columns / 2 >= job.width) columns /= 2;
  while (columns < kPacketRays && kPacketRays / columns / 2 >= job.height) columns *= 2;
  const std::size_t rows = kPacketRays / columns;
  const auto left = [](std::size_t whole, std::size_t from, std::size_t most) {
    return whole - from < most ? whole - from : most;
  };
  RayPacket packet;
  std::size_t set_columns = 0, set_rows = 0;
  for (std::size_t y = 0; y < job.height; y += rows) {
    const std::size_t has_rows = left(job.height, y, rows);
    for (std::size_t x = 0; x < job.width; x += columns) {
      const std::size_t has_columns = left(job.width, x, columns);
      if (has_rows != set_rows || has_columns != set_columns) {
        set_places(job.width, static_cast<std::uint32_t>(columns),
                   static_cast<std::uint32_t>(has_columns), static_cast<std::uint32_t>(has_rows),
                   packet.place);
        set_rows = has_rows;
        set_columns = has_columns;
      }
      const std::size_t first = y * job.width + x;
      const scene::Ray* const rays = job.rays + first;
      const auto prefetch = [&](const auto* answers) {
        prefetch_packet(job.rays, answers, x, y, job.width, static_cast<std::uint32_t>(columns),
                        static_cast<std::uint32_t>(rows));
      };
      if constexpr (kAnyHit) {
        prefetch(job.blocked);
      } else {
        prefetch(job.hits);
      }
      load_rays(rays, packet);
      if (trace_tile_packet<Trace, typename Plan::Tester, kAnyHit>(view, job.triangles, rays,
                                                                   packet)) {
        if (kAnyHit) {
          store_blocked(packet, job.blocked + first);
        } else {
          Plan::finish(job.triangles, rays, packet);
          store_hits(packet, job.hits + first);
        }
        continue;
      }
      for (std::size_t row = 0; row < has_rows; ++row) {
        const std::size_t at = first + row * job.width;
        if (kAnyHit) {
          job.occluded(job.structure, job.rays + at, has_columns, job.blocked + at);
        } else {
          job.intersect(job.structure, job.rays + at, has_columns, job.hits + at);
        }
      }
    }
  }
}

}  // namespace encore::accel::ENCORE_ISA
