#include "accel/wide/wide_child_order.h"

#include "accel/wide/wide_node.h"

#include <array>
#include <cstdint>
#include <iterator>

namespace encore::accel {

namespace {

/// Nodes farther below the root are too small for their order to be felt.
constexpr std::uint32_t kOrderedDepth = 2;

struct Child {
  bool leaf;
  double area;
  std::uint32_t lane;

  friend bool operator<(const Child& a, const Child& b) {
    return a.leaf != b.leaf ? b.leaf : a.area < b.area;
  }
};

void order(gpu::WideNode& node, std::uint32_t count) {
  std::array<Child, WideTree::kWidth> children;
  for (std::uint32_t i = 0; i < count; ++i) {
    // Put in its place at once: std::stable_sort would ask the allocator for every node.
    const Child child{WideChild::is_leaf(node.child[i]), child_bounds(node, i).area(), i};
    std::uint32_t place = i;
    for (; place > 0 && child < children[place - 1]; --place) children[place] = children[place - 1];
    children[place] = child;
  }
  const gpu::WideNode before = node;
  for (std::uint32_t i = 0; i < count; ++i) {
    node.child[i] = before.child[children[i].lane];
    for (std::uint32_t row = 0; row < std::size(node.bounds); row += WideTree::kWidth) {
      node.bounds[row + i] = before.bounds[row + children[i].lane];
    }
  }
}

void order_below(WideTree& tree, std::uint32_t index, std::uint32_t depth) {
  gpu::WideNode& node = tree.nodes[index];
  std::uint32_t count = 0;  // empty places come last
  while (count < WideTree::kWidth && node.child[count] != WideChild::kNoChild) ++count;
  order(node, count);
  if (depth == kOrderedDepth) return;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!WideChild::is_leaf(node.child[i])) order_below(tree, node.child[i], depth + 1);
  }
}

}  // namespace

void order_wide_children(WideTree& tree) {
  order_below(tree, 0, 0);
}

}  // namespace encore::accel
