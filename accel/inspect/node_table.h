#pragma once

#include "accel/acceleration_structure.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace encore::accel {

/// "No node": the parent of a root, the answer where nothing was found.
inline constexpr std::uint32_t kNoNode = 0xFFFFFFFFU;

/// One node or cell. Nodes are numbered in depth-first order, so those below node i are the nodes
/// i + 1 to subtree_end - 1.
struct NodeRecord {
  Bounds bounds;
  std::uint32_t parent = kNoNode;
  std::uint32_t subtree_end = 0;      ///< one past the last node below this one
  std::uint32_t triangles = 0;        ///< leaf: its references; inner: those of all leaves below
  std::uint32_t first_reference = 0;  ///< of a leaf; see triangles_of()
  float split_position = 0.0F;
  std::uint16_t depth = 0;
  std::int8_t split_axis = -1;  ///< 0..2 for inner kd-tree nodes
  bool leaf = false;

  /// A leaf of a kd-tree that holds nothing; grids do not list their empty cells.
  [[nodiscard]] bool empty_leaf() const { return leaf && triangles == 0; }
};
static_assert(sizeof(NodeRecord) == 48);

/// What the nodes of a table are.
enum class NodeKind : std::uint8_t {
  boxes,         ///< of a bounding volume hierarchy
  split_planes,  ///< a kd-tree: inner nodes divide their box by a plane
  cells,         ///< of a grid: leaves without parents, the empty ones left out
  list,          ///< one leaf that holds everything
};

/// A flat copy of a structure's nodes, to be drawn, measured and searched while the structure
/// itself is traced or built anew elsewhere: 48 bytes a node, for a BVH 4 more a node and triangle.
class NodeTable {
 public:
  NodeTable() = default;
  /// Copies what `structure` is now. Ends early, with cancelled() set and no records, once `cancel`
  /// is true.
  static NodeTable make(const AccelerationStructure& structure,
                        const std::atomic<bool>* cancel = nullptr);

  [[nodiscard]] std::span<const NodeRecord> records() const { return records_; }
  [[nodiscard]] const NodeRecord& operator[](std::uint32_t node) const { return records_[node]; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(records_.size()); }
  [[nodiscard]] bool empty() const { return records_.empty(); }
  [[nodiscard]] bool cancelled() const { return cancelled_; }
  [[nodiscard]] NodeKind kind() const { return kind_; }
  [[nodiscard]] std::uint32_t max_depth() const { return max_depth_; }
  /// The box of everything.
  [[nodiscard]] const Bounds& bounds() const { return bounds_; }
  /// Grids: cells along each axis, the empty ones too; else 0.
  [[nodiscard]] const std::array<std::uint32_t, 3>& cells() const { return cells_; }
  /// AccelerationStructure::version() of what was copied.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// Memory that the table takes.
  [[nodiscard]] std::uint64_t bytes() const;

  /// The node that trace_path() and visit() call `place`; kNoNode if there is none (an empty cell).
  [[nodiscard]] std::uint32_t index_of(std::uint32_t place) const;

  /// The triangles of a leaf, ascending within a grid's cell. Only a structure without an array of
  /// references (a BVH) has them copied; else this looks into the memory of `structure`, which must
  /// be the one that the table was made of: nothing if it was built or updated since. An inner node
  /// gives an empty span.
  [[nodiscard]] std::optional<std::span<const std::uint32_t>> triangles_of(
      const AccelerationStructure& structure, std::uint32_t node) const;
  /// The triangles of all leaves below a node, ascending and each once; at most `most` references
  /// are looked at.
  [[nodiscard]] std::optional<std::vector<std::uint32_t>> triangles_below(
      const AccelerationStructure& structure, std::uint32_t node,
      std::size_t most = std::size_t(-1)) const;

 private:
  class Filler;
  void connect();
  void index_places(std::vector<std::uint32_t> places);

  std::vector<NodeRecord> records_;
  std::vector<std::uint32_t> own_references_;
  // At most one of both: node by place, or the ascending places of the nodes. Neither: equal.
  std::vector<std::uint32_t> node_of_place_;
  std::vector<std::uint32_t> ascending_places_;
  Bounds bounds_;
  std::array<std::uint32_t, 3> cells_{};
  std::uint64_t version_ = 0;
  std::uint32_t max_depth_ = 0;
  NodeKind kind_ = NodeKind::list;
  bool cancelled_ = false;
};

/// The nodes from the root down to `node`, both included.
std::vector<std::uint32_t> path_to_root(const NodeTable& table, std::uint32_t node);

}  // namespace encore::accel
