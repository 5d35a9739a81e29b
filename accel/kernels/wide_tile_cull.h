#pragma once

#include "accel/kernels/wide_tile_frustum.h"
#include "accel/kernels/wide_tile_triangles.h"

namespace encore::accel::ENCORE_ISA {

/// Throws triangles out for a whole group of rays that have their origin in common: what decides
/// whether a ray hits is linear in its direction, so its range over the group's slopes is known.
/// Conservative: nothing is thrown out that any tester's arithmetic may find a hit of.
class GroupCull {
 public:
  /// Of all groups, with their slopes.
  [[gnu::always_inline]] void set(const PacketFrustums& frustums) {
    down_ = frustums.down;
    for (int k = 0; k < 3; ++k) axis_[k] = frustums.axis[k];
    const Floats<kGroups> half = Floats<kGroups>::all(0.5F);
    for (int k = 0; k < 2; ++k) {
      const Floats<kGroups>& high = frustums.groups.slope[2 * k];
      const Floats<kGroups>& minus_low = frustums.groups.slope[2 * k + 1];
      alignas(64) float middle[kGroups], extent[kGroups];
      ((high - minus_low) * half).store(middle);
      ((high + minus_low) * half).store(extent);
      for (int i = 0; i < 4 * kGroups; ++i) {
        middle_[k][i] = middle[i / 4];
        extent_[k][i] = extent[i / 4];
      }
    }
  }

  /// Which of a block's triangles each of `count` groups may hit, bit by bit.
  [[gnu::always_inline]] void find(const PreparedBlock& block, const int* groups, int count,
                                   unsigned* may_hit) {
    take(block);
    int first = -1;
    unsigned bits = 0;
    for (int i = 0; i < count; ++i) {
      const int from = groups[i] / kAtOnce * kAtOnce;
      if (from != first) bits = look(from);
      first = from;
      may_hit[i] = bits >> (4 * (groups[i] - from)) & 0xFU;
    }
  }

 private:
  static constexpr int kAtOnce = kLanes / 4;  ///< groups in a register, each with four triangles
  // TriangleFilter's bound is for directions below 2, as slopes are here: what testers round and
  // what is rounded here are less than twice that. With room.
  static constexpr float kError = 8.0F * ENCORE_FILTER_LARGEST * ENCORE_FILTER_ERROR;
  // Not the filter's: Möller-Trumbore's directions are of any length.
  static constexpr float kUnderflow = 0x1p-80F;

  /// Of a block: u, v and what is left of the determinant as functions of a direction.
  [[gnu::always_inline]] void take(const PreparedBlock& block) {
    using F = Floats<4>;
    const auto row = [&](int at) __attribute__((always_inline)) {
      return Points<4>::load(block.row[at], 4);
    };
    const Points<4> e1 = row(PreparedBlock::kE1), e2 = row(PreparedBlock::kE2);
    const Points<4> s = row(PreparedBlock::kS);
    const Points<4> u = cross(e2, s), v = row(PreparedBlock::kQ), size = cross(e2, e1);
    const Points<4> w = size - u - v;
    const Points<4>* const functions[3] = {&u, &v, &w};
    for (int f = 0; f < 3; ++f) {
      const F* const by_axis[3] = {&functions[f]->x, &functions[f]->y, &functions[f]->z};
      (down_ ? *by_axis[axis_[0]] ^ F::all(-0.0F) : *by_axis[axis_[0]]).store(rows_[3 * f]);
      by_axis[axis_[1]]->store(rows_[3 * f + 1]);
      by_axis[axis_[2]]->store(rows_[3 * f + 2]);
    }
    const F edge = max(largest(e1), largest(e2));
    const F reach = max(edge, largest(s));
    (edge * reach * F::all(kError) + F::all(kUnderflow)).store(error_);
  }

  /// Four bits a group from `first` on.
  [[gnu::always_inline]] unsigned look(int first) const {
    using F = Floats<kLanes>;
    const F error = repeat_fours(error_), minus_error = error ^ F::all(-0.0F);
    const F a = F::load(middle_[0] + 4 * first), b = F::load(middle_[1] + 4 * first);
    const F around_a = F::load(extent_[0] + 4 * first), around_b = F::load(extent_[1] + 4 * first);
    unsigned below = 0, above = 0;
    for (int f = 0; f < 3; ++f) {
      const F along = repeat_fours(rows_[3 * f]);
      const F on_a = repeat_fours(rows_[3 * f + 1]), on_b = repeat_fours(rows_[3 * f + 2]);
      const F middle = along + a * on_a + b * on_b;
      const F extent = around_a * abs(on_a) + around_b * abs(on_b);
      below |= (middle + extent < minus_error).bits();
      above |= (middle - extent > error).bits();
    }
    return ~(below & above);
  }

  bool down_;
  int axis_[3];
  alignas(64) float middle_[2][4 * kGroups];
  alignas(64) float extent_[2][4 * kGroups];
  alignas(16) float rows_[9][4];
  alignas(16) float error_[4];
};

}  // namespace encore::accel::ENCORE_ISA
