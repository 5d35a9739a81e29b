// Subtrees and what lies above them, put into their places.
#include "accel/large_pages.h"
#include "accel/wide/wide_build_memory.h"
#include "accel/wide/wide_child_order.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace encore::accel {

namespace {

class Finish {
 public:
  Finish(WideBuildRun& run, WideTree& tree) : run_(run), tree_(tree), memory_(run.memory) {}

  void finish() {
    memory_.top_places.reset(memory_.top.size(), run_.mode, run_.allocations);
    memory_.subtree_places.reset(memory_.subtrees.size(), run_.mode, run_.allocations);
    if (memory_.top.empty()) {
      place_subtree(0);
    } else {
      place(0, 0);
    }
    tree_.leaves = leaves_;
    tree_.references = next_references_;
    tree_.nodes.reset(next_.node, run_.mode, run_.allocations);
    tree_.blocks.reset(next_.block, run_.mode, run_.allocations);
    tree_.ids.reset(std::size_t{next_.block} * TriangleBlock::kSize, run_.mode, run_.allocations);
    ask_for_large_pages(tree_.nodes.bytes());
    ask_for_large_pages(tree_.blocks.bytes());
    ask_for_large_pages(tree_.ids.bytes());
    for_wide_pieces(run_, memory_.subtrees.size(), 0.99, [&](std::size_t i) { emit_subtree(i); });
    // Lower nodes have higher numbers.
    for (std::size_t i = memory_.top.size(); i-- > 0;) emit_top(i);
    order_wide_children(tree_);
    fit_root();
  }

 private:
  /// Numbers the nodes and blocks in the order of a depth-first walk.
  void place(std::uint32_t top, std::uint32_t depth) {
    memory_.top_places[top].node = next_.node++;
    tree_.depth = std::max(tree_.depth, depth);
    for (std::uint32_t k = 0; k < WideTree::kWidth; ++k) {
      const std::uint32_t child = memory_.top[top].child[k];
      if (child == WideChild::kNoChild) break;
      memory_.top_places[top].child[k] = next_;
      if (WideChild::is_leaf(child)) {
        ++leaves_;
        next_.block += WideTopology::blocks(WideTopology::count(child));
        next_references_ += WideTopology::count(child);
      } else if ((child & WideTopNode::kSubtree) != 0) {
        place_subtree(child & ~WideTopNode::kSubtree);
      } else {
        place(child, depth + 1);
      }
    }
  }

  void place_subtree(std::uint32_t index) {
    const WideSubtree& subtree = memory_.subtrees[index];
    memory_.subtree_places[index] = next_;
    tree_.depth = std::max(tree_.depth, subtree.deepest);
    next_.node += subtree.nodes;
    next_.block += subtree.blocks;
    leaves_ += subtree.leaves;
    next_references_ += subtree.references;
  }

  void emit_subtree(std::size_t index) {
    const WideSubtree& subtree = memory_.subtrees[index];
    const WidePlace place = memory_.subtree_places[index];
    const WideTopology* const from = memory_.nodes.data() + subtree.first_node;
    gpu::WideNode* const to = tree_.nodes.data() + place.node;
    std::uint32_t block = place.block;
    for (std::uint32_t i = 0; i < subtree.nodes; ++i) {
      std::fill_n(to[i].reserved, std::size(to[i].reserved), 0U);
      for (std::uint32_t k = 0; k < WideTree::kWidth; ++k) {
        const std::uint32_t child = from[i].child[k];
        if (child == WideChild::kNoChild) {
          no_child(to[i], k);
        } else if (WideChild::is_leaf(child)) {
          block += leaf(to[i], k, child, block);
        } else {
          to[i].child[k] = place.node + child;
        }
      }
    }
    fit({place.node, place.node + std::size_t{subtree.nodes}, place.block, run_.parts});
  }

  void emit_top(std::size_t index) {
    const WideTopPlace& place = memory_.top_places[index];
    gpu::WideNode& node = tree_.nodes[place.node];
    std::fill_n(node.reserved, std::size(node.reserved), 0U);
    for (std::uint32_t k = 0; k < WideTree::kWidth; ++k) {
      const std::uint32_t child = memory_.top[index].child[k];
      if (child == WideChild::kNoChild) {
        no_child(node, k);
      } else if (WideChild::is_leaf(child)) {
        leaf(node, k, child, place.child[k].block);
      } else {
        node.child[k] = place.child[k].node;
      }
    }
    fit({place.node, place.node + std::size_t{1}, WideFit::kNoBlock, run_.parts});
  }

  static void no_child(gpu::WideNode& node, std::uint32_t k) {
    node.child[k] = WideChild::kNoChild;
    for (std::uint32_t row = 0; row < 6; ++row) {
      node.bounds[8 * row + k] = std::numeric_limits<float>::infinity();
    }
  }

  /// Returns how many blocks it takes.
  std::uint32_t leaf(gpu::WideNode& node, std::uint32_t k, std::uint32_t from,
                     std::uint32_t block) {
    const std::uint32_t* const ids = memory_.order.data() + WideTopology::first(from);
    const std::uint32_t last = WideTopology::count(from) - 1;
    const std::uint32_t blocks = WideTopology::blocks(last + 1);
    node.child[k] = WideChild::leaf(block, blocks);
    std::uint32_t* const to = tree_.ids.data() + std::size_t{block} * TriangleBlock::kSize;
    for (std::uint32_t lane = 0; lane < blocks * TriangleBlock::kSize; ++lane) {
      to[lane] = ids[std::min(lane, last)];
    }
    if (!run_.parts) return blocks;
    const WideBox& box = memory_.leaf_boxes[WideTopology::first(from)];
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      node.bounds[16 * axis + k] = box.ends[axis];
      node.bounds[16 * axis + 8 + k] = box.ends[axis + 4];
    }
    return blocks;
  }

  void fit(const WideFit& nodes) {
    run_.kernels.fit(run_.triangles.data(), tree_.ids.data(), tree_.blocks.data(),
                     tree_.nodes.data(), nodes);
  }

  void fit_root() {
    for (int axis = 0; axis < 3; ++axis) {
      tree_.min[axis] = run_.box.ends[axis];
      tree_.max[axis] = -run_.box.ends[axis + 4];
    }
  }

  WideBuildRun& run_;
  WideTree& tree_;
  WideBuildMemory& memory_;
  WidePlace next_{0, 0};
  std::uint32_t next_references_ = 0;
  std::uint32_t leaves_ = 0;
};

}  // namespace

void finish_wide_tree(WideBuildRun& run, WideTree& tree) {
  tree.triangles = static_cast<std::uint32_t>(run.triangles.size());
  Finish(run, tree).finish();
}

}  // namespace encore::accel
