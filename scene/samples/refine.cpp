#include "scene/samples/refine.h"

#include "scene/load_watch.h"
#include "scene/samples/mesh_tools.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace encore::scene::samples {

namespace {

/// Squared lengths, so that the order of splitting depends on nothing but the positions.
std::vector<double> squared_lengths(const Mesh& mesh, const std::vector<Edge>& edges) {
  std::vector<double> lengths;
  lengths.reserve(edges.size());
  for (const Edge& e : edges) {
    const Vec d = widen(mesh.positions[e.a]) - widen(mesh.positions[e.b]);
    lengths.push_back(dot(d, d));
  }
  return lengths;
}

/// Cuts `triangle` in two at the middle `m` of its edge between a and b.
void cut(Mesh& mesh, std::uint32_t triangle, const Edge& edge, std::uint32_t m) {
  glm::uvec3 first = mesh.triangles[triangle];
  glm::uvec3 second = first;
  for (int k = 0; k < 3; ++k) {
    if (first[k] == edge.a) first[k] = m;
    if (second[k] == edge.b) second[k] = m;
  }
  mesh.triangles[triangle] = first;
  mesh.triangles.push_back(second);
  if (!mesh.material_of.empty()) mesh.material_of.push_back(mesh.material_of[triangle]);
}

/// Splits up to `missing / 2` inner edges (boundary edges if `boundary`, up to `missing`), longest
/// first, no two at the same triangle. Returns the number of triangles added.
std::size_t split_pass(Mesh& mesh, std::size_t missing, bool boundary) {
  check_load();
  const EdgeTable table = find_edges(mesh);
  check_load();
  const std::vector<double> lengths = squared_lengths(mesh, table.edges);
  std::vector<std::uint32_t> order(table.edges.size());
  std::iota(order.begin(), order.end(), 0U);
  std::size_t comparisons = 0;
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    if (++comparisons % (1U << 17U) == 0) check_load();
    return lengths[i] != lengths[j] ? lengths[i] > lengths[j] : i < j;
  });
  check_load();
  std::vector<char> touched(mesh.triangles.size(), 0);
  std::size_t added = 0;
  const std::size_t step = boundary ? 1 : 2;
  for (const std::uint32_t id : order) {
    if (added + step > missing) break;
    const Edge& e = table.edges[id];
    const bool open = e.triangle[1] == kNoTriangle;
    if (open != boundary || touched[e.triangle[0]] != 0) continue;
    if (!open && touched[e.triangle[1]] != 0) continue;
    const auto m = std::uint32_t(mesh.positions.size());
    mesh.positions.push_back(
        narrow((widen(mesh.positions[e.a]) + widen(mesh.positions[e.b])) * 0.5));
    for (std::size_t side = 0; side < step; ++side) {
      touched[e.triangle[side]] = 1;
      cut(mesh, e.triangle[side], e, m);
    }
    added += step;
  }
  return added;
}

}  // namespace

