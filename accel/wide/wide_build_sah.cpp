// The top of a tree by the surface area heuristic: every pass over many items is cut into parts.
#include "accel/large_pages.h"
#include "accel/wide/wide_build_memory.h"
#include "accel/wide/wide_build_top.h"
#include "accel/wide/wide_spatial.h"

#include <algorithm>
#include <array>

namespace encore::accel {

namespace {

constexpr std::uint32_t kBins = 16;
constexpr std::uint32_t kBestBins = 32;
/// Items are split where their coordinates need no scaling.
constexpr float kSplitLargest = 0x1p40F, kSplitSmallest = 0x1p-40F;
/// Items of a part of a pass over them.
constexpr std::size_t kPart = 4096;

float half_area(const WideBox& box) {
  const float x = box.ends[0] + box.ends[4], y = box.ends[1] + box.ends[5];
  const float z = box.ends[2] + box.ends[6];
  return (x * y + y * z) + z * x;
}

class SahRules {
 public:
  using Range = WideRange;

  SahRules(WideBuildRun& run, std::uint32_t bins, const WideSpatial* spatial)
      : run_(run), bins_(bins), spatial_(spatial) {
    run.memory.part_bins.reset(WideParts::kMost, run.mode, run.allocations);
    if (spatial == nullptr) return;
    run.memory.part_slabs.reset(3 * WideParts::kMost, run.mode, run.allocations);
  }

  static bool divisible(const Range& range) {
    return range.end - range.begin > TriangleBlock::kSize;
  }
  /// Whether a is to be divided rather than b.
  static bool wider(const Range& a, const Range& b) { return a.area > b.area; }

  std::uint32_t leaf(const Range& range) {
    const WideItem* const items = run_.memory.items[range.array].data();
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      run_.memory.order[i] = items[i].triangle & ~WideItem::kTriangleBit;
    }
    if (run_.parts) run_.memory.leaf_boxes[range.begin] = range.box;
    return WideTopology::leaf(range.begin, range.end - range.begin);
  }

  static WideRange subtree(const Range& range) { return range; }

  static std::uint32_t room(const Range& range) { return range.room - range.begin; }

  void divide(Range& range, Range& other, std::uint32_t depth) {
    run_.meter.check();
    if (depth >= kWideForcedDepth || !by_plane(range, other)) halve(range, other);
    for (Range* side : {&range, &other}) side->area = half_area(side->box);
  }

 private:
  static WideParts parts_of(const Range& range) {
    const std::size_t items = range.end - range.begin;
    const std::size_t size = std::max(kPart, (items + WideParts::kMost - 1) / WideParts::kMost);
    return {items, size, (items + size - 1) / size};
  }
  /// body(part, begin, end) for the parts of a range.
  template <class Body>
  void for_parts(const Range& range, const Body& body) {
    const WideParts parts = parts_of(range);
    run_.workers.for_parts(parts.items, parts.size, [&](std::size_t begin, std::size_t end) {
      body(begin / parts.size, range.begin + begin, range.begin + end);
    });
  }

  bool by_plane(Range& range, Range& other) {
    Array<WideBins>& bins = run_.memory.part_bins;
    const WideItem* const items = run_.memory.items[range.array].data();
    const std::size_t parts = parts_of(range).count;
    WideBinning binning;
    for_parts(range, [&](std::size_t part, std::size_t begin, std::size_t end) {
      WideBinning same;
      run_.kernels.clear(range.centers, bins_, same, bins[part]);
      run_.kernels.bin(items, begin, end, same, bins[part]);
    });
    WideBins all;
    run_.kernels.clear(range.centers, bins_, binning, all);
    for (std::size_t part = 0; part < parts; ++part) run_.kernels.merge(all, bins[part], bins_);
    WideSplit split;
    run_.kernels.split(all, binning, split);
    if (split.axis == 3) return false;
    if (spatial_ != nullptr && wide_halves_overlap(*spatial_, range.area, split.box) &&
        split_wide_space(*spatial_, items, split.cost, run_.memory.items[1 - range.array].data(),
                         range, other, parts_of(range), run_.workers,
                         run_.memory.part_slabs.data())) {
      return true;
    }
    move(range, other, binning, split);
    return true;
  }

