#include "accel/inspect/node_selection.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace encore::accel {

namespace {

/// The largest value of dot(normal, p) + offset over a box.
double farthest_inside(const HalfSpace& plane, const Bounds& box) {
  double value = plane.offset;
  for (int a = 0; a < 3; ++a) {
    if (plane.normal[a] == 0.0) continue;
    value += plane.normal[a] * double{plane.normal[a] > 0.0 ? box.max[a] : box.min[a]};
  }
  return value;
}

bool section_keeps(const NodeSection& section, const Bounds& box) {
  if (farthest_inside(section.plane, box) < 0.0) return false;
  if (section.keep == NodeSection::Keep::inside) return true;
  return farthest_inside({-section.plane.normal, -section.plane.offset}, box) >= 0.0;
}

bool in_view(const NodeView3d& view, const Bounds& box) {
  return std::all_of(view.planes.begin(), view.planes.end(),
                     [&box](const HalfSpace& plane) { return farthest_inside(plane, box) >= 0.0; });
}

/// Whether no node below can pass either.
bool cuts_off(const NodeFilter& filter, const NodeRecord& node) {
  return node.depth > filter.last_depth || node.triangles < filter.min_triangles ||
         (filter.section && !section_keeps(*filter.section, node.bounds));
}

struct Candidate {
  std::uint32_t node;
  float pixels;
  float distance;
};

/// The order in which the budget takes them.
bool comes_first(const Candidate& a, const Candidate& b) {
  if (a.pixels != b.pixels) return a.pixels > b.pixels;
  if (a.distance != b.distance) return a.distance < b.distance;
  return a.node < b.node;
}

/// Goes through the nodes and keeps the best of them.
class Selector {
 public:
  Selector(const NodeTable& table, const NodeQuery& query) : table_(table), query_(query) {}

  /// Where the budget is a small part of a tree, the size that it will come down to is guessed, so
  /// that most of the tree need not be touched: from how many nodes look at least kLargePixels
  /// large, as their number grows about with the square. A guess that proves too high costs time
  /// only.
  NodeSelection run() {
    const float asked = query_.smallest_pixels;
    if (table_.kind() == NodeKind::cells || query_.budget >= table_.size() / 8) {
      look_at_all(asked);
    } else if (!look_at_all(std::max(asked, kLargePixels)) && asked < kLargePixels) {
      const auto large = static_cast<float>(candidates_.size());
      const float guess =
          kLargePixels * std::sqrt(large / (1.5F * static_cast<float>(query_.budget)));
      if (large < kFewest || !(guess > asked) || !look_at_all(guess)) look_at_all(asked);
    }
    finish();
    return std::move(result_);
  }

 private:
  static constexpr float kLargePixels = 64.0F;
  static constexpr float kFewest = 32.0F;

  /// One round over all nodes that look this large; true if the budget was met.
  bool look_at_all(float pixels) {
    const NodeFilter& filter = query_.filter;
    const bool all = filter.subtree == kNoNode || filter.subtree >= table_.size();
    const std::uint32_t first = all ? 0 : filter.subtree;
    const std::uint32_t end = all ? table_.size() : table_[first].subtree_end;
    candidates_.clear();
    result_ = {};
    result_.smallest_pixels = pixels;
    result_.total = table_.size();
    result_.filtered = table_.size() - (end - first);
    exceeded_ = false;
    for (std::uint32_t i = first; i < end;) i = consider(i);
    if (candidates_.size() > query_.budget) keep_best();
    return exceeded_;
  }

  /// Judges node i; returns the node to go on with.
  std::uint32_t consider(std::uint32_t i) {
    const NodeRecord& node = table_[i];
    const std::uint32_t below = node.subtree_end - i;
    if (cuts_off(query_.filter, node)) {
      result_.filtered += below;
      return node.subtree_end;
    }
    const float pixels = size_in_pixels(query_.view, node.bounds);
    if (!(pixels >= query_.smallest_pixels)) {
      result_.too_small += below;
      return node.subtree_end;
    }
    if (!in_view(query_.view, node.bounds)) {
      result_.outside += below;
      return node.subtree_end;
    }
    if (pixels < result_.smallest_pixels) {
      result_.over_budget += below;
      return node.subtree_end;
    }
    if (!query_.filter.passes(node)) {
      ++result_.filtered;
      return i + 1;
    }
    candidates_.push_back({i, pixels, view_distance(query_.view, node.bounds)});
    // Choosing again and again among twice the budget costs the same a node, whatever the budget,
    // and from the first time on cuts off what is too small for it.
    if (candidates_.size() >= 2 * std::size_t{query_.budget} + 1024) keep_best();
    return i + 1;
  }

  void keep_best() {
    exceeded_ = true;
    result_.over_budget += static_cast<std::uint32_t>(candidates_.size() - query_.budget);
    if (query_.budget == 0) {
      candidates_.clear();
      return;
    }
    const auto last = candidates_.begin() + (query_.budget - 1);
    std::nth_element(candidates_.begin(), last, candidates_.end(), comes_first);
    result_.smallest_pixels = last->pixels;
    candidates_.resize(query_.budget);
  }

  void finish() {
    const auto before = [this](const Candidate& a, const Candidate& b) {
      switch (query_.order) {
        case NodeOrder::largest_first:
          return comes_first(a, b);
        case NodeOrder::nearest_first:
          if (a.distance != b.distance) return a.distance < b.distance;
          break;
        case NodeOrder::farthest_first:
          if (a.distance != b.distance) return a.distance > b.distance;
          break;
        case NodeOrder::depth:
          if (table_[a.node].depth != table_[b.node].depth) {
            return table_[a.node].depth < table_[b.node].depth;
          }
          break;
        case NodeOrder::table:
          break;
      }
      return a.node < b.node;
    };
    std::sort(candidates_.begin(), candidates_.end(), before);
    result_.nodes.reserve(candidates_.size());
    for (const Candidate& candidate : candidates_) result_.nodes.push_back(candidate.node);
  }

  const NodeTable& table_;
  const NodeQuery& query_;
  std::vector<Candidate> candidates_;
  NodeSelection result_;
  bool exceeded_ = false;
};

}  // namespace

bool NodeFilter::passes(const NodeRecord& node) const {
  if (node.depth < first_depth || node.depth > last_depth) return false;
  if (node.leaf ? !leaves : !inner) return false;
  if (node.empty_leaf() && !empty_leaves) return false;
  if (node.triangles < min_triangles) return false;
  if (node.split_axis >= 0 && !split_axes[static_cast<std::size_t>(node.split_axis)]) return false;
  return !section || section_keeps(*section, node.bounds);
}

NodeSelection select_nodes(const NodeTable& table, const NodeQuery& query) {
  return Selector(table, query).run();
}

std::optional<std::array<glm::vec3, 4>> clipped_plane(const NodeRecord& node) {
  if (node.split_axis < 0) return std::nullopt;
  const int a = node.split_axis;
  const int b = (a + 1) % 3;
  const int c = (a + 2) % 3;
  std::array<glm::vec3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i][a] = node.split_position;
    corners[i][b] = (i == 1 || i == 2) ? node.bounds.max[b] : node.bounds.min[b];
    corners[i][c] = i >= 2 ? node.bounds.max[c] : node.bounds.min[c];
  }
  return corners;
}

}  // namespace encore::accel