EdgeTable find_edges(const Mesh& mesh) {
  EdgeTable table;
  table.of_triangle.resize(mesh.triangles.size());
  // Bucket sizes: how many half-edges have each vertex as their lower end.
  std::vector<std::uint32_t> start(mesh.positions.size() + 1, 0);
  const auto each_half_edge = [&](auto&& visit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const glm::uvec3& c = mesh.triangles[t];
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t from = c[k];
        const std::uint32_t to = c[(k + 1) % 3];
        visit(t, k, std::min(from, to), std::max(from, to));
      }
    }
  };
  each_half_edge([&](auto, auto, auto a, auto) { ++start[a + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  // Each bucket then collects the edges that start at its vertex; a bucket is as short as a
  // vertex' fan, so looking an edge up in it is cheap.
  std::vector<std::uint32_t> bucket(start.back());
  std::vector<std::uint32_t> filled(mesh.positions.size(), 0);
  table.edges.reserve(start.back() / 2 + 16);
  each_half_edge([&](std::uint32_t t, int k, std::uint32_t a, std::uint32_t b) {
    for (std::uint32_t i = start[a]; i < start[a] + filled[a]; ++i) {
      if (table.edges[bucket[i]].b != b) continue;
      table.edges[bucket[i]].triangle[1] = t;
      table.of_triangle[t][k] = bucket[i];
      return;
    }
    const auto id = std::uint32_t(table.edges.size());
    bucket[start[a] + filled[a]++] = id;
    table.of_triangle[t][k] = id;
    table.edges.push_back({a, b, {t, kNoTriangle}});
  });
  return table;
}

void split_to(Mesh& mesh, std::size_t target) {
  if (mesh.triangles.size() > target) {
    throw std::logic_error("sample scene: a mesh has " + std::to_string(mesh.triangles.size()) +
                           " triangles, more than its " + std::to_string(target));
  }
  mesh.normals.clear();
  mesh.colors.clear();
  // An odd remainder is made even first, at the boundary.
  if ((target - mesh.triangles.size()) % 2 != 0 && split_pass(mesh, 1, true) != 1) {
    throw std::logic_error("sample scene: a closed mesh cannot gain an odd number of triangles");
  }
  while (mesh.triangles.size() < target) {
    if (split_pass(mesh, target - mesh.triangles.size(), false) == 0) {
      throw std::logic_error("sample scene: no edge left to split");
    }
  }
}

Mesh subdivide(const Mesh& mesh) {
  const EdgeTable table = find_edges(mesh);
  const auto old_count = std::uint32_t(mesh.positions.size());
  // Sums over each vertex' neighbours: all of them inside, only those along an open boundary.
  std::vector<Vec> sum(old_count, Vec(0.0));
  std::vector<Vec> rim_sum(old_count, Vec(0.0));
  std::vector<std::uint32_t> valence(old_count, 0);
  std::vector<std::uint32_t> rim_valence(old_count, 0);
  for (const Edge& e : table.edges) {
    const Vec a = widen(mesh.positions[e.a]);
    const Vec b = widen(mesh.positions[e.b]);
    sum[e.a] += b;
    sum[e.b] += a;
    ++valence[e.a];
    ++valence[e.b];
    if (e.triangle[1] != kNoTriangle) continue;
    rim_sum[e.a] += b;
    rim_sum[e.b] += a;
    ++rim_valence[e.a];
    ++rim_valence[e.b];
  }
  Mesh finer;
  finer.positions.reserve(old_count + table.edges.size());
  for (std::uint32_t v = 0; v < old_count; ++v) {
    const Vec p = widen(mesh.positions[v]);
    const double n = valence[v];
    const double weight = n == 3.0 ? 3.0 / 16.0 : 3.0 / (8.0 * std::max(n, 1.0));
    Vec q = p * (1.0 - n * weight) + sum[v] * weight;
    // Where two boundaries touch at a vertex there is no single curve: it stays where it is.
    if (rim_valence[v] > 0) q = rim_valence[v] == 2 ? p * 0.75 + rim_sum[v] * 0.125 : p;
    finer.positions.push_back(narrow(q));
  }
  // One new vertex an edge: 3/8 of its ends and 1/8 of the two corners that face it.
  for (const Edge& e : table.edges) {
    const Vec ends = widen(mesh.positions[e.a]) + widen(mesh.positions[e.b]);
    Vec p = ends * 0.5;
    if (e.triangle[1] != kNoTriangle) {
      Vec facing(0.0);
      for (const std::uint32_t t : e.triangle) {
        const glm::uvec3& c = mesh.triangles[t];
        const std::uint32_t opposite = c.x != e.a && c.x != e.b   ? c.x
                                       : c.y != e.a && c.y != e.b ? c.y
                                                                  : c.z;
        facing += widen(mesh.positions[opposite]);
      }
      p = ends * 0.375 + facing * 0.125;
    }
    finer.positions.push_back(narrow(p));
  }
  finer.triangles.reserve(4 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& c = mesh.triangles[t];
    const glm::uvec3 m = table.of_triangle[t] + old_count;
    finer.triangles.emplace_back(c.x, m.x, m.z);
    finer.triangles.emplace_back(c.y, m.y, m.x);
    finer.triangles.emplace_back(c.z, m.z, m.y);
    finer.triangles.emplace_back(m.x, m.y, m.z);
    if (!mesh.material_of.empty()) finer.material_of.resize(4 * t + 4, mesh.material_of[t]);
  }
  return finer;
}

}  // namespace encore::scene::samples
