#pragma once

#include "accel/kernels/wide_tile_cull.h"
#include "accel/kernels/wide_tile_frustum.h"
#include "accel/kernels/wide_tile_triangles.h"

namespace encore::accel::ENCORE_ISA {

/// Takes a packet through the tree: nodes nearest first by the frustum of the whole, leaves by
/// those of the groups, then by each ray's own slab test.
template <class Tester, bool kAnyHit, bool kCommon>
class PacketTrace {
 public:
  PacketTrace(const TraceScene& scene, RayPacket& packet, PacketFrustums& frustums)
      : scene_(scene), packet_(packet), frustums_(frustums) {}

  /// False if the rays turn out to have little in common; what was found so far is then lost.
  bool run() {
    bool endless = true;
    for (int group = 0; group < kGroups; ++group) {
      endless = endless && least_of(F::load(packet_.t + group * kLanes)) == __builtin_inff();
    }
    frustums_.groups.limit = Floats<kGroups>::all(__builtin_inff());
    for (int group = 0; group < kGroups; ++group) {
      farthest_[group] = __builtin_inff();
      if (!endless) limit_group(group);
    }
    limit_whole();
    std::uint32_t node = 0;
    for (;;) {
      visit(node);
      const Waiting* next = pop();
      while (next != nullptr && WideChild::is_leaf(next->child)) {
        visit_leaf(*next);
        if (leaves_ > kLeastLeaves && lanes_ < kLeastLanes * leaves_) return false;
        next = pop();
      }
      if (next == nullptr) return true;
      node = next->child;
    }
  }

 private:
  using F = Floats<kLanes>;
  /// A leaf that fewer of the packet's rays meet than this, on average, costs each of them more
  /// than it would alone; to be seen from so many leaves.
  static constexpr int kLeastLanes = 2, kLeastLeaves = 16;
  /// From so many rays on triangles are first thrown out by whole groups.
  static constexpr int kCulledLanes = 24;

  /// A child still to be visited, where the packet enters its box, and where that box is.
  struct Waiting {
    float enter;
    std::uint32_t child;
    const float* box;  ///< the first of its rows' numbers, eight apart
    unsigned groups;   ///< that may meet it; only if the rays have no origin in common
  };

  /// Lets the node's children wait: the nearest on top, or for any hit the last one
  /// (order_wide_children()).
  [[gnu::always_inline]] void visit(std::uint32_t index) {
    const gpu::WideNode& node = scene_.tree.nodes[index];
    Floats<8> enters;
    unsigned hits =
        frustums_.whole
            .meets([&](int k) { return Floats<8>::load(node.bounds + frustums_.rows[k]); }, enters)
            .bits();
    alignas(32) float enter[8];
    enters.store(enter);
    Waiting* const from = waiting_ + count_;
    for (; hits != 0; hits &= hits - 1) {
      const int lane = __builtin_ctz(hits);
      unsigned groups = 0;
      if constexpr (!kCommon) {
        groups = groups_at(node.bounds + lane);
        if (groups == 0) continue;
      }
      prefetch(node.child[lane]);
      Waiting* place = waiting_ + count_++;
      for (; !kAnyHit && place > from && place[-1].enter < enter[lane]; --place) {
        *place = place[-1];
      }
      *place = {enter[lane], node.child[lane], node.bounds + lane, groups};
    }
  }

  /// Has a child on its way from memory before its turn comes.
  [[gnu::always_inline]] void prefetch(std::uint32_t child) const {
    const char* from;
    int bytes;
    if (WideChild::is_leaf(child)) {
      const std::uint32_t block = WideChild::first_block(child);
      __builtin_prefetch(scene_.tree.ids + TriangleBlock::kSize * block);
      from = reinterpret_cast<const char*>(scene_.tree.blocks + block);
      bytes = static_cast<int>(sizeof(TriangleBlock));
    } else {
      from = reinterpret_cast<const char*>(scene_.tree.nodes + child);
      bytes = static_cast<int>(sizeof(gpu::WideNode));
    }
    for (int i = 0; i < bytes; i += 64) __builtin_prefetch(from + i);
  }

  /// Which groups may meet a box.
  [[gnu::always_inline]] unsigned groups_at(const float* box) const {
    Floats<kGroups> enter;
    return frustums_.groups
        .meets([&](int k) { return Floats<kGroups>::all(box[frustums_.rows[k]]); }, enter)
        .bits();
  }

  /// The next child that begins before the farthest best hit.
  [[gnu::always_inline]] const Waiting* pop() {
    while (count_ > 0) {
      const Waiting& next = waiting_[--count_];
      if (next.enter <= limit_) return &next;
    }
    return nullptr;
  }

  /// 1 / direction; +inf for zeros, NaN where that leaves the normal range (slab_inverse()).
  void set_inverses() {
    const F sign = F::all(frustums_.down ? -0.0F : 0.0F);
    for (int i = 0; i < kPacketRays; i += kLanes) {
      (F::load(frustums_.inverse + i) ^ sign).store(packet_.inverse[frustums_.axis[0]] + i);
      for (int k = 1; k < 3; ++k) {
        const F direction = F::load(packet_.direction[frustums_.axis[k]] + i);
        const F inverse = F::all(1.0F) / direction;
        const F size = abs(inverse);
        const auto normal = (size >= F::all(0x1p-126F)) & (size <= F::all(0x1.fffffep+127F));
        const F odd =
            select(direction == F::all(0.0F), F::all(__builtin_inff()), F::all(__builtin_nanf("")));
        select(normal, inverse, odd).store(packet_.inverse[frustums_.axis[k]] + i);
      }
    }
    has_inverses_ = true;
    if constexpr (kCommon) cull_.set(frustums_);
  }

