#pragma once

#include "accel/inspect/node_table.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace encore::accel {

/// The half-space dot(normal, p) + offset >= 0.
struct HalfSpace {
  glm::dvec3 normal{0.0};
  double offset = 0.0;
};

/// What a camera sees and how large things look. The image's four edges and what lies behind the
/// eye bound it; there is no far plane.
struct NodeView3d {
  std::array<HalfSpace, 5> planes{};  ///< a plane without a normal bounds nothing
  glm::dvec3 eye{0.0};
  glm::dvec3 forward{0.0, 0.0, -1.0};  ///< unit length
  /// Pixels that one unit covers: at the distance 1 of a perspective view, anywhere in an
  /// orthographic one.
  double pixels_per_unit = 1.0;
  bool orthographic = false;
};

/// Views of width x height pixels, square ones. `forward` and `up` are unit vectors at right angles
/// to each other. The field of view, or the height in scene units, is the vertical one.
NodeView3d perspective_view(const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up,
                            double vertical_fov_degrees, int width, int height);
NodeView3d orthographic_view(const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up,
                             double units_high, int width, int height);

/// Distance from the eye to the nearest point of a box; orthographic: along the view, 0 at least.
float view_distance(const NodeView3d& view, const Bounds& box);
/// How many pixels a box's diagonal would cover at the box's nearest point; infinite if the eye is
/// inside. Never less than that of a box inside it.
float size_in_pixels(const NodeView3d& view, const Bounds& box);

/// Cuts the structure open: which nodes a section plane leaves.
struct NodeSection {
  enum class Keep : std::uint8_t {
    touching,  ///< nodes that the plane goes through
    inside,    ///< those and the ones on the side that the half-space holds
  };
  HalfSpace plane;
  Keep keep = Keep::inside;
};

/// Which nodes the user wants to see at all.
struct NodeFilter {
  std::uint32_t first_depth = 0;
  std::uint32_t last_depth = 0xFFFFU;
  bool leaves = true;
  bool inner = true;
  bool empty_leaves = false;
  std::uint32_t min_triangles = 0;  ///< references of the node or of the leaves below it
  std::array<bool, 3> split_axes{true, true, true};  ///< kd inner nodes that split this axis
  std::optional<NodeSection> section;
  std::uint32_t subtree = kNoNode;  ///< only this node and those below; kNoNode: all

  /// Whether one node passes, wherever the camera is.
  [[nodiscard]] bool passes(const NodeRecord& node) const;
};

enum class NodeOrder : std::uint8_t {
  table,          ///< depth-first, parents before children
  largest_first,  ///< in pixels
  nearest_first,
  farthest_first,  ///< for blending
  depth            ///< level by level
};

struct NodeQuery {
  NodeFilter filter;
  NodeView3d view;
  float smallest_pixels = 1.5F;  ///< nodes that look smaller are left out, and all below them
  std::uint32_t budget = 30'000;
  NodeOrder order = NodeOrder::table;
};

struct NodeSelection {
  std::vector<std::uint32_t> nodes;
  /// Every node of the table falls under one of these; what is left out with its parent counts as
  /// its parent does. nodes.size() and these together give `total`.
  std::uint32_t total = 0;
  std::uint32_t filtered = 0;     ///< by the filter
  std::uint32_t outside = 0;      ///< not in view
  std::uint32_t too_small = 0;    ///< smaller than the query asked for
  std::uint32_t over_budget = 0;  ///< smaller than `smallest_pixels`
  /// The size down to which nodes are shown: the query's, or more if the budget asked for it. Of
  /// nodes of exactly this size the nearest ones are shown.
  float smallest_pixels = 0.0F;
};

/// Chooses the nodes to draw. Trees are cut off where a node is out of view or too small, as all
/// below it then are too; a grid's cells are looked at one by one. If more remain than the budget
/// allows, the largest (then the nearest, then the first) are taken.
NodeSelection select_nodes(const NodeTable& table, const NodeQuery& query);

/// The node that a click means, of the nodes drawn (ascending or not): one that the ray enters and
/// that has no further such node below it; of these the nearest. Nodes around the ray's origin come
/// last, the innermost first. kNoNode if the ray enters none.
std::uint32_t pick_node(const NodeTable& table, std::span<const std::uint32_t> drawn,
                        const Ray& ray);
/// The same of all nodes that pass the filter, however small.
std::uint32_t pick_node(const NodeTable& table, const NodeFilter& filter, const Ray& ray);

/// The part of a kd-tree node's split plane that lies in its box: four corners in order around it;
/// nothing for other nodes.
std::optional<std::array<glm::vec3, 4>> clipped_plane(const NodeRecord& node);

}  // namespace encore::accel
