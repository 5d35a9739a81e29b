#include "accel/bvh/bvh.h"
#include "accel/bvh/four_floats.h"

#include <algorithm>
#include <array>

namespace encore::accel {

static_assert(sizeof(gpu::BvhNode) == 32);

namespace {

// Of this many triangles and fewer one thread builds all nodes; no task is made for fewer than
// those.
constexpr std::uint32_t kBranch = 1U << 13U;
constexpr std::uint32_t kWorthATask = 1U << 10U;

}  // namespace

/// The items of one node, and what a split has to know about them.
struct Bvh::Range {
  std::uint32_t begin, end;
  glm::vec3 min, max;    ///< tight bounds
  glm::vec3 latest_min;  ///< the largest lower end of any item, by axis
};

void Bvh::fill_items(std::size_t begin, std::size_t end) {
  Item* item = items_.data() + begin;
  auto index = static_cast<std::uint32_t>(begin);
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

std::uint32_t Bvh::build_branch(const Branch& branch, BuildMeter& meter) {
  const Item* const items = items_.data();
  gpu::BvhNode* const nodes = root();

  struct Task {
    std::uint32_t node, begin, end, depth;
  };
  // Each level of the path to the current node leaves at most its right child waiting.
  std::array<Task, kMaxDepth + 1> waiting;
  std::uint32_t waiting_count = 0;
  std::uint32_t next_child = branch.next_child;
  std::uint32_t deepest = branch.depth;
  Task task{branch.node, branch.begin, branch.end, branch.depth};
  for (;;) {
    gpu::BvhNode& node = nodes[task.node];
    const std::uint32_t size = task.end - task.begin;
    if (size >= BuildMeter::kNode && meter.watched()) {
      double left = BuildMeter::left(size);
      for (std::uint32_t i = 0; i < waiting_count; ++i) {
        left += BuildMeter::left(waiting[i].end - waiting[i].begin);
      }
      meter.report(1.0 - left / BuildMeter::left(branch.size()));
    }
    const Range range = fit(node, task.begin, task.end, meter);
    deepest = task.depth > deepest ? task.depth : deepest;

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
  return deepest;
}

/// The same nodes: n triangles make 2 n - 2 nodes below theirs, so it is known beforehand where
/// those of a right child begin.
std::uint32_t Bvh::build_together(const Branch& branch, SharedMeter& meter,
                                  const Workers& workers) {
  if (branch.size() <= kBranch) {
    TaskMeter own(meter.meter());
    const std::uint32_t deepest = build_branch(branch, own.meter());
    meter.add(BuildMeter::left(branch.size()));
    return deepest;
  }
  TaskMeter own(meter.meter());
  gpu::BvhNode& node = root()[branch.node];
  const Range range = fit(node, branch.begin, branch.end, own.meter());
  const std::uint32_t divide = split(range, branch.depth, own.meter());
  node.first = branch.next_child;
  node.count = 0;
  const Branch left{branch.next_child, branch.begin, divide, branch.depth + 1,
                    branch.next_child + 2};
  const Branch right{branch.next_child + 1, divide, branch.end, branch.depth + 1,
                     branch.next_child + 2 * left.size()};
  meter.add(BuildMeter::left(branch.size()) - BuildMeter::left(left.size()) -
            BuildMeter::left(right.size()));
  std::uint32_t deepest_left = 0;
  std::uint32_t deepest_right = 0;
  workers.both(
      left.size() > kWorthATask && right.size() > kWorthATask,
      [&] { deepest_left = build_together(left, meter, workers); },
      [&] { deepest_right = build_together(right, meter, workers); });
  return std::max(deepest_left, deepest_right);
}

void Bvh::build_median(BuildMeter& meter, const Workers& workers) {
  const auto count = static_cast<std::uint32_t>(triangles_.size());
  items_.reset(count, memory_, allocations_);
  const Branch whole{0, 0, count, 0, 1};
  if (!workers.parallel()) {
    meter.pass(count, [this](std::size_t begin, std::size_t end) { fill_items(begin, end); });
    max_depth_ = build_branch(whole, meter);
    return;
  }
  SharedMeter filling(meter, meter.done(), count);
  workers.for_parts(count, kBranch, [&](std::size_t begin, std::size_t end) {
    fill_items(begin, end);
    filling.add(double(end - begin));
  });
  SharedMeter building(meter, 1.0, BuildMeter::left(count));
  max_depth_ = build_together(whole, building, workers);
}

}  // namespace encore::accel
