#include "accel/kernels/wide_build_bins.h"
#include "accel/kernels/wide_build_tables.h"
#include "accel/wide/wide_spatial.h"

namespace encore::accel::ENCORE_ISA {

namespace {

constexpr std::uint32_t kLeaf = TriangleBlock::kSize;
/// From here on ranges are halved by number, which ends within 28 more.
constexpr std::uint32_t kForcedDepth = 32;

/// More bins than this make little difference; small nodes take fewer, as every bin costs the same
/// whether an item is in it or not.
std::uint32_t bins_for(std::uint32_t count, std::uint32_t most) {
  const std::uint32_t bins = most > 16 ? 8 + count / 2 : 4 + count / 4;
  return bins < most ? bins : most;
}

class SahSubtree {
 public:
  SahSubtree(const WideBuildArrays& arrays, WideSubtree& subtree)
      : arrays_(arrays), nodes_(arrays.nodes + subtree.first_node), subtree_(subtree) {}

  void build(const WideRange& range, std::uint32_t depth) {
    WideTopology& node = nodes_[subtree_.nodes++];
    if (depth > subtree_.deepest) subtree_.deepest = depth;
    WideRange parts[WideTree::kWidth];
    parts[0] = range;
    std::uint32_t count = 1;
    while (count < WideTree::kWidth) {
      const std::uint32_t widest = widest_of(parts, count);
      if (widest == count) break;
      divide(parts[widest], parts[count], depth >= kForcedDepth);
      ++count;
    }
    for (std::uint32_t i = count; i < WideTree::kWidth; ++i) node.child[i] = WideChild::kNoChild;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (parts[i].end - parts[i].begin <= WideTopology::kLargestLeaf) {
        node.child[i] = leaf(parts[i]);
      } else {
        node.child[i] = subtree_.nodes;
        build(parts[i], depth + 1);
      }
    }
  }

 private:
  /// The part with the largest box that is no leaf yet; `count` if all are.
  static std::uint32_t widest_of(const WideRange* parts, std::uint32_t count) {
    std::uint32_t widest = count;
    float area = -1.0F;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (parts[i].end - parts[i].begin > kLeaf && parts[i].area > area) {
        area = parts[i].area;
        widest = i;
      }
    }
    return widest;
  }

  std::uint32_t leaf(const WideRange& range) {
    ++subtree_.leaves;
    subtree_.blocks += WideTopology::blocks(range.end - range.begin);
    subtree_.references += range.end - range.begin;
    const WideItem* const items = arrays_.items[range.array];
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      arrays_.order[i] = items[i].triangle & ~WideItem::kTriangleBit;
    }
    if (arrays_.leaf_boxes != nullptr) {
      Box::load(range.box.ends).store(arrays_.leaf_boxes[range.begin].ends);
    }
    return WideTopology::leaf(range.begin, range.end - range.begin);
  }

  /// `range` keeps one side, `other` becomes the other.
  void divide(WideRange& range, WideRange& other, bool by_number) {
    if (!by_number) {
      const std::uint32_t count = range.end - range.begin;
      const WideBinning binning = binning_of(range.centers, bins_for(count, arrays_.bins));
      const WideItem* const items = arrays_.items[range.array];
      clear_bins(bins_, binning.bins);
      bin_items(items, range.begin, range.end, binning, bins_);
      WideSplit split;
      build_split(bins_, binning, split);
      if (split.axis < 3) {
        WideItem* const to = arrays_.items[1 - range.array];
        if (arrays_.spatial != nullptr &&
            wide_halves_overlap(*arrays_.spatial, range.area, split.box) &&
            split_wide_space(*arrays_.spatial, items, split.cost, to, range, other)) {
          return;
        }
        move(items, binning, split, to, range, other);
        return;
      }
    }
    halve(range, other);
  }

  static void move(const WideItem* items, const WideBinning& binning, const WideSplit& split,
                   WideItem* to, WideRange& range, WideRange& other) {
    WideBox centers[2];
    empty_box().store(centers[0].ends);
    empty_box().store(centers[1].ends);
    const std::uint32_t middle = wide_right_begin(range, split.left);
    const std::uint32_t end = middle + (range.end - range.begin - split.left);
    part_items<-1>(items, range.begin, range.end, binning, split, to + range.begin, to + end - 1,
                   centers);
    other = {split.box[1],
             centers[1],
             middle,
             end,
             range.room,
             1 - range.array,
             half_area(split.box[1].ends)};
    range = {split.box[0],
             centers[0],
             range.begin,
             range.begin + split.left,
             middle,
             1 - range.array,
             half_area(split.box[0].ends)};
  }

  /// No plane divides the items: by number, whole blocks on the left.
  void halve(WideRange& range, WideRange& other) {
    const std::uint32_t count = range.end - range.begin;
    const std::uint32_t middle = range.begin + (count + 2 * kLeaf - 1) / (2 * kLeaf) * kLeaf;
    other.begin = middle;
    other.end = range.end;
    other.room = range.room;
    other.array = range.array;
    range.end = range.room = middle;
    for (WideRange* part : {&range, &other}) {
      boxes_of_items(arrays_.items[part->array], part->begin, part->end, part->box, part->centers);
      part->area = half_area(part->box.ends);
    }
  }

  const WideBuildArrays& arrays_;
  WideTopology* const nodes_;
  WideSubtree& subtree_;
  WideBins bins_;
};

}  // namespace

void build_sah_subtree(const WideBuildArrays& arrays, WideSubtree& subtree) {
  subtree.nodes = subtree.leaves = subtree.blocks = subtree.references = 0;
  subtree.deepest = subtree.depth;
  SahSubtree(arrays, subtree).build(subtree.range, subtree.depth);
}

void build_clear(const WideBox& centers, std::uint32_t count, WideBinning& binning,
                 WideBins& bins) {
  binning = binning_of(centers, count);
  clear_bins(bins, count);
}

void build_bin(const WideItem* items, std::size_t begin, std::size_t end,
               const WideBinning& binning, WideBins& bins) {
  bin_items(items, begin, end, binning, bins);
}

void build_merge(WideBins& into, const WideBins& from, std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      extend(into.box[i][axis], Box::load(from.box[i][axis].ends));
      into.count[i][axis] += from.count[i][axis];
    }
  }
}

void build_split(const WideBins& bins, const WideBinning& binning, WideSplit& split) {
  best_split(bins, binning, split);
}

void build_part(const WideItem* items, std::size_t begin, std::size_t end,
                const WideBinning& binning, const WideSplit& split, WideItem* left, WideItem* right,
                WideBox centers[2]) {
  part_items<1>(items, begin, end, binning, split, left, right, centers);
}

void build_fit_items(const WideItem* items, std::size_t begin, std::size_t end, WideBox& box,
                     WideBox& centers) {
  boxes_of_items(items, begin, end, box, centers);
}

}  // namespace encore::accel::ENCORE_ISA
