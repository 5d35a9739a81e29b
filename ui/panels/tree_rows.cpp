#include "ui/panels/tree_rows.h"

#include <algorithm>

namespace encore::ui {

namespace {

/// Cells by their number of references, by counting.
std::vector<std::uint32_t> by_occupancy(const accel::NodeTable& table) {
  std::uint32_t most = 0;
  for (const accel::NodeRecord& node : table.records()) most = std::max(most, node.triangles);
  // Cells beyond the last bucket are few: there cannot be many that large.
  constexpr std::uint32_t kBuckets = 65'536;
  const std::uint32_t last = std::min(most, kBuckets - 1);
  std::vector<std::uint32_t> starts(std::size_t{last} + 2, 0);
  const auto bucket = [last](const accel::NodeRecord& node) {
    return last - std::min(node.triangles, last);
  };
  for (const accel::NodeRecord& node : table.records()) ++starts[bucket(node) + 1];
  for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
  const std::uint32_t fullest = starts[1];
  std::vector<std::uint32_t> rows(table.size());
  for (std::uint32_t i = 0; i < table.size(); ++i) rows[starts[bucket(table[i])]++] = i;
  std::stable_sort(rows.begin(), rows.begin() + fullest,
                   [&table](auto a, auto b) { return table[a].triangles > table[b].triangles; });
  return rows;
}

}  // namespace

std::vector<std::uint32_t> tree_rows(const accel::NodeTable& table,
                                     const std::set<std::uint32_t>& open) {
  if (table.kind() == accel::NodeKind::cells) return by_occupancy(table);
  std::vector<std::uint32_t> rows;
  std::uint32_t node = 0;
  while (node < table.size()) {
    rows.push_back(node);
    const accel::NodeRecord& record = table[node];
    node = !record.leaf && open.contains(node) ? node + 1 : record.subtree_end;
  }
  return rows;
}

std::vector<std::uint32_t> children_of(const accel::NodeTable& table, std::uint32_t node) {
  std::vector<std::uint32_t> children;
  const accel::NodeRecord& record = table[node];
  if (record.leaf) return children;
  for (std::uint32_t child = node + 1; child < record.subtree_end;
       child = table[child].subtree_end) {
    children.push_back(child);
  }
  return children;
}

void follow_table(TreeState& tree, const std::shared_ptr<const accel::NodeTable>& table) {
  const auto before = tree.of.lock();
  if (before != table) {
    // After a refit the numbers mean the same nodes; after a rebuild of another size they do not.
    const bool same_size = before && table && before->size() == table->size();
    if (!same_size) {
      tree.open.clear();
      if (table && !table->empty()) tree.open.insert(0);
    }
    tree.of = table;
    tree.stale = true;
    tree.revealed.reset();
  }
  if (!tree.stale) return;
  tree.stale = false;
  tree.rows = table ? tree_rows(*table, tree.open) : std::vector<std::uint32_t>{};
}

void toggle_node(TreeState& tree, std::uint32_t node) {
  if (tree.open.erase(node) == 0) tree.open.insert(node);
  tree.stale = true;
}

void reveal_node(TreeState& tree, const accel::NodeTable& table, std::uint32_t node) {
  if (node >= table.size()) return;
  for (const std::uint32_t above : accel::path_to_root(table, node)) {
    if (above != node && tree.open.insert(above).second) tree.stale = true;
  }
}

std::optional<std::size_t> row_of(const TreeState& tree, std::uint32_t node) {
  const auto found = std::find(tree.rows.begin(), tree.rows.end(), node);
  if (found == tree.rows.end()) return std::nullopt;
  return static_cast<std::size_t>(found - tree.rows.begin());
}

std::optional<double> sah_share(const accel::NodeTable& table, std::uint32_t node,
                                double sah_cost) {
  if (!(sah_cost > 0.0) || node >= table.size()) return std::nullopt;
  const accel::NodeRecord& record = table[node];
  const bool cells = table.kind() == accel::NodeKind::cells;
  const double tests =
      record.leaf ? static_cast<double>(record.triangles) + (cells ? 1.0 : 0.0) : 1.0;
  if (table.kind() == accel::NodeKind::list) return tests / sah_cost;
  const double whole = table.bounds().area();
  if (!(whole > 0.0)) return std::nullopt;
  return record.bounds.area() / whole * tests / sah_cost;
}

}  // namespace encore::ui
