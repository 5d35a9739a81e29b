#include "accel/inspect/node_measures.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace encore::accel {

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

double full_area(const NodeTable& table) {
  return table.kind() == NodeKind::list ? 1.0 : table.bounds().area();
}

/// What the cells of a grid that hold nothing cost, in units of area: all cells less those listed.
/// The faces across an axis cover the grid's own face once for each cell along that axis.
double empty_cells_area(const NodeTable& table) {
  if (table.kind() != NodeKind::cells || table.empty()) return 0.0;
  const glm::dvec3 size = glm::dvec3(table.bounds().max) - glm::dvec3(table.bounds().min);
  const auto& n = table.cells();
  const double all =
      2.0 * (size.y * size.z * n[0] + size.z * size.x * n[1] + size.x * size.y * n[2]);
  double listed = 0.0;
  for (const NodeRecord& node : table.records()) listed += node.bounds.area();
  const auto cells = std::uint64_t{n[0]} * n[1] * n[2];
  return cells > table.size() ? std::max(0.0, all - listed) : 0.0;
}

/// What one node adds to the SAH cost, whose formula is that of each structure's stats(), also
/// where the whole has no area.
double node_cost(const NodeTable& table, const NodeRecord& node, double area, double whole) {
  const double tests = node.leaf ? static_cast<double>(node.triangles) : 1.0;
  switch (table.kind()) {
    case NodeKind::boxes:
      return whole > 0.0 ? area / whole * tests : 0.0;
    case NodeKind::split_planes:
      return whole > 0.0 ? area / whole * tests : tests;
    case NodeKind::cells:
      return whole > 0.0 ? area / whole * (1.0 + tests) : tests;
    case NodeKind::list:
      break;
  }
  return tests;
}

double cost_with(const NodeTable& table, std::span<const double> areas, double whole) {
  double cost = 0.0;
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    cost += node_cost(table, table[i], areas[i], whole);
  }
  return whole > 0.0 ? cost + empty_cells_area(table) / whole : cost;
}

void fill_sah_shares(const NodeTable& table, std::vector<float>& values) {
  const double total = sah_cost(table);
  const double whole = full_area(table);
  if (!(total > 0.0)) return;
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    const NodeRecord& node = table[i];
    values[i] = static_cast<float>(node_cost(table, node, node.bounds.area(), whole) / total);
  }
}

void fill_overlap(const NodeTable& table, std::vector<float>& values) {
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    const NodeRecord& node = table[i];
    if (node.leaf) continue;
    if (table.kind() != NodeKind::boxes) {
      values[i] = 0.0F;
      continue;
    }
    const std::uint32_t right = table[i + 1].subtree_end;
    if (right >= node.subtree_end) continue;
    values[i] = node_overlap(node.bounds, table[i + 1].bounds, table[right].bounds);
  }
}

void fill_decay(const NodeTable& table, std::span<const double> before,
                std::vector<float>& values) {
  if (before.size() != table.size()) return;
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    const double area = table[i].bounds.area();
    if (before[i] > 0.0) {
      values[i] = static_cast<float>(area / before[i]);
    } else if (area == before[i]) {
      values[i] = 1.0F;
    }
  }
}

void find_range(NodeValues& result) {
  std::vector<float> known;
  known.reserve(result.values.size());
  for (const float value : result.values) {
    if (!std::isnan(value)) known.push_back(value);
  }
  result.count = known.size();
  if (known.empty()) return;
  const auto at = [&known](double share) {
    const auto nth =
        known.begin() +
        static_cast<std::ptrdiff_t>(std::lround(share * static_cast<double>(known.size() - 1)));
    std::nth_element(known.begin(), nth, known.end());
    return *nth;
  };
  result.percentile_1 = at(0.01);
  result.percentile_99 = at(0.99);
  const auto [low, high] = std::minmax_element(known.begin(), known.end());
  result.min = *low;
  result.max = *high;
}

/// Whether the stretches [a0, a1] and [b0, b1] share more than an end.
bool share_stretch(float a0, float a1, float b0, float b1) {
  const float low = std::max(a0, b0);
  const float high = std::min(a1, b1);
  if (low != high) return low < high;
  // A single position: of a flat box, and either inside the other one or its twin.
  const bool a_around = a0 == a1 || (a0 < low && low < a1);
  const bool b_around = b0 == b1 || (b0 < low && low < b1);
  return a_around && b_around;
}

}  // namespace

