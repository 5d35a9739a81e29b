#pragma once

#include "accel/inspect/node_table.h"
#include "ui/inspect_state.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace encore::ui {

/// The rows of a node list: a tree's roots and what is open below them, in depth-first order; a
/// grid's cells by occupancy, the fullest first (equal ones in the table's order). Only open nodes'
/// children are visited, so a tree of millions costs what is open.
std::vector<std::uint32_t> tree_rows(const accel::NodeTable& table,
                                     const std::set<std::uint32_t>& open);
/// The children of a node; none of a leaf.
std::vector<std::uint32_t> children_of(const accel::NodeTable& table, std::uint32_t node);

/// Brings `tree` to a table: rows are made anew if the table or the open nodes have changed. A
/// table of another size closes everything but the roots.
void follow_table(TreeState& tree, const std::shared_ptr<const accel::NodeTable>& table);
/// Opens or closes a node.
void toggle_node(TreeState& tree, std::uint32_t node);
/// Opens all above a node; follow_table() then gives it a row.
void reveal_node(TreeState& tree, const accel::NodeTable& table, std::uint32_t node);
/// The row of a node.
std::optional<std::size_t> row_of(const TreeState& tree, std::uint32_t node);

/// Share of the structure's SAH cost that one node has, by the formula of
/// accel::NodeMeasure::sah_share; nothing if the cost is 0.
std::optional<double> sah_share(const accel::NodeTable& table, std::uint32_t node, double sah_cost);

}  // namespace encore::ui