  [[gnu::always_inline]] void visit_leaf(const Waiting& leaf) {
    if (!has_inverses_) set_inverses();
    ++leaves_;
    const ActiveRays active = find_active(leaf);
    if (active.count == 0) return;
    lanes_ += active.lanes;
    const std::uint32_t first = WideChild::first_block(leaf.child);
    const std::uint32_t end = first + WideChild::blocks(leaf.child);
    unsigned changed = 0;
    for (std::uint32_t block = first; block < end; ++block) changed |= test_block(block, active);
    bool nearer = false;
    for (; changed != 0; changed &= changed - 1) {
      nearer |= limit_group(active.group[__builtin_ctz(changed)]);
    }
    if (nearer) limit_whole();
  }

  /// Groups with rays that meet a leaf's box.
  struct ActiveRays {
    int count = 0, lanes = 0;  ///< groups, and rays in all
    int group[kGroups];
    Mask<kLanes> rays[kGroups];
  };

  [[gnu::always_inline]] ActiveRays find_active(const Waiting& leaf) const {
    ActiveRays active;
    unsigned groups = kCommon ? groups_at(leaf.box) : leaf.groups;
    for (; groups != 0; groups &= groups - 1) {
      const int group = __builtin_ctz(groups);
      const Mask<kLanes> inside = meets_box(group * kLanes, leaf.box);
      if (inside.bits() == 0) continue;
      active.lanes += __builtin_popcount(inside.bits());
      active.group[active.count] = group;
      active.rays[active.count++] = inside;
    }
    return active;
  }

  /// Holds a block's triangles against the rays; bit by bit the groups, as `active` counts them,
  /// with a new best hit.
  [[gnu::always_inline]] unsigned test_block(std::uint32_t index, const ActiveRays& active) {
    const std::uint32_t* const ids = scene_.tree.ids + TriangleBlock::kSize * index;
    PreparedBlock block;
    prepare<kCommon, Tester::kFilter>(scene_.tree.blocks[index], ids, packet_, block);
    const unsigned all = (1U << block.count) - 1U;
    unsigned may_hit[kGroups];
    const bool cull = kCommon && active.lanes >= kCulledLanes;
    if (cull) cull_.find(block, active.group, active.count, may_hit);
    unsigned changed = 0;
    for (int i = 0; i < active.count; ++i) {
      const GroupRays rays{packet_, active.group[i] * kLanes};
      const unsigned triangles = cull ? all & may_hit[i] : all;
      if (triangles == 0) continue;
      const unsigned bits = active.rays[i].bits();
      bool hit;
      if (Tester::few_pay(kAnyHit) && triangles == 0xFU &&
          __builtin_popcount(bits) <= FewRays::kMost) {
        hit = Tester::template test_few<kAnyHit, kCommon>(scene_, block, ids, rays, FewRays(bits));
      } else {
        hit = Tester::template test<kAnyHit, kCommon>(scene_, block, ids, rays, active.rays[i],
                                                      triangles);
      }
      if (hit) changed |= 1U << i;
    }
    return changed;
  }

  /// Which of a group's rays meet a box before their best hits, as the slab test of single rays.
  [[gnu::always_inline]] Mask<kLanes> meets_box(int first, const float* box) const {
    F enter = F::load(packet_.t_min + first);
    F leave = F::load(packet_.t + first) * F::all(Tester::kReach);
    for (int axis = 0; axis < 3; ++axis) {
      const F origin = F::load(packet_.origin[axis] + first);
      const F inverse = F::load(packet_.inverse[axis] + first);
      const F lower = (F::all(box[16 * axis]) - origin) * inverse;
      const F upper = (F::all(-box[16 * axis + 8]) - origin) * inverse;
      // In this order: what is not a number never excludes.
      enter = max(min(upper, lower), enter);
      leave = min(max(lower, upper), leave);
    }
    return enter * F::all(kNarrow) <= leave * F::all(kWiden);
  }

  /// How far along w the rays of a group are still to be followed; false if as far as before.
  [[gnu::always_inline]] bool limit_group(int group) {
    const int first = group * kLanes;
    const F reach = F::load(packet_.t + first) * F::all(Tester::kReach);
    F limit = reach * F::load(frustums_.along + first);
    if constexpr (!kCommon) limit = limit + F::load(frustums_.start + first);
    // Mostly the farthest ray is still on its way.
    if ((limit >= F::all(farthest_[group])).bits() != 0) return false;
    farthest_[group] = greatest_of(limit);
    frustums_.groups.limit = select(Mask<kGroups>::of_bits(1U << group),
                                    Floats<kGroups>::all(farthest_[group] * kWiden + kTinyLength),
                                    frustums_.groups.limit);
    return true;
  }
  /// The same for all groups.
  [[gnu::always_inline]] void limit_whole() {
    limit_ = greatest_of(frustums_.groups.limit);
    frustums_.whole.limit = Floats<8>::all(limit_);
  }

  const TraceScene& scene_;
  RayPacket& packet_;
  PacketFrustums& frustums_;
  float limit_ = 0;
  float farthest_[kGroups];
  int count_ = 0;
  int leaves_ = 0, lanes_ = 0;  ///< visited, and rays that met those
  bool has_inverses_ = false;
  GroupCull cull_;
  Waiting waiting_[WideTree::kStackSize + 1];
};

}  // namespace encore::accel::ENCORE_ISA
