#include "accel/bvh/bvh.h"
#include "accel/bvh/four_floats.h"

#include <array>

namespace encore::accel {

static_assert(sizeof(gpu::BvhNode) == 32);

/// The items of one node, and what a split has to know about them.
struct Bvh::Range {
  std::uint32_t begin, end;
  glm::vec3 min, max;    ///< tight bounds
  glm::vec3 latest_min;  ///< the largest lower end of any item, by axis
};

void Bvh::fill_items(BuildMeter& meter) {
  Item* item = items_.data();
  std::uint32_t index = 0;
  meter.pass(triangles_.size(), [&](std::size_t begin, std::size_t end) {
    for (const Triangle& triangle : triangles_.subspan(begin, end - begin)) {
      // The fourth lane of each vertex holds other members; they are overwritten below.
      const FourFloats a = FourFloats::load(&triangle.v0);
      const FourFloats b = FourFloats::load(&triangle.v1);
      const FourFloats c = FourFloats::load(&triangle.v2);
      min(min(a, b), c).store(&item->min);
      max(max(a, b), c).store(&item->max);
      item->triangle = index++;
      ++item;
    }
  });
}

/// Writes the tight bounds of the items into the node; returns what a split has to know.
Bvh::Range Bvh::fit(gpu::BvhNode& node, std::uint32_t begin, std::uint32_t end,
                    BuildMeter& meter) const {
  const Item* const items = items_.data();
  FourFloats lower = FourFloats::load(&items[begin].min);
  FourFloats upper = FourFloats::load(&items[begin].max);
  FourFloats latest = lower;
  for (std::uint32_t i = begin + 1, stop = 0; i < end;) {
    for (stop = meter.part_end(i, end); i < stop; ++i) {
      const FourFloats item_min = FourFloats::load(&items[i].min);
      lower = min(lower, item_min);
      latest = max(latest, item_min);
      upper = max(upper, FourFloats::load(&items[i].max));
    }
  }
  lower.store(&node.min);
  upper.store(&node.max);
  return {begin, end, node.min, node.max, {latest.get<0>(), latest.get<1>(), latest.get<2>()}};
}

/// Divides range into [begin, result) and [result, end), neither of them empty. An item goes left
/// if it begins before the middle of the node's box. The axis is that of the depth in turn, else
/// one of the other two; where no axis divides, or too deep down, each child gets half.
std::uint32_t Bvh::split(const Range& range, std::uint32_t depth, BuildMeter& meter) {
  Item* const items = items_.data();
  for (std::uint32_t attempt = 0; attempt < 3 && depth < kMaxSpatialDepth; ++attempt) {
    const int axis = static_cast<int>((depth + attempt) % 3);
    const float middle = 0.5F * range.min[axis] + 0.5F * range.max[axis];
    // Whether both sides get something is known beforehand: the first item begins at the box's
    // lower face, the last one at latest_min.
    if (!(range.min[axis] < middle && range.latest_min[axis] >= middle)) continue;

    // Every item swaps places with the first right one, and stays there unless it goes left: no
    // branch to mispredict.
    std::uint32_t divide = range.begin;
    for (std::uint32_t i = range.begin, stop = 0; i < range.end;) {
      for (stop = meter.part_end(i, range.end); i < stop; ++i) {
        const FourFloats lower = FourFloats::load(&items[i].min);
        const FourFloats upper = FourFloats::load(&items[i].max);
        const bool left = items[i].min[axis] < middle;
        FourFloats::load(&items[divide].min).store(&items[i].min);
        FourFloats::load(&items[divide].max).store(&items[i].max);
        lower.store(&items[divide].min);
        upper.store(&items[divide].max);
        divide += left ? 1 : 0;
      }
    }
    return divide;
  }
  return range.begin + (range.end - range.begin) / 2;
}

void Bvh::build_median(BuildMeter& meter) {
  const auto count = static_cast<std::uint32_t>(triangles_.size());
  items_.reset(count, memory_, allocations_);
  fill_items(meter);
  const Item* const items = items_.data();
  gpu::BvhNode* const nodes = root();

  struct Task {
    std::uint32_t node, begin, end, depth;
  };
  // Each level of the path to the current node leaves at most its right child waiting.
  std::array<Task, kMaxDepth + 1> waiting;
  std::uint32_t waiting_count = 0;
  std::uint32_t next_child = 1;
  Task task{0, 0, count, 0};
  for (;;) {
    gpu::BvhNode& node = nodes[task.node];
    const std::uint32_t size = task.end - task.begin;
    if (size >= BuildMeter::kNode && meter.watched()) {
      double left = BuildMeter::left(size);
      for (std::uint32_t i = 0; i < waiting_count; ++i) {
        left += BuildMeter::left(waiting[i].end - waiting[i].begin);
      }
      meter.report(1.0 - left / BuildMeter::left(count));
    }
    const Range range = fit(node, task.begin, task.end, meter);
    max_depth_ = task.depth > max_depth_ ? task.depth : max_depth_;

    if (size == 1) {
      node.first = items[task.begin].triangle;
      node.count = 1;
    } else {
      // An inner node: go on with the left child, let the right one wait.
      const std::uint32_t divide = size == 2 ? task.begin + 1 : split(range, task.depth, meter);
      node.first = next_child;
      node.count = 0;
      waiting[waiting_count++] = {next_child + 1, divide, task.end, task.depth + 1};
      task = {next_child, task.begin, divide, task.depth + 1};
      next_child += 2;
      continue;
    }
    if (waiting_count == 0) break;
    task = waiting[--waiting_count];
  }
}

}  // namespace encore::accel
