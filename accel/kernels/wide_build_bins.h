#pragma once

#include "accel/kernels/wide_build_boxes.h"

namespace encore::accel::ENCORE_ISA {

/// Bins for items whose centres lie in `centers`.
inline WideBinning binning_of(const WideBox& centers, std::uint32_t bins) {
  WideBinning binning;
  binning.bins = bins;
  for (int axis = 0; axis < 3; ++axis) {
    const float size = -(centers.ends[axis] + centers.ends[axis + 4]);
    binning.first[axis] = centers.ends[axis];
    // The last centre must stay below the number of bins, however products round.
    binning.scale[axis] = size > 0x1p-100F ? 0.9999F * static_cast<float>(bins) / size : 0.0F;
  }
  binning.first[3] = binning.scale[3] = 0.0F;
  return binning;
}

inline void clear_bins(WideBins& bins, std::uint32_t count) {
  const Box empty = empty_box();
  const Floats<4> none = Floats<4>::all_bits(0);
  for (std::uint32_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < 3; ++axis) empty.store(bins.box[i][axis].ends);
    none.store(bins.count[i]);
  }
}

/// The bins of an item along the three axes.
struct BinsOfItem {
  std::uint32_t axis[4];
};
inline BinsOfItem bins_of(const Floats<4>& center, const Floats<4>& first, const Floats<4>& scale) {
  const Floats<4> place = (center - first) * scale;
  BinsOfItem bins;
#if defined(__SSE4_2__)
  _mm_storeu_si128(reinterpret_cast<__m128i*>(bins.axis), _mm_cvttps_epi32(place.v));
#else
  for (int axis = 0; axis < 3; ++axis) {
    bins.axis[axis] = static_cast<std::uint32_t>(static_cast<std::int32_t>(place.lane[axis]));
  }
#endif
  return bins;
}

[[gnu::always_inline]] inline void bin_item(const WideItem& item, const Floats<4>& first,
                                            const Floats<4>& scale, WideBins& bins) {
  const Box box = Box::load(item.lower);
  const BinsOfItem at = bins_of(center(box), first, scale);
  extend(bins.box[at.axis[0]][0], box);
  extend(bins.box[at.axis[1]][1], box);
  extend(bins.box[at.axis[2]][2], box);
  ++bins.count[at.axis[0]][0];
  ++bins.count[at.axis[1]][1];
  ++bins.count[at.axis[2]][2];
}

/// From three places at once: neighbours fall into the same bins, and each would wait for what the
/// one before it has written there.
inline void bin_items(const WideItem* items, std::size_t begin, std::size_t end,
                      const WideBinning& binning, WideBins& bins) {
  const Floats<4> first = Floats<4>::load(binning.first);
  const Floats<4> scale = Floats<4>::load(binning.scale);
  const std::size_t third = (end - begin) / 3;
  for (std::size_t i = begin; i < begin + third; ++i) {
    bin_item(items[i], first, scale, bins);
    bin_item(items[i + third], first, scale, bins);
    bin_item(items[i + 2 * third], first, scale, bins);
  }
  for (std::size_t i = begin + 3 * third; i < end; ++i) bin_item(items[i], first, scale, bins);
}

/// Four counts.
struct Counts {
#if defined(__SSE4_2__)
  __m128i v;
  static Counts none() {
    return {_mm_setzero_si128()};
  }
  static Counts load(const std::uint32_t* from) {
    return {_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))};
  }
  friend Counts operator+(Counts a, Counts b) {
    return {_mm_add_epi32(a.v, b.v)};
  }
  /// Blocks that so many triangles fill.
  [[nodiscard]] Floats<4> blocks() const {
    return {_mm_cvtepi32_ps(_mm_srli_epi32(_mm_add_epi32(v, _mm_set1_epi32(3)), 2))};
  }
#else
  std::uint32_t v[4];
  static Counts none() {
    return {{0, 0, 0, 0}};
  }
  static Counts load(const std::uint32_t* from) {
    return {{from[0], from[1], from[2], from[3]}};
  }
  friend Counts operator+(const Counts& a, const Counts& b) {
    return {{a.v[0] + b.v[0], a.v[1] + b.v[1], a.v[2] + b.v[2], a.v[3] + b.v[3]}};
  }
  [[nodiscard]] Floats<4> blocks() const {
    Floats<4> r;
    for (int i = 0; i < 4; ++i) r.lane[i] = static_cast<float>((v[i] + 3) >> 2);
    return r;
  }
#endif
};

