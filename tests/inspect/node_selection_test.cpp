// What is drawn is what looking at every node by itself chooses: frustum, size, depth, section,
// budget; and a click finds the node that it means.
#include "accel/inspect/node_selection.h"

#include "built.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace encore::accel::test {
namespace {

using glm::dvec3;

/// A view of the scene's box from one of several sides; some from inside it.
NodeView3d view_of(const NodeTable& table, std::uint32_t seed) {
  Random random(seed);
  const dvec3 center(table.bounds().center());
  const double size = std::max(1e-30, glm::length(dvec3(table.bounds().size())));
  const dvec3 eye = center + dvec3(random.point(1.0F)) * size * (seed % 3 == 0 ? 0.2 : 1.0);
  const dvec3 target = center + dvec3(random.point(0.2F)) * size;
  const dvec3 forward = glm::normalize(target - eye);
  const dvec3 right = glm::normalize(glm::cross(forward, dvec3(0.1, 1, 0.2)));
  const dvec3 up = glm::cross(right, forward);
  if (seed % 2 == 0) return orthographic_view(eye, forward, up, size * 0.5, 640, 480);
  return perspective_view(eye, forward, up, 40.0, 640, 480);
}

/// Whether a box is outside one of the half-spaces with all its corners, corner by corner.
bool all_corners_outside(const HalfSpace& plane, const Bounds& box) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    const dvec3 p((corner & 1U) != 0 ? box.max.x : box.min.x,
                  (corner & 2U) != 0 ? box.max.y : box.min.y,
                  (corner & 4U) != 0 ? box.max.z : box.min.z);
    double value = plane.offset;
    for (int a = 0; a < 3; ++a) value += plane.normal[a] * p[a];
    if (value >= 0) return false;
  }
  return true;
}

bool seen(const NodeView3d& view, const Bounds& box) {
  return std::ranges::none_of(
      view.planes, [&](const HalfSpace& plane) { return all_corners_outside(plane, box); });
}

/// Every node by itself, then sorted and cut.
std::vector<std::uint32_t> by_brute_force(const NodeTable& table, const NodeQuery& query) {
  const bool part = query.filter.subtree != kNoNode;
  const std::uint32_t first = part ? query.filter.subtree : 0;
  const std::uint32_t end = part ? table[first].subtree_end : table.size();
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t i = first; i < end; ++i) {
    const Bounds& box = table[i].bounds;
    if (query.filter.passes(table[i]) && seen(query.view, box) &&
        size_in_pixels(query.view, box) >= query.smallest_pixels) {
      nodes.push_back(i);
    }
  }
  std::ranges::sort(nodes, [&](std::uint32_t a, std::uint32_t b) {
    const float size_a = size_in_pixels(query.view, table[a].bounds);
    const float size_b = size_in_pixels(query.view, table[b].bounds);
    if (size_a != size_b) return size_a > size_b;
    const float far_a = view_distance(query.view, table[a].bounds);
    const float far_b = view_distance(query.view, table[b].bounds);
    return far_a != far_b ? far_a < far_b : a < b;
  });
  if (nodes.size() > query.budget) nodes.resize(query.budget);
  std::ranges::sort(nodes);
  return nodes;
}

void expect_brute_force(const NodeTable& table, const NodeQuery& query) {
  const NodeSelection selection = select_nodes(table, query);
  EXPECT_EQ(selection.nodes, by_brute_force(table, query));
  EXPECT_EQ(selection.total, table.size());
  EXPECT_EQ(selection.nodes.size() + selection.filtered + selection.outside + selection.too_small +
                selection.over_budget,
            table.size());
}

std::vector<NodeFilter> filters_for(const NodeTable& table) {
  std::vector<NodeFilter> filters(9);
  filters[1].leaves = false;
  filters[2].inner = false;
  filters[3].first_depth = 3;
  filters[3].last_depth = 7;
  filters[4].empty_leaves = true;
  filters[5].min_triangles = 4;
  filters[6].split_axes = {true, false, false};
  const HalfSpace middle{{0.6, 0, 0.8},
                         -glm::dot(dvec3(0.6, 0, 0.8), dvec3(table.bounds().center()))};
  filters[7].section = NodeSection{middle, NodeSection::Keep::inside};
  filters[8].section = NodeSection{middle, NodeSection::Keep::touching};
  if (table.size() > 10) {
    filters.emplace_back();
    filters.back().subtree = table.size() / 3;
  }
  return filters;
}

