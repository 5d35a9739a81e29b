#include "accel/wide/wide_build.h"
#include "accel/wide/wide_build_kernels.h"
#include "accel/wide/wide_node.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace encore::accel {

namespace {

/// Nodes [begin, end) lie together and are a subtree.
struct Piece {
  std::size_t begin, end;
};

constexpr std::size_t kPieceNodes = 1024;

/// Cuts the tree into subtrees of at most kPieceNodes nodes; `above` are the nodes over them, in
/// ascending order.
void cut(const WideTree& tree, Piece piece, std::vector<std::size_t>& above,
         std::vector<Piece>& pieces) {
  if (piece.end - piece.begin <= kPieceNodes) {
    pieces.push_back(piece);
    return;
  }
  above.push_back(piece.begin);
  std::vector<std::size_t> ends{piece.end};
  for (const std::uint32_t child : tree.nodes[piece.begin].child) {
    if (!WideChild::is_leaf(child)) ends.push_back(child);  // kNoChild has the leaf's bit, too
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 1; i < ends.size(); ++i) cut(tree, {ends[i - 1], ends[i]}, above, pieces);
}

}  // namespace

void WideBuilder::refit(std::span<const scene::Triangle> triangles, Workers& workers,
                        WideTree& tree) {
  if (tree.nodes.empty()) return;
  const auto fit = [&](std::size_t begin, std::size_t end) {
    kernels_->fit(triangles.data(), tree.ids.data(), tree.blocks.data(), tree.nodes.data(),
                  {begin, end});
  };
  if (workers.parallel()) {
    std::vector<std::size_t> above;
    std::vector<Piece> pieces;
    cut(tree, {0, tree.nodes.size()}, above, pieces);
    workers.for_parts(pieces.size(), 1,
                      [&](std::size_t i, std::size_t) { fit(pieces[i].begin, pieces[i].end); });
    for (std::size_t i = above.size(); i-- > 0;) fit(above[i], above[i] + 1);
  } else {
    fit(0, tree.nodes.size());
  }
  scene::Bounds all;
  for (std::uint32_t k = 0; k < WideTree::kWidth; ++k) {
    if (tree.nodes[0].child[k] != WideChild::kNoChild) all.extend(child_bounds(tree.nodes[0], k));
  }
  tree.min = all.min;
  tree.max = all.max;
}

}  // namespace encore::accel
