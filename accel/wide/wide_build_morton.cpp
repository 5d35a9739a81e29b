// The top of a tree along Morton codes.
#include "accel/large_pages.h"
#include "accel/wide/wide_build_memory.h"
#include "accel/wide/wide_build_top.h"
#include "accel/wide/wide_codes.h"
#include "accel/wide/wide_morton_range.h"

namespace encore::accel {

namespace {

class MortonRules {
 public:
  using Range = WideKeyRange;

  explicit MortonRules(WideBuildRun& run)
      : run_(run), keys_{run.memory.keys[0].data(), run.memory.keys[1].data()} {}

  [[nodiscard]] Range all() const {
    return key_range(keys_, 0, 0, static_cast<std::uint32_t>(run_.triangles.size()));
  }

  static bool divisible(const Range& range) { return range.divisible(); }
  static bool wider(const Range& a, const Range& b) { return a.level > b.level; }

  [[nodiscard]] std::uint32_t leaf(const Range& range) const {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      run_.memory.order[i] = static_cast<std::uint32_t>(keys_[range.array][i]);
    }
    return WideTopology::leaf(range.begin, range.end - range.begin);
  }

  static WideRange subtree(const Range& range) {
    WideRange items{};
    items.begin = range.begin;
    items.end = range.end;
    items.array = range.array;
    return items;
  }

  static std::uint32_t room(const Range& range) { return range.end - range.begin; }

  void divide(Range& range, Range& other, std::uint32_t /*depth*/) const {
    const std::uint32_t middle = divide_keys(keys_, range);
    other = key_range(keys_, range.array, middle, range.end);
    range = key_range(keys_, range.array, range.begin, middle);
  }

 private:
  WideBuildRun& run_;
  const std::uint64_t* keys_[2];
};

}  // namespace

void build_wide_morton(WideBuildRun& run) {
  const std::size_t count = run.triangles.size();
  WideBuildMemory& memory = run.memory;
  for (auto& keys : memory.keys) keys.reset(count, run.mode, run.allocations);
  memory.order.reset(count, run.mode, run.allocations);
  for (auto& keys : memory.keys) ask_for_large_pages(keys.bytes());
  ask_for_large_pages(memory.order.bytes());
  float lower[3], upper[3];
  for (int axis = 0; axis < 3; ++axis) {
    lower[axis] = 2.0F * (run.box.ends[axis] * run.unit);
    upper[axis] = -2.0F * (run.box.ends[axis + 4] * run.unit);
  }
  set_morton(memory.morton, run.unit, lower, upper);
  spread_morton(memory.morton);
  for_wide_parts(run, count, 0.2, [&](std::size_t begin, std::size_t end) {
    run.kernels.keys(run.triangles.data(), begin, end, memory.morton, memory.keys[0].data());
  });
  sort_wide_keys(run);
  refine_wide_keys(run);
  run.meter.report(0.4);
  MortonRules rules(run);
  WideTop<MortonRules>(run, rules, kWideSubtree).build(rules.all());
  const WideBuildArrays arrays{.items = {nullptr, nullptr},
                               .keys = {memory.keys[0].data(), memory.keys[1].data()},
                               .nodes = memory.nodes.data(),
                               .order = memory.order.data(),
                               .leaf_boxes = nullptr,
                               .bins = 0,
                               .spatial = nullptr};
  for_wide_pieces(run, memory.subtrees.size(), 0.6,
                  [&](std::size_t i) { run.kernels.morton_subtree(arrays, memory.subtrees[i]); });
}

}  // namespace encore::accel