TEST(NodeSelection, IsThatOfBruteForce) {
  const std::vector<NamedTriangles> scenes{{"toys", sample("toys")},
                                           {"soup", soup(500, 1.0F, 1)},
                                           {"floor", floor_tiles(12)},
                                           {"huge", scaled(soup(200, 1.0F, 10), 0x1p57F)},
                                           {"tiny", scaled(soup(200, 1.0F, 11), 0x1p-63F)},
                                           {"points", scaled(soup(50, 1.0F, 9), 0.0F)},
                                           {"one", soup(1, 1.0F, 2)},
                                           {"nothing", {}}};
  for_all_structures(scenes, [](const Built& built) {
    std::uint32_t seed = 1;
    for (const NodeFilter& filter : filters_for(built.table)) {
      for (const float pixels : {0.0F, 1.5F, 30.0F}) {
        for (const std::uint32_t budget : {0U, 7U, 200U, 1'000'000U}) {
          NodeQuery query;
          query.filter = filter;
          query.view = view_of(built.table, ++seed);
          query.smallest_pixels = pixels;
          query.budget = budget;
          expect_brute_force(built.table, query);
        }
      }
    }
  });
}

TEST(NodeSelection, RaisesTheSmallestSizeToMeetTheBudget) {
  const Built built(StructureKind::bvh_median, sample("toys"));
  NodeQuery query;
  query.view = view_of(built.table, 1);
  query.smallest_pixels = 0.5F;
  query.budget = 500;
  const NodeSelection cut = select_nodes(built.table, query);
  EXPECT_EQ(cut.nodes.size(), 500U);
  EXPECT_GT(cut.smallest_pixels, 0.5F);
  EXPECT_GT(cut.over_budget, 0U);
  float smallest = std::numeric_limits<float>::infinity();
  for (const std::uint32_t node : cut.nodes) {
    smallest = std::min(smallest, size_in_pixels(query.view, built.table[node].bounds));
  }
  EXPECT_EQ(smallest, cut.smallest_pixels);
  query.budget = 1'000'000;
  const NodeSelection all = select_nodes(built.table, query);
  EXPECT_EQ(all.smallest_pixels, 0.5F);
  EXPECT_EQ(all.over_budget, 0U);
  EXPECT_GT(all.nodes.size(), 500U);
}

TEST(NodeSelection, ComesInTheOrderAskedFor) {
  const Built built(StructureKind::kd_sah, sample("toys"));
  const NodeTable& table = built.table;
  NodeQuery query;
  query.view = view_of(table, 5);
  const auto sorted = [&](NodeOrder order, auto key) {
    query.order = order;
    const auto nodes = select_nodes(table, query).nodes;
    EXPECT_GT(nodes.size(), 100U);
    return std::ranges::is_sorted(nodes, {}, key);
  };
  const auto distance = [&](std::uint32_t n) { return view_distance(query.view, table[n].bounds); };
  const auto size = [&](std::uint32_t n) { return size_in_pixels(query.view, table[n].bounds); };
  EXPECT_TRUE(sorted(NodeOrder::table, [](std::uint32_t n) { return n; }));
  EXPECT_TRUE(sorted(NodeOrder::largest_first, [&](std::uint32_t n) { return -size(n); }));
  EXPECT_TRUE(sorted(NodeOrder::nearest_first, distance));
  EXPECT_TRUE(sorted(NodeOrder::farthest_first, [&](std::uint32_t n) { return -distance(n); }));
  EXPECT_TRUE(sorted(NodeOrder::depth, [&](std::uint32_t n) { return table[n].depth; }));
}