std::string_view to_string(NodeMeasure measure) {
  switch (measure) {
    case NodeMeasure::depth:
      return "depth";
    case NodeMeasure::leaf_size:
      return "leaf size";
    case NodeMeasure::references:
      return "references";
    case NodeMeasure::sah_share:
      return "share of SAH cost";
    case NodeMeasure::overlap:
      return "overlap of children";
    case NodeMeasure::refit_decay:
      return "growth since the build";
  }
  return "";
}

NodeValues measure_nodes(const NodeTable& table, NodeMeasure measure,
                         std::span<const double> areas_at_build) {
  NodeValues result;
  std::vector<float>& values = result.values;
  values.assign(table.size(), kNone);
  switch (measure) {
    case NodeMeasure::depth:
      for (std::uint32_t i = 0; i < table.size(); ++i) values[i] = table[i].depth;
      break;
    case NodeMeasure::leaf_size:
    case NodeMeasure::references:
      for (std::uint32_t i = 0; i < table.size(); ++i) {
        if (measure == NodeMeasure::leaf_size && !table[i].leaf) continue;
        values[i] = static_cast<float>(table[i].triangles);
      }
      break;
    case NodeMeasure::sah_share:
      fill_sah_shares(table, values);
      break;
    case NodeMeasure::overlap:
      fill_overlap(table, values);
      break;
    case NodeMeasure::refit_decay:
      fill_decay(table, areas_at_build, values);
      break;
  }
  find_range(result);
  return result;
}

std::vector<double> node_areas(const NodeTable& table) {
  std::vector<double> areas;
  areas.reserve(table.size());
  for (const NodeRecord& node : table.records()) areas.push_back(node.bounds.area());
  return areas;
}

double sah_cost(const NodeTable& table) {
  return cost_with(table, node_areas(table), full_area(table));
}

double sah_share_of_empty_cells(const NodeTable& table) {
  const double whole = full_area(table);
  const double total = sah_cost(table);
  return whole > 0.0 && total > 0.0 ? empty_cells_area(table) / whole / total : 0.0;
}

std::optional<double> sah_decay(const NodeTable& table, std::span<const double> areas_at_build) {
  // Grids are rebuilt, never refitted: their cells then are other cells.
  if (table.empty() || table.kind() == NodeKind::cells) return std::nullopt;
  if (areas_at_build.size() != table.size()) return std::nullopt;
  const double now = sah_cost(table);
  const double then = cost_with(table, areas_at_build,
                                table.kind() == NodeKind::list ? 1.0 : areas_at_build.front());
  if (!(now > 0.0) || !(then > 0.0)) return std::nullopt;
  return now / then;
}

float node_overlap(const Bounds& parent, const Bounds& left, const Bounds& right) {
  const double area = parent.area();
  if (!(area > 0.0)) return kNone;
  for (int axis = 0; axis < 3; ++axis) {
    if (!share_stretch(left.min[axis], left.max[axis], right.min[axis], right.max[axis])) {
      return 0.0F;
    }
  }
  const Bounds shared{glm::max(left.min, right.min), glm::min(left.max, right.max)};
  return static_cast<float>(shared.area() / area);
}

StructureProfile profile_of(const NodeTable& table) {
  StructureProfile profile;
  if (table.empty()) return profile;
  profile.depths.resize(table.max_depth() + 1);
  for (const NodeRecord& node : table.records()) {
    DepthProfile& depth = profile.depths[node.depth];
    depth.area_share += node.bounds.area();
    if (!node.leaf) {
      ++depth.inner;
      continue;
    }
    ++depth.leaves;
    depth.empty_leaves += node.triangles == 0 ? 1 : 0;
    depth.references += node.triangles;
    depth.largest_leaf = std::max<std::uint64_t>(depth.largest_leaf, node.triangles);
    // 0 -> 0, 1 -> 1, 2 -> 2, 3..4 -> 3, 5..8 -> 4
    const std::size_t size_class =
        node.triangles == 0 ? 0 : 1 + static_cast<std::size_t>(std::bit_width(node.triangles - 1));
    if (profile.leaf_sizes.size() <= size_class) profile.leaf_sizes.resize(size_class + 1);
    ++profile.leaf_sizes[size_class];
  }
  const double whole = table.bounds().area();
  for (DepthProfile& depth : profile.depths) {
    depth.area_share =
        whole > 0.0 ? depth.area_share / whole : std::numeric_limits<double>::quiet_NaN();
  }
  return profile;
}

std::array<std::uint64_t, 2> leaf_size_range(std::size_t i) {
  if (i < 2) return {i, i};
  return {(std::uint64_t{1} << (i - 2)) + 1, std::uint64_t{1} << (i - 1)};
}

}  // namespace encore::accel
