#include "accel/inspect/node_table.h"

#include "accel/settings.h"
#include "shaders/shared/bindings.h"

#include <algorithm>
#include <utility>

namespace encore::accel {

namespace {

constexpr std::size_t kNodesBetweenChecks = 4096;

/// A structure's array of references; empty if it has none.
std::span<const std::uint32_t> references_of(const AccelerationStructure& structure) {
  for (const GpuBuffer& buffer : structure.gpu_buffers()) {
    if (buffer.binding != ENCORE_BINDING_REFERENCES) continue;
    return {reinterpret_cast<const std::uint32_t*>(buffer.bytes.data()),
            buffer.bytes.size() / sizeof(std::uint32_t)};
  }
  return {};
}

NodeKind kind_of(const AccelerationStructure& structure) {
  switch (parse_structure_kind(structure.name()).value_or(StructureKind::brute)) {
    case StructureKind::grid_exact:
    case StructureKind::grid_box:
      return NodeKind::cells;
    case StructureKind::kd_median:
    case StructureKind::kd_sah:
      return NodeKind::split_planes;
    case StructureKind::bvh_median:
    case StructureKind::bvh_sah:
      return NodeKind::boxes;
    case StructureKind::brute:
      break;
  }
  return NodeKind::list;
}

std::size_t count_nodes(const AccelerationStructure& structure) {
  std::size_t count = 0;
  structure.visit([&count](const NodeView&) {
    ++count;
    return true;
  });
  return count;
}

}  // namespace

/// Takes the nodes of one structure as they are visited.
class NodeTable::Filler {
 public:
  Filler(NodeTable& table, const AccelerationStructure& structure, const std::atomic<bool>* cancel)
      : table_(table), references_(references_of(structure)), cancel_(cancel) {}

  bool add(const NodeView& view) {
    const std::uint32_t index = table_.size();
    if (index % kNodesBetweenChecks == 0 && cancel_ != nullptr && *cancel_) {
      table_.cancelled_ = true;
    }
    if (table_.cancelled_) return false;

    NodeRecord node;
    node.bounds = view.bounds;
    node.depth = static_cast<std::uint16_t>(view.depth);
    node.leaf = view.leaf;
    node.split_axis = static_cast<std::int8_t>(view.split_axis);
    node.split_position = view.split_position;
    // The parent is the last node met one level higher.
    if (view.depth > 0) node.parent = path_[view.depth - 1];
    if (view.leaf) add_references(view.triangles, node);
    if (path_.size() <= view.depth) path_.resize(view.depth + 1);
    path_[view.depth] = index;
    table_.records_.push_back(node);
    table_.max_depth_ = std::max(table_.max_depth_, view.depth);
    places_.push_back(view.place);
    return true;
  }
  void reserve(std::size_t count) {
    table_.records_.reserve(count);
    places_.reserve(count);
    if (references_.empty()) table_.own_references_.reserve(count / 2 + 1);
  }
  std::vector<std::uint32_t> take_places() { return std::move(places_); }

 private:
  void add_references(std::span<const std::uint32_t> triangles, NodeRecord& node) {
    node.triangles = static_cast<std::uint32_t>(triangles.size());
    if (triangles.empty()) return;
    if (!references_.empty()) {
      node.first_reference = static_cast<std::uint32_t>(triangles.data() - references_.data());
      return;
    }
    std::vector<std::uint32_t>& own = table_.own_references_;
    node.first_reference = static_cast<std::uint32_t>(own.size());
    own.insert(own.end(), triangles.begin(), triangles.end());
  }

