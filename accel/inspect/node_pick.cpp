#include "accel/box_hit.h"
#include "accel/inspect/node_selection.h"

#include <algorithm>

namespace encore::accel {

namespace {

/// Takes nodes that the ray enters, in the table's order, and remembers the one that a click means.
class Picker {
 public:
  explicit Picker(const NodeTable& table) : table_(table) {}

  void add(std::uint32_t node, float enter, bool around) {
    // Only now it is known whether the node before has one below it.
    if (pending_ != kNoNode && node >= table_[pending_].subtree_end) settle();
    pending_ = node;
    pending_enter_ = enter;
    pending_around_ = around;
  }
  std::uint32_t result() {
    if (pending_ != kNoNode) settle();
    return best_;
  }

 private:
  void settle() {
    const bool better =
        best_ == kNoNode || (best_around_ && !pending_around_) ||
        (best_around_ == pending_around_ &&
         (pending_around_ ? table_[pending_].bounds.area() < table_[best_].bounds.area()
                          : pending_enter_ < best_enter_));
    if (!better) return;
    best_ = pending_;
    best_enter_ = pending_enter_;
    best_around_ = pending_around_;
  }

  const NodeTable& table_;
  std::uint32_t pending_ = kNoNode;
  float pending_enter_ = 0.0F;
  bool pending_around_ = false;
  std::uint32_t best_ = kNoNode;
  float best_enter_ = 0.0F;
  bool best_around_ = false;
};

/// Where a ray enters boxes.
class BoxEntry {
 public:
  explicit BoxEntry(const Ray& ray) : ray_(ray), box_ray_(ray) {}

  [[nodiscard]] BoxStretch operator()(const Bounds& box) const {
    if (box.empty()) return {1.0F, -1.0F};
    return box_stretch(box.min, box.max, box_ray_, ray_.t_min, ray_.t_max);
  }
  [[nodiscard]] bool starts_inside(const BoxStretch& stretch) const {
    return !(stretch.enter > ray_.t_min);
  }

 private:
  const Ray& ray_;
  BoxRay box_ray_;
};

}  // namespace

std::uint32_t pick_node(const NodeTable& table, std::span<const std::uint32_t> drawn,
                        const Ray& ray) {
  const BoxEntry entry(ray);
  std::vector<std::uint32_t> met;
  for (const std::uint32_t node : drawn) {
    if (entry(table[node].bounds).hit()) met.push_back(node);
  }
  std::sort(met.begin(), met.end());
  Picker picker(table);
  for (const std::uint32_t node : met) {
    const BoxStretch stretch = entry(table[node].bounds);
    picker.add(node, stretch.enter, entry.starts_inside(stretch));
  }
  return picker.result();
}

std::uint32_t pick_node(const NodeTable& table, const NodeFilter& filter, const Ray& ray) {
  const BoxEntry entry(ray);
  Picker picker(table);
  const bool all = filter.subtree == kNoNode || filter.subtree >= table.size();
  const std::uint32_t end = all ? table.size() : table[filter.subtree].subtree_end;
  for (std::uint32_t i = all ? 0 : filter.subtree; i < end;) {
    const BoxStretch stretch = entry(table[i].bounds);
    if (!stretch.hit() || table[i].depth > filter.last_depth) {
      i = table[i].subtree_end;
      continue;
    }
    if (filter.passes(table[i])) picker.add(i, stretch.enter, entry.starts_inside(stretch));
    ++i;
  }
  return picker.result();
}

}  // namespace encore::accel