TEST(NodeViews, MeasureInPixels) {
  const NodeView3d view = perspective_view({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 90.0, 200, 100);
  // At the distance 10 the image is 20 units high: 5 pixels a unit.
  const Bounds box{{-1, -1, -10}, {1, 1, -10}};
  EXPECT_NEAR(size_in_pixels(view, box), 5 * std::sqrt(8.0), 1e-4);
  EXPECT_EQ(view_distance(view, box), 10.0F);
  EXPECT_TRUE(std::isinf(size_in_pixels(view, {{-1, -1, -1}, {1, 1, 1}})));
  EXPECT_TRUE(seen(view, {{-1, -1, -10}, {1, 1, -9}}));
  EXPECT_FALSE(seen(view, {{-1, -1, 9}, {1, 1, 10}})) << "behind the eye";
  EXPECT_FALSE(seen(view, {{-1, 11, -10}, {1, 12, -9.9F}})) << "above";
  EXPECT_TRUE(seen(view, {{19, 0, -10}, {19.5F, 1, -9.9F}})) << "twice as wide as high";
  EXPECT_FALSE(seen(view, {{21, 0, -10}, {22, 1, -9.9F}})) << "to the right";
  const NodeView3d flat = orthographic_view({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 20.0, 200, 100);
  EXPECT_NEAR(size_in_pixels(flat, box), 5 * std::sqrt(8.0), 1e-4);
  EXPECT_EQ(view_distance(flat, box), 10.0F);
  EXPECT_FALSE(seen(flat, {{-1, 11, -10}, {1, 12, -9.9F}}));
  EXPECT_TRUE(seen(flat, {{19, 0, -1000}, {19.5F, 1, -999}}));
  EXPECT_FALSE(seen(flat, {{21, 0, -10}, {22, 1, -9}}));
  EXPECT_FALSE(seen(flat, {{-22, 0, -10}, {-21, 1, -9}}));
  EXPECT_FALSE(seen(flat, {{-1, -12, -10}, {1, -11, -9}}));
  EXPECT_FALSE(seen(view, {{-22, 0, -10}, {-21, 1, -9.9F}}));
}

TEST(NodePicking, ChoosesTheInnermostThenTheNearest) {
  // Two boxes behind each other along -z, of one triangle each.
  const Built built(StructureKind::bvh_median,
                    {make_triangle({-1, -1, 0}, {1, -1, 1}, {0, 1, 0}),
                     make_triangle({-1, -1, -9}, {1, -1, -8}, {0, 1, -9})});
  const NodeTable& table = built.table;
  ASSERT_EQ(table.size(), 3U);
  const Ray down{{0, 0, 20}, 0.0F, {0, 0, -1}};
  const std::uint32_t front = table[1].bounds.max.z > table[2].bounds.max.z ? 1 : 2;
  EXPECT_EQ(pick_node(table, NodeFilter{}, down), front);
  const std::vector<std::uint32_t> root_and_back{3 - front, 0};
  EXPECT_EQ(pick_node(table, root_and_back, down), 3 - front) << "the front one is not drawn";
  NodeFilter only_root;
  only_root.last_depth = 0;
  EXPECT_EQ(pick_node(table, only_root, down), 0U);
  const Ray between{{0, 0, -4}, 0.0F, {0, 0, -1}};
  EXPECT_EQ(pick_node(table, NodeFilter{}, between), 3 - front);
  const Ray inside{{0, 0, 0.5F}, 0.0F, {0, 0, 1}};
  EXPECT_EQ(pick_node(table, NodeFilter{}, inside), front) << "nothing but what is around the eye";
  const Ray inside_down{{0, 0, 0.5F}, 0.0F, {0, 0, -1}};
  EXPECT_EQ(pick_node(table, NodeFilter{}, inside_down), 3 - front);
  const Ray beside{{5, 0, 20}, 0.0F, {0, 0, -1}};
  EXPECT_EQ(pick_node(table, NodeFilter{}, beside), kNoNode);
  EXPECT_EQ(pick_node(NodeTable(), NodeFilter{}, down), kNoNode);
}

TEST(NodePicking, IsTheSameFromAListOfAllNodes) {
  for_all_structures({{"toys", sample("toys")}, {"nothing", {}}}, [](const Built& built) {
    const NodeTable& table = built.table;
    NodeFilter filter;
    filter.last_depth = 9;
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = table.size(); i-- > 0;) {
      if (filter.passes(table[i])) all.push_back(i);
    }
    Random random(5);
    const glm::vec3 center = table.empty() ? glm::vec3(0.0F) : table.bounds().center();
    std::size_t found = 0;
    for (int i = 0; i < 200; ++i) {
      const glm::vec3 origin = center + random.point(30.0F);
      const Ray ray{origin, 0.0F, center + random.point(5.0F) - origin};
      const std::uint32_t picked = pick_node(table, filter, ray);
      EXPECT_EQ(picked, pick_node(table, all, ray));
      found += picked != kNoNode ? 1 : 0;
    }
    EXPECT_TRUE(table.size() < 2 || found > 20) << found;
  });
}

TEST(ClippedPlane, LiesInTheBoxAndOnTheSplit) {
  const Built built(StructureKind::kd_sah, sample("toys"));
  std::size_t planes = 0;
  for (const NodeRecord& node : built.table.records()) {
    const auto corners = clipped_plane(node);
    ASSERT_EQ(corners.has_value(), !node.leaf);
    if (!corners) continue;
    ++planes;
    Bounds box;
    for (const glm::vec3& corner : *corners) {
      EXPECT_EQ(corner[node.split_axis], node.split_position);
      box.extend(corner);
    }
    Bounds expected = node.bounds;
    expected.min[node.split_axis] = expected.max[node.split_axis] = node.split_position;
    EXPECT_EQ(box, expected);
    // Around, not across: neighbours differ along one axis only.
    for (std::size_t i = 0; i < 4; ++i) {
      const glm::vec3 side = (*corners)[(i + 1) % 4] - (*corners)[i];
      EXPECT_LE((side.x != 0) + (side.y != 0) + (side.z != 0), 1);
    }
  }
  EXPECT_GT(planes, 100U);
  EXPECT_FALSE(clipped_plane(Built(StructureKind::bvh_median, soup(9, 1, 1)).table[0]));
}

}  // namespace
}  // namespace encore::accel::test