  NodeTable& table_;
  std::span<const std::uint32_t> references_;
  const std::atomic<bool>* cancel_;
  std::vector<std::uint32_t> path_;  // the latest node of each depth
  std::vector<std::uint32_t> places_;
};

NodeTable NodeTable::make(const AccelerationStructure& structure, const std::atomic<bool>* cancel) {
  NodeTable table;
  table.version_ = structure.version();
  table.kind_ = kind_of(structure);
  const gpu::StructureParameters parameters = structure.gpu_parameters();
  table.cells_ = {parameters.cells.x, parameters.cells.y, parameters.cells.z};
  Filler filler(table, structure, cancel);
  // Counting first costs less than growing, and leaves no spare memory.
  filler.reserve(count_nodes(structure));
  structure.visit([&filler](const NodeView& view) { return filler.add(view); });
  if (table.cancelled_) {
    table.records_ = {};
    table.own_references_ = {};
    return table;
  }
  table.connect();
  table.index_places(filler.take_places());
  if (table.kind_ == NodeKind::cells) {
    table.bounds_ = table.empty() ? Bounds{} : Bounds{parameters.min, parameters.max};
  } else if (!table.empty()) {
    table.bounds_ = table.records_.front().bounds;
  }
  return table;
}

/// Fills in what depends on the nodes below. In reverse every node comes after all below it.
void NodeTable::connect() {
  for (std::uint32_t i = size(); i-- > 0;) {
    NodeRecord& node = records_[i];
    node.subtree_end = std::max(node.subtree_end, i + 1);
    if (node.parent == kNoNode) continue;
    NodeRecord& parent = records_[node.parent];
    parent.subtree_end = std::max(parent.subtree_end, node.subtree_end);
    parent.triangles += node.triangles;
  }
}

void NodeTable::index_places(std::vector<std::uint32_t> places) {
  bool equal = true;
  std::uint32_t largest = 0;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    equal = equal && places[i] == i;
    largest = std::max(largest, places[i]);
  }
  if (equal) return;
  if (std::is_sorted(places.begin(), places.end())) {
    ascending_places_ = std::move(places);
    return;
  }
  node_of_place_.assign(std::size_t{largest} + 1, kNoNode);
  for (std::uint32_t i = 0; i < places.size(); ++i) node_of_place_[places[i]] = i;
}

std::uint32_t NodeTable::index_of(std::uint32_t place) const {
  if (!node_of_place_.empty()) {
    return place < node_of_place_.size() ? node_of_place_[place] : kNoNode;
  }
  if (ascending_places_.empty()) return place < size() ? place : kNoNode;
  const auto found = std::lower_bound(ascending_places_.begin(), ascending_places_.end(), place);
  if (found == ascending_places_.end() || *found != place) return kNoNode;
  return static_cast<std::uint32_t>(found - ascending_places_.begin());
}

std::uint64_t NodeTable::bytes() const {
  return records_.capacity() * sizeof(NodeRecord) +
         (own_references_.capacity() + node_of_place_.capacity() + ascending_places_.capacity()) *
             sizeof(std::uint32_t);
}

std::optional<std::span<const std::uint32_t>> NodeTable::triangles_of(
    const AccelerationStructure& structure, std::uint32_t node) const {
  const NodeRecord& record = records_[node];
  if (!record.leaf || record.triangles == 0) return std::span<const std::uint32_t>{};
  if (!own_references_.empty()) {
    return std::span(own_references_).subspan(record.first_reference, record.triangles);
  }
  if (structure.version() != version_) return std::nullopt;
  return references_of(structure).subspan(record.first_reference, record.triangles);
}

std::optional<std::vector<std::uint32_t>> NodeTable::triangles_below(
    const AccelerationStructure& structure, std::uint32_t node, std::size_t most) const {
  if (own_references_.empty() && structure.version() != version_) return std::nullopt;
  const std::span<const std::uint32_t> references =
      own_references_.empty() ? references_of(structure) : std::span(own_references_);
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = node; i < records_[node].subtree_end && all.size() < most; ++i) {
    const NodeRecord& record = records_[i];
    if (!record.leaf) continue;
    const auto leaf = references.subspan(
        record.first_reference, std::min<std::size_t>(record.triangles, most - all.size()));
    all.insert(all.end(), leaf.begin(), leaf.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<std::uint32_t> path_to_root(const NodeTable& table, std::uint32_t node) {
  std::vector<std::uint32_t> path;
  for (std::uint32_t i = node; i != kNoNode; i = table[i].parent) path.push_back(i);
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace encore::accel
