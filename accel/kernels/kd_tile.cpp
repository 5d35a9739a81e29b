// kd-trees, rectangles of rays in packets of 64.
#include "accel/kdtree/kd_tile.h"

#include "accel/kdtree/kd_depth.h"
#include "accel/kernels/tile_packets.h"

namespace encore::accel::ENCORE_ISA {

const KdTileKernels& kd_tile_kernels_here();

namespace {

/// KdTree::trace for a packet: the same comparisons for every ray, which is active where it would
/// have come alone. The directions' signs are the same for all rays, and so is the order of nodes.
template <class Tile>
class KdTrace {
 public:
  static constexpr bool kKeepSign = true;

  KdTrace(const KdTileView& view, Tile& tile) : view_(view), tile_(tile) {}

  bool run() {
    if (!set_signs()) return false;
    if (enter_scene() == 0) return true;
    std::uint32_t index = 0;
    for (;;) {
      // A copy: a member would be loaded again after every store.
      gpu::KdNode node = view_.nodes[index];
      while ((node.flags & 3U) != kLeafTag) {
        index = descend(node, index);
        node = view_.nodes[index];
      }
      visit_leaf(node);
      if (tile_.scattered()) return false;
      if (!pop(index)) return true;
    }
  }

 private:
  using F = Floats<kLanes>;
  static constexpr std::uint32_t kLeafTag = 3;

  /// The rays in a node: which, and their stretches inside it.
  struct alignas(64) Stretches {
    float enter[kPacketRays];
    float leave[kPacketRays];
    unsigned active[kGroups];
    std::uint32_t node;
  };

  [[gnu::always_inline]] bool set_signs() {
    const RayPacket& packet = tile_.packet();
    for (int axis = 0; axis < 3; ++axis) {
      unsigned negative = 0;
      for (int i = 0; i < kPacketRays; ++i) {
        negative += __builtin_signbit(packet.direction[axis][i]) != 0 ? 1U : 0U;
      }
      if (negative != 0 && negative != kPacketRays) return false;
      negative_[axis] = negative != 0;
    }
    return true;
  }

  /// box_stretch() of the whole; returns whether any ray is inside.
  [[gnu::always_inline]] unsigned enter_scene() {
    const RayPacket& packet = tile_.packet();
    const float* const low = &view_.min.x;
    const float* const high = &view_.max.x;
    unsigned any = 0;
    for (int group = 0; group < kGroups; ++group) {
      const int first = group * kLanes;
      F enter = F::load(packet.t_min + first);
      F leave = F::load(packet.t + first);
      for (int axis = 0; axis < 3; ++axis) {
        const F origin = F::load(packet.origin[axis] + first);
        const F inverse = F::load(packet.inverse[axis] + first);
        const F near = F::all(negative_[axis] ? high[axis] : low[axis]);
        const F far = F::all(negative_[axis] ? low[axis] : high[axis]);
        enter = max((near - origin) * inverse, enter);
        leave = min((far - origin) * inverse, leave);
      }
      enter.store(now_.enter + first);
      leave.store(now_.leave + first);
      now_.active[group] = (enter * F::all(kNarrow) <= leave * F::all(kWiden)).bits();
      any |= now_.active[group];
    }
    return any;
  }

  /// Goes on to the near child, or the far one where all rays skip the near one; the far one waits
  /// where it has rays.
  [[gnu::always_inline]] std::uint32_t descend(const gpu::KdNode& node, std::uint32_t index) {
    const RayPacket& packet = tile_.packet();
    const std::uint32_t axis = node.flags & 3U;
    const std::uint32_t upper = node.flags >> 2U;
    const std::uint32_t near = negative_[axis] ? upper : index + 1;
    const std::uint32_t far = negative_[axis] ? index + 1 : upper;
    const F position = F::all(__builtin_bit_cast(float, node.data));
    Stretches& waiting = waiting_[count_];
    unsigned any_near = 0, any_far = 0;
    unsigned near_active[kGroups];
    for (int group = 0; group < kGroups; ++group) {
      const int first = group * kLanes;
      near_active[group] = waiting.active[group] = 0;
      const unsigned active = now_.active[group];
      if (active == 0) continue;
      const F t =
          (position - F::load(packet.origin[axis] + first)) * F::load(packet.inverse[axis] + first);
      const F enter = F::load(now_.enter + first);
      const F leave = F::load(now_.leave + first);
      const unsigned near_only = (t * F::all(kNarrow) > leave).bits() & active;
      const unsigned far_only = (t * F::all(kWiden) < enter).bits() & active & ~near_only;
      near_active[group] = active & ~far_only;
      waiting.active[group] = active & ~near_only;
      any_near |= near_active[group];
      any_far |= waiting.active[group];
      // Both: the far side from t on, the near one up to t; what is not a number changes nothing.
      const Mask<kLanes> both = Mask<kLanes>::of_bits(active & ~(near_only | far_only));
      select(both, max(t, enter), enter).store(waiting.enter + first);
      leave.store(waiting.leave + first);
      select(both, min(t, leave), leave).store(now_.leave + first);
    }
    if (any_near == 0) {
      // Nobody's stretch has changed.
      return far;
    }
    for (int group = 0; group < kGroups; ++group) now_.active[group] = near_active[group];
    if (any_far != 0) {
      waiting.node = far;
      ++count_;
    }
    return near;
  }

  [[gnu::always_inline]] void visit_leaf(const gpu::KdNode& leaf) {
    const std::uint32_t count = leaf.flags >> 2U;
    Mask<kLanes> active[kGroups];
    for (int group = 0; group < kGroups; ++group) {
      active[group] = Mask<kLanes>::of_bits(now_.active[group]);
    }
    const std::uint32_t* const references = view_.references + leaf.data;
    for (std::uint32_t i = 0; i < count; ++i) tile_.test(references[i], active);
  }

  /// The next node with a ray whose stretch there does not begin beyond its best hit.
  [[gnu::always_inline]] bool pop(std::uint32_t& index) {
    while (count_ > 0) {
      const Stretches& next = waiting_[--count_];
      unsigned any = 0;
      for (int group = 0; group < kGroups; ++group) {
        now_.active[group] = 0;
        if (next.active[group] == 0) continue;
        const F enter = F::load(next.enter + group * kLanes);
        const unsigned behind = (enter * F::all(kNarrow) > tile_.reach(group)).bits();
        now_.active[group] = next.active[group] & ~behind;
        any |= now_.active[group];
        enter.store(now_.enter + group * kLanes);
        F::load(next.leave + group * kLanes).store(now_.leave + group * kLanes);
      }
      if (any == 0) continue;
      index = next.node;
      return true;
    }
    return false;
  }

  const KdTileView& view_;
  Tile& tile_;
  bool negative_[3];
  int count_ = 0;
  Stretches now_;
  Stretches waiting_[kKdDepthCap + 1];
};

template <int kMode, bool kAnyHit>
void trace(const KdTileView& view, const TileJob& job) {
  trace_tile<KdTrace, kMode, kAnyHit>(view, job);
}

}  // namespace

const KdTileKernels& kd_tile_kernels_here() {
  static constexpr KdTileKernels kernels{{trace<0, false>, trace<1, false>, trace<2, false>},
                                         {trace<0, true>, trace<1, true>, trace<2, true>}};
  return kernels;
}

}  // namespace encore::accel::ENCORE_ISA