/// The plane of the least cost after the surface area heuristic, in blocks; sides without an item
/// cost NaN and so are never chosen.
[[gnu::always_inline]] inline void best_split(const WideBins& bins, const WideBinning& binning,
                                              WideSplit& split) {
  const std::uint32_t count = binning.bins;
  Floats<4> right_cost[WideBins::kMost];
  Box a = empty_box(), b = a, c = a;
  Counts counts = Counts::none();
  for (std::uint32_t i = count - 1; i > 0; --i) {
    a = min(a, Box::load(bins.box[i][0].ends));
    b = min(b, Box::load(bins.box[i][1].ends));
    c = min(c, Box::load(bins.box[i][2].ends));
    counts = counts + Counts::load(bins.count[i]);
    right_cost[i] = half_areas(a, b, c) * counts.blocks();
  }
  a = b = c = empty_box();
  counts = Counts::none();
  Floats<4> best = Floats<4>::all(__builtin_inff());
  Floats<4> place = Floats<4>::all_bits(0);
  for (std::uint32_t i = 1; i < count; ++i) {
    a = min(a, Box::load(bins.box[i - 1][0].ends));
    b = min(b, Box::load(bins.box[i - 1][1].ends));
    c = min(c, Box::load(bins.box[i - 1][2].ends));
    counts = counts + Counts::load(bins.count[i - 1]);
    const Floats<4> cost = half_areas(a, b, c) * counts.blocks() + right_cost[i];
    const Mask<4> better = cost < best;
    best = select(better, cost, best);
    place = select(better, Floats<4>::all_bits(i), place);
  }
  float costs[4];
  std::uint32_t places[4];
  best.store(costs);
  place.store(places);
  split.axis = 3;
  float least = __builtin_inff();
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    if (binning.scale[axis] > 0.0F && costs[axis] < least) {
      least = costs[axis];
      split.axis = axis;
      split.bin = places[axis];
    }
  }
  if (split.axis == 3) return;
  split.cost = least;
  Box side[2] = {empty_box(), empty_box()};
  split.left = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    Box& box = side[i < split.bin ? 0 : 1];
    box = min(box, Box::load(bins.box[i][split.axis].ends));
    split.left += i < split.bin ? bins.count[i][split.axis] : 0;
  }
  side[0].store(split.box[0].ends);
  side[1].store(split.box[1].ends);
}

/// Stable on the left; the right side comes out back to front where `Step` is -1.
template <int Step>
inline void part_items(const WideItem* items, std::size_t begin, std::size_t end,
                       const WideBinning& binning, const WideSplit& split, WideItem* left,
                       WideItem* right, WideBox centers[2]) {
  const std::uint32_t axis = split.axis;
  const float first = binning.first[axis], scale = binning.scale[axis];
  const Box empty = empty_box();
  const Box limits = Box::all(static_cast<float>(split.bin));
  Box left_centers = Box::load(centers[0].ends), right_centers = Box::load(centers[1].ends);
  auto to_left = reinterpret_cast<std::uintptr_t>(left);
  auto to_right = reinterpret_cast<std::uintptr_t>(right);
  for (std::size_t i = begin; i < end; ++i) {
    const WideItem& item = items[i];
    const Box box = Box::load(item.lower);
    const float place = ((item.lower[axis] - item.minus_upper[axis]) - first) * scale;
    const Mask<8> goes_left = Box::all(place) < limits;
    // All ones or none: no branch, which would be mispredicted half the time.
    const std::uintptr_t left_ones = 0 - std::uintptr_t{goes_left.bits() & 1U};
    box.store(reinterpret_cast<WideItem*>(to_right ^ ((to_left ^ to_right) & left_ones))->lower);
    to_left += sizeof(WideItem) & left_ones;
    to_right += static_cast<std::uintptr_t>(Step * int{sizeof(WideItem)}) & ~left_ones;
    const Box point = point_box(center(box));
    left_centers = min(left_centers, select(goes_left, point, empty));
    right_centers = min(right_centers, select(goes_left, empty, point));
  }
  left_centers.store(centers[0].ends);
  right_centers.store(centers[1].ends);
}

inline void boxes_of_items(const WideItem* items, std::size_t begin, std::size_t end, WideBox& box,
                           WideBox& centers) {
  Box all = empty_box(), points = empty_box();
  for (std::size_t i = begin; i < end; ++i) {
    const Box item = Box::load(items[i].lower);
    all = min(all, item);
    points = min(points, point_box(center(item)));
  }
  all.store(box.ends);
  points.store(centers.ends);
}

}  // namespace encore::accel::ENCORE_ISA
