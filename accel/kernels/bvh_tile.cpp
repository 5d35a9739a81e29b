// bvh-median, rectangles of rays in packets of 64.
#include "accel/bvh/bvh_tile.h"

#include "accel/bvh/bvh_depth.h"
#include "accel/kernels/tile_packets.h"

namespace encore::accel::ENCORE_ISA {

const BvhTileKernels& bvh_tile_kernels_here();

namespace {

[[gnu::always_inline]] inline Floats<4> swap_halves(const Floats<4>& a) {
#if defined(__SSE4_2__)
  return {_mm_shuffle_ps(a.v, a.v, 0x4E)};
#else
  return {{a.lane[2], a.lane[3], a.lane[0], a.lane[1]}};
#endif
}
/// (a0, a1, a0, a1)
[[gnu::always_inline]] inline Floats<4> low_half_twice(const Floats<4>& a) {
#if defined(__SSE4_2__)
  return {_mm_movelh_ps(a.v, a.v)};
#else
  return {{a.lane[0], a.lane[1], a.lane[0], a.lane[1]}};
#endif
}

/// Frustum::meets() for the two children of a node: lanes are (left lower, right lower, -left
/// upper, -right upper) of an axis.
class PairFrustum {
 public:
  explicit PairFrustum(const PacketFrustums& of)
      : w_(of.rows[0] / 16), u_(of.rows[2] / 16), v_(of.rows[4] / 16), down_(of.rows[0] % 16 != 0) {
    const auto lane = [](const Floats<8>& all) {
      alignas(32) float lanes[8];
      all.store(lanes);
      return lanes[0];
    };
    const auto halves = [](float low, float high) {
      alignas(16) const float lanes[4] = {low, low, high, high};
      return Floats<4>::load(lanes);
    };
    w_origin_ = halves(lane(of.whole.near_origin), lane(of.whole.far_origin));
    w_factor_ = halves(kNarrow, kWiden);
    u_origin_ = halves(lane(of.whole.origin[0]), lane(of.whole.origin[1]));
    v_origin_ = halves(lane(of.whole.origin[2]), lane(of.whole.origin[3]));
    u_slope_ = halves(lane(of.whole.slope[0]), lane(of.whole.slope[1]));
    v_slope_ = halves(lane(of.whole.slope[2]), lane(of.whole.slope[3]));
  }

  /// Bit 0: left, bit 1: right. `enter`: where along w, of both.
  [[gnu::always_inline]] unsigned meets(const gpu::BvhNode* children, float limit,
                                        float (&enter)[4]) const {
    const auto* const words = reinterpret_cast<const float*>(children);
    const Floats<4> left_min = Floats<4>::load(words), left_max = Floats<4>::load(words + 4);
    const Floats<4> right_min = Floats<4>::load(words + 8), right_max = Floats<4>::load(words + 12);
    Floats<4> row[4] = {left_min, right_min, left_max, right_max};
    transpose(row[0], row[1], row[2], row[3]);
    alignas(16) static constexpr std::uint32_t kTurn[4] = {0, 0, 0x80000000U, 0x80000000U};
    const Floats<4> turn = Floats<4>::load(kTurn);
    const Floats<4> w = row[w_] ^ turn, u = row[u_] ^ turn, v = row[v_] ^ turn;
    const Floats<4> along = ((down_ ? swap_halves(w) : w) - w_origin_) * w_factor_;
    const Floats<4> enters = low_half_twice(max(along, Floats<4>::all(0.0F)));
    const Floats<4> leaves =
        low_half_twice(min(Floats<4>::all(0.0F) - swap_halves(along), Floats<4>::all(limit)));
    const Mask<4> inside = (enters <= leaves) &
                           (u - u_origin_ <= max(u_slope_ * enters, u_slope_ * leaves)) &
                           (v - v_origin_ <= max(v_slope_ * enters, v_slope_ * leaves));
    enters.store(enter);
    const unsigned bits = inside.bits();
    return bits & bits >> 2U;
  }

 private:
  int w_, u_, v_;
  bool down_;
  Floats<4> w_origin_, w_factor_;
  Floats<4> u_origin_, u_slope_, v_origin_, v_slope_;
};

/// Nodes nearest first by the frustum of the whole; at leaves the frustums of the groups, then each
/// ray by itself.
template <class Tile>
class BvhTrace {
 public:
  static constexpr bool kKeepSign = false;

  BvhTrace(const BvhTileView& view, Tile& tile)
      : view_(view), tile_(tile), pair_(tile.frustums()) {}

  bool run() {
    std::uint32_t first = view_.nodes->first;
    for (;;) {
      const gpu::BvhNode* const children = view_.nodes + first;
      alignas(16) float enter[4];
      const unsigned hits = pair_.meets(children, tile_.limit(), enter);
      if (hits == 3) {
        const int far = enter[1] < enter[0] ? 0 : 1;
        waiting_[count_++] = {children + far, enter[far]};
        waiting_[count_++] = {children + (1 - far), enter[1 - far]};
      } else if (hits != 0) {
        waiting_[count_++] = {children + (hits - 1), enter[hits - 1]};
      }
      const gpu::BvhNode* node = nullptr;
      while (count_ > 0) {
        const Waiting& next = waiting_[--count_];
        if (next.enter > tile_.limit()) continue;
        if (next.node->count != 0) {
          visit_leaf(*next.node);
          if (tile_.scattered()) return false;
          continue;
        }
        node = next.node;
        break;
      }
      if (node == nullptr) return true;
      first = node->first;
    }
  }

 private:
  struct Waiting {
    const gpu::BvhNode* node;
    float enter;
  };

  [[gnu::always_inline]] void visit_leaf(const gpu::BvhNode& leaf) {
    const PacketFrustums& frustums = tile_.frustums();
    const float* const ends[2] = {&leaf.min.x, &leaf.max.x};
    const auto row = [&](int k) {
      const int at = frustums.rows[k];
      const bool upper = at % 16 != 0;
      const float plane = ends[upper ? 1 : 0][at / 16];
      return Floats<kGroups>::all(upper ? -plane : plane);
    };
    Floats<kGroups> enter;
    const unsigned groups = frustums.groups.meets(row, enter).bits();
    Mask<kLanes> active[kGroups];
    unsigned any = 0;
    for (int group = 0; group < kGroups; ++group) {
      active[group] = Mask<kLanes>::of_bits(0);
      if ((groups >> group & 1U) == 0) continue;
      active[group] = tile_.meets_box(group, ends[0], ends[1]);
      any |= active[group].bits();
    }
    if (any != 0) tile_.test(leaf.first, active);
  }

  const BvhTileView& view_;
  Tile& tile_;
  const PairFrustum pair_;
  int count_ = 0;
  Waiting waiting_[kBvhMostDepth + 2];
};

template <int kMode, bool kAnyHit>
void trace(const BvhTileView& view, const TileJob& job) {
  trace_tile<BvhTrace, kMode, kAnyHit>(view, job);
}

}  // namespace

const BvhTileKernels& bvh_tile_kernels_here() {
  static constexpr BvhTileKernels kernels{{trace<0, false>, trace<1, false>, trace<2, false>},
                                          {trace<0, true>, trace<1, true>, trace<2, true>}};
  return kernels;
}

}  // namespace encore::accel::ENCORE_ISA
