#include "scene/model_cleanup.h"

#include "scene/load_watch.h"
#include "scene/model_input.h"
#include "scene/triangle.h"
#include "scene/triangulate.h"

#include <algorithm>
#include <cmath>

namespace encore::scene {

namespace {

constexpr std::uint64_t kMostVertices = 0xFFFFFFFEULL;

template <typename Value>
void gather(std::vector<Value>& values, const std::vector<std::uint32_t>& kept) {
  if (values.empty()) return;
  for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
  values.resize(kept.size());
  values.shrink_to_fit();
}

void remove_unused_vertices(Mesh& mesh) {
  // Mark what the triangles use; most files use all.
  std::vector<std::uint8_t> used(mesh.positions.size(), 0);
  for (const glm::uvec3& t : mesh.triangles) used[t.x] = used[t.y] = used[t.z] = 1;
  if (std::find(used.begin(), used.end(), 0) == used.end()) return;

  // Then number them in the old order.
  std::vector<std::uint32_t> new_index(mesh.positions.size(), kNoVertex);
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] == 0) continue;
    new_index[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(static_cast<std::uint32_t>(i));
  }

  for (glm::uvec3& t : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) t[corner] = new_index[t[corner]];
  }
  gather(mesh.positions, kept);
  gather(mesh.normals, kept);
  gather(mesh.texcoords, kept);
  gather(mesh.colors, kept);
}

// An attribute that a vertex does not have is a zero normal (the geometric one is then used), a
// zero texture coordinate, a white colour; what is not finite counts as not there.
void repair_attributes(Mesh& mesh) {
  for (glm::vec3& n : mesh.normals) {
    if (!is_finite(n)) n = glm::vec3(0.0F);
  }
  for (glm::vec2& t : mesh.texcoords) {
    if (!std::isfinite(t.x) || !std::isfinite(t.y)) t = glm::vec2(0.0F);
  }
  for (glm::vec3& c : mesh.colors) {
    if (!is_finite(c)) c = glm::vec3(1.0F);
  }
  const auto is_zero = [](const glm::vec3& n) { return n == glm::vec3(0.0F); };
  const auto is_white = [](const glm::vec3& c) { return c == glm::vec3(1.0F); };
  if (std::all_of(mesh.normals.begin(), mesh.normals.end(), is_zero)) mesh.normals = {};
  if (std::all_of(mesh.colors.begin(), mesh.colors.end(), is_white)) mesh.colors = {};
}

void repair_materials(Model& model) {
  Mesh& mesh = model.mesh;
  if (mesh.triangles.empty()) {
    mesh.material_of = {};
    return;
  }
  if (model.materials.empty()) model.materials.emplace_back();
  for (std::uint32_t& material : mesh.material_of) {
    if (material >= model.materials.size()) material = 0;
  }
  const auto is_first = [](std::uint32_t material) { return material == 0; };
  if (std::all_of(mesh.material_of.begin(), mesh.material_of.end(), is_first)) {
    mesh.material_of = {};
  }
}

void report(const Dropped& dropped, const std::string& source, const Model& model,
            Warnings& warnings) {
  if (dropped.bad_index > 0) {
    warnings.add(source + dropped.first_bad_index + ": " + counted(dropped.bad_index, "triangle") +
                 " dropped: vertex index out of range; export the model anew");
  }
  if (dropped.non_finite > 0) {
    warnings.add(source + dropped.first_non_finite + ": " +
                 counted(dropped.non_finite, "triangle") +
                 " dropped: a coordinate is no finite number; export the model anew");
  }
  if (dropped.two_corners > 0) {
    warnings.add(source + ": " + counted(dropped.two_corners, "face") +
                 " with fewer than three corners left out");
  }
  if (dropped.intricate > 0) {
    warnings.add(source + ": " + counted(dropped.intricate, "huge concave polygon") +
                 " cut only roughly; triangulate the model in a modeller");
  }
  if (model.mesh.triangles.empty()) {
    std::string what;
    if (dropped.points > 0) what += "; " + counted(dropped.points, "point") + " not drawn";
    if (dropped.lines > 0) what += "; " + counted(dropped.lines, "line") + " not drawn";
    warnings.add(source + ": holds no triangles" + what);
  }
}

}  // namespace

PolygonAssembler::Verdict PolygonAssembler::try_add(std::span<const std::uint32_t> corners,
                                                    std::uint32_t material) {
  if (corners.size() < 3) {
    ++dropped.two_corners;
    return Verdict::too_few;
  }
  outline_.clear();
  bool finite = true;
  for (const std::uint32_t corner : corners) {
    if (corner >= mesh_.positions.size()) {
      dropped.bad_index += corners.size() - 2;
      return Verdict::bad_index;
    }
    outline_.push_back(mesh_.positions[corner]);
    finite = finite && is_finite(outline_.back());
  }
  if (!finite) {
    dropped.non_finite += corners.size() - 2;
    return Verdict::non_finite;
  }

  pieces_.clear();
  if (!triangulate(outline_, pieces_)) ++dropped.intricate;
  for (const glm::uvec3& piece : pieces_) {
    mesh_.triangles.emplace_back(corners[piece.x], corners[piece.y], corners[piece.z]);
    mesh_.material_of.push_back(material);
  }
  return Verdict::added;
}

void finish_model(Model& model, const std::string& source, const Dropped& dropped) {
  if (model.mesh.positions.size() > kMostVertices || model.mesh.triangles.size() > kMostVertices) {
    throw InputError(source + ": more vertices or triangles than 32-bit indices can name; " +
                     "split the model");
  }
  check_load();
  remove_unused_vertices(model.mesh);
  check_load();
  repair_attributes(model.mesh);
  check_load();
  repair_materials(model);
  report(dropped, source, model, model.warnings);
}

}  // namespace encore::scene
