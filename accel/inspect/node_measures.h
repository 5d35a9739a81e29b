#pragma once

#include "accel/inspect/node_table.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace encore::accel {

/// What nodes can be coloured by. NaN means that a node has no value.
enum class NodeMeasure : std::uint8_t {
  depth,       ///< levels below the root; grids: 0
  leaf_size,   ///< references of a leaf; inner nodes: none
  references,  ///< references of the leaf or of all leaves below
  sah_share,   ///< share of BuildStats::sah_cost that this node alone has
  overlap,     ///< of a BVH node's two children; see node_overlap(). Leaves: none
  refit_decay  ///< surface area over the one at the build; needs node_areas() of then
};
std::string_view to_string(NodeMeasure measure);

/// One value a node, and what a legend has to show.
struct NodeValues {
  std::vector<float> values;  ///< in the table's order; NaN: no value
  std::size_t count = 0;      ///< nodes that have one; the rest is only meaningful if > 0
  float min = 0.0F;
  float max = 0.0F;
  float percentile_1 = 0.0F;
  float percentile_99 = 0.0F;
};

/// Computes a measure for all nodes. `areas_at_build` is needed for refit_decay alone; without it,
/// or with another number of nodes, no node has a value.
NodeValues measure_nodes(const NodeTable& table, NodeMeasure measure,
                         std::span<const double> areas_at_build = {});

/// Surface area of every node: kept from a build, it is what refit_decay compares with.
std::vector<double> node_areas(const NodeTable& table);

/// The cost that stats().sah_cost gives, from the table.
double sah_cost(const NodeTable& table);
/// The share of the cost that grids pay for stepping through cells that hold nothing, which a table
/// does not list; with the nodes' shares it sums to 1. Trees: 0.
double sah_share_of_empty_cells(const NodeTable& table);
/// SAH cost now over the one at the build, from the same areas; nothing if they do not belong to
/// this table or either cost is 0. Above 1: refitting has made rays dearer.
std::optional<double> sah_decay(const NodeTable& table, std::span<const double> areas_at_build);

/// Surface area of what two boxes share over that of `parent`: the chance that a ray which meets
/// the parent has to go to both children because of the overlap. Boxes that merely touch share
/// nothing. NaN if the parent has no area.
float node_overlap(const Bounds& parent, const Bounds& left, const Bounds& right);

/// The nodes of one depth.
struct DepthProfile {
  std::uint64_t inner = 0;
  std::uint64_t leaves = 0;  ///< with the empty ones
  std::uint64_t empty_leaves = 0;
  std::uint64_t references = 0;
  std::uint64_t largest_leaf = 0;
  /// Area of all nodes of this depth over that of the whole: how many of them a random ray that
  /// meets the whole enters. NaN if the whole has no area.
  double area_share = 0.0;
};

/// What statistics show of a structure.
struct StructureProfile {
  std::vector<DepthProfile> depths;  ///< by depth, from the root's
  /// Leaves by size: [0] the empty ones, [1] those of 1 reference, [2] 2, [3] 3-4, [4] 5-8, …; the
  /// last entry is not 0.
  std::vector<std::uint64_t> leaf_sizes;
};
StructureProfile profile_of(const NodeTable& table);
/// The sizes that StructureProfile::leaf_sizes[i] counts, first and last.
std::array<std::uint64_t, 2> leaf_size_range(std::size_t i);

}  // namespace encore::accel