  void move(Range& range, Range& other, const WideBinning& binning, const WideSplit& split) {
    const Array<WideBins>& bins = run_.memory.part_bins;
    const std::size_t parts = parts_of(range).count;
    std::array<std::uint32_t, WideParts::kMost> left_begin;
    std::uint32_t left = 0;
    for (std::size_t part = 0; part < parts; ++part) {
      left_begin[part] = left;
      for (std::uint32_t i = 0; i < split.bin; ++i) left += bins[part].count[i][split.axis];
    }
    const WideItem* const items = run_.memory.items[range.array].data();
    WideItem* const to = run_.memory.items[1 - range.array].data();
    const std::uint32_t middle = wide_right_begin(range, left);
    std::array<std::array<WideBox, 2>, WideParts::kMost> centers;
    for_parts(range, [&](std::size_t part, std::size_t begin, std::size_t end) {
      centers[part] = {kEmptyWideBox, kEmptyWideBox};
      run_.kernels.part(items, begin, end, binning, split, to + range.begin + left_begin[part],
                        to + middle + (begin - range.begin - left_begin[part]),
                        centers[part].data());
    });
    for (std::size_t part = 1; part < parts; ++part) {
      for (const std::size_t side : {0, 1}) extend(centers[0][side], centers[part][side]);
    }
    const std::uint32_t array = 1 - range.array;
    const std::uint32_t end = middle + (range.end - range.begin - left);
    other = {split.box[1], centers[0][1], middle, end, range.room, array, 0.0F};
    range = {split.box[0], centers[0][0], range.begin, range.begin + left, middle, array, 0.0F};
  }

  void halve(Range& range, Range& other) {
    other = range;
    other.begin = range.end = range.room = wide_middle(range.begin, range.end);
    fit(range);
    fit(other);
  }

  void fit(Range& range) {
    std::array<std::array<WideBox, 2>, WideParts::kMost> boxes;
    const WideItem* const items = run_.memory.items[range.array].data();
    for_parts(range, [&](std::size_t part, std::size_t begin, std::size_t end) {
      run_.kernels.fit_items(items, begin, end, boxes[part][0], boxes[part][1]);
    });
    range.box = boxes[0][0];
    range.centers = boxes[0][1];
    for (std::size_t part = 1; part < parts_of(range).count; ++part) {
      extend(range.box, boxes[part][0]);
      extend(range.centers, boxes[part][1]);
    }
  }

  WideBuildRun& run_;
  std::uint32_t bins_;
  const WideSpatial* spatial_;
};

WideRange make_items(WideBuildRun& run, std::uint32_t room) {
  const std::size_t count = run.triangles.size();
  WideBuildMemory& memory = run.memory;
  for (auto& items : memory.items) {
    items.reset(room, run.mode, run.allocations);
    ask_for_large_pages(std::as_bytes(items.span().first(count)));
  }
  Array<WideBox>& centers = memory.part_boxes;
  for_wide_parts(run, count, 0.15, [&](std::size_t begin, std::size_t end) {
    WideBox& box = centers[begin / kWidePart];
    box = kEmptyWideBox;
    run.kernels.items(run.triangles.data(), begin, end, run.unit, memory.items[0].data(), box);
  });
  WideRange all{};
  for (int i = 0; i < 8; ++i) all.box.ends[i] = run.box.ends[i] * run.unit;
  all.centers = kEmptyWideBox;
  for (const WideBox& box : centers.span()) extend(all.centers, box);
  all.end = static_cast<std::uint32_t>(count);
  all.room = room;
  all.area = half_area(all.box);
  return all;
}

}  // namespace

void build_wide_sah(WideBuildRun& run, bool best) {
  WideBuildMemory& memory = run.memory;
  run.parts = best && run.unit > 1.0F / kSplitLargest && run.unit < 1.0F / kSplitSmallest;
  if (run.parts) run.unit = 1.0F;
  const std::size_t count = run.triangles.size();
  const std::size_t room = run.parts ? most_wide_references(count) : count;
  const WideRange all = make_items(run, static_cast<std::uint32_t>(room));
  memory.order.reset(room, run.mode, run.allocations);
  if (run.parts) memory.leaf_boxes.reset(room, run.mode, run.allocations);
  const WideSpatial spatial{run.triangles.data(), all.area};
  const WideSpatial* const splits = run.parts ? &spatial : nullptr;
  SahRules rules(run, best ? kBestBins : kBins, splits);
  const auto subtree =
      std::clamp(static_cast<std::uint32_t>(count / 32), kWideSubtree, kLargeWideSubtree);
  WideTop<SahRules>(run, rules, subtree).build(all);
  run.meter.report(0.4);
  const WideBuildArrays arrays{.items = {memory.items[0].data(), memory.items[1].data()},
                               .keys = {nullptr, nullptr},
                               .nodes = memory.nodes.data(),
                               .order = memory.order.data(),
                               .leaf_boxes = run.parts ? memory.leaf_boxes.data() : nullptr,
                               .bins = best ? kBestBins : kBins,
                               .spatial = splits};
  for_wide_pieces(run, memory.subtrees.size(), 0.9,
                  [&](std::size_t i) { run.kernels.sah_subtree(arrays, memory.subtrees[i]); });
}

}  // namespace encore::accel
