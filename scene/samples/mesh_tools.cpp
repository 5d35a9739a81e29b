#include "scene/samples/mesh_tools.h"

#include <algorithm>
#include <utility>

namespace encore::scene::samples {

Bounds bounds_of(const Mesh& mesh) {
  Bounds box;
  for (const glm::vec3& p : mesh.positions) box.extend(p);
  return box;
}

void append(Mesh& mesh, const Mesh& part, std::uint32_t material) {
  const auto first = std::uint32_t(mesh.positions.size());
  const std::size_t total = mesh.positions.size() + part.positions.size();
  // The optional lists are extended only if either side has them.
  if (!mesh.normals.empty() || !part.normals.empty()) {
    mesh.normals.resize(first, glm::vec3(0.0F));
    mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
    mesh.normals.resize(total, glm::vec3(0.0F));
  }
  if (!mesh.colors.empty() || !part.colors.empty()) {
    mesh.colors.resize(first, glm::vec3(1.0F));
    mesh.colors.insert(mesh.colors.end(), part.colors.begin(), part.colors.end());
    mesh.colors.resize(total, glm::vec3(1.0F));
  }
  mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
  mesh.material_of.resize(mesh.triangles.size(), 0);
  for (const glm::uvec3& t : part.triangles) mesh.triangles.push_back(t + first);
  mesh.material_of.resize(mesh.triangles.size(), material);
}

Mesh moved(Mesh mesh, const Frame& frame, double scale) {
  for (glm::vec3& p : mesh.positions) p = narrow(frame.world(widen(p) * scale));
  for (glm::vec3& n : mesh.normals) n = narrow(frame.world(widen(n)) - frame.origin);
  return mesh;
}

Mesh stretched(Mesh mesh, const Vec& factors) {
  for (glm::vec3& p : mesh.positions) p = narrow(widen(p) * factors);
  return mesh;
}

void cut_below(Mesh& mesh, double height) {
  const auto floor = float(height);
  // What lies below is flattened onto the floor; triangles that lie all in it make the hole.
  std::vector<glm::uvec3> kept;
  for (const glm::uvec3& t : mesh.triangles) {
    if (mesh.positions[t.x].y > floor || mesh.positions[t.y].y > floor ||
        mesh.positions[t.z].y > floor) {
      kept.push_back(t);
    }
  }
  // Only vertices still in use stay, in the order of their first use.
  constexpr std::uint32_t kUnused = 0xFFFFFFFFU;
  std::vector<std::uint32_t> renamed(mesh.positions.size(), kUnused);
  std::vector<glm::vec3> positions;
  for (glm::uvec3& t : kept) {
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& name = renamed[t[k]];
      if (name == kUnused) {
        name = std::uint32_t(positions.size());
        positions.push_back(mesh.positions[t[k]]);
        positions.back().y = std::max(positions.back().y, floor);
      }
      t[k] = name;
    }
  }
  mesh = Mesh{};
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(kept);
}

void fit(Mesh& mesh, double longest) {
  const Bounds box = bounds_of(mesh);
  const Vec low = widen(box.min);
  const Vec size = widen(box.max) - low;
  const Vec center = low + size * 0.5;
  const double scale = longest / std::max(size.x, std::max(size.y, size.z));
  for (glm::vec3& p : mesh.positions) p = narrow((widen(p) - center) * scale);
}

void smooth_normals(Mesh& mesh) {
  std::vector<Vec> sums(mesh.positions.size(), Vec(0.0));
  for (const glm::uvec3& t : mesh.triangles) {
    const Vec a = widen(mesh.positions[t.x]);
    // The cross product's length is twice the area, which is the weight wanted.
    const Vec n = cross(widen(mesh.positions[t.y]) - a, widen(mesh.positions[t.z]) - a);
    sums[t.x] += n;
    sums[t.y] += n;
    sums[t.z] += n;
  }
  mesh.normals.resize(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) mesh.normals[i] = narrow(normalize(sums[i]));
}

Mesh smooth(Mesh mesh) {
  smooth_normals(mesh);
  return mesh;
}

Mesh flat_shaded(const Mesh& mesh) {
  Mesh flat;
  flat.material_of = mesh.material_of;
  for (const glm::uvec3& t : mesh.triangles) {
    const auto first = std::uint32_t(flat.positions.size());
    for (int corner = 0; corner < 3; ++corner) {
      flat.positions.push_back(mesh.positions[t[corner]]);
      if (!mesh.colors.empty()) flat.colors.push_back(mesh.colors[t[corner]]);
    }
    flat.triangles.emplace_back(first, first + 1, first + 2);
  }
  smooth_normals(flat);
  return flat;
}

}  // namespace encore::scene::samples
