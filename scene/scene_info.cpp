#include "scene/scene_info.h"

#include "scene/motion.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <variant>

namespace encore::scene {
namespace {

/// Twice the area of any triangle fits a double: coordinates below 4e38 give products below 1e78.
double area_of(const Triangle& t) {
  const glm::dvec3 a = glm::dvec3(t.v1) - glm::dvec3(t.v0);
  const glm::dvec3 b = glm::dvec3(t.v2) - glm::dvec3(t.v0);
  const double x = a.y * b.z - a.z * b.y;
  const double y = a.z * b.x - a.x * b.z;
  const double z = a.x * b.y - a.y * b.x;
  return 0.5 * std::sqrt(x * x + y * y + z * z);
}

glm::dvec3 sides_of(const Bounds& b) {
  return b.empty() ? glm::dvec3(0.0) : glm::dvec3(b.max) - glm::dvec3(b.min);
}

double longest(const glm::dvec3& v) {
  return std::max({v.x, v.y, v.z});
}

/// `sorted` ascending; the mean is added in that order, small ones first.
Distribution distribution_of(const std::vector<double>& sorted) {
  Distribution d;
  if (sorted.empty()) return d;
  const auto at = [&sorted](double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    return sorted[static_cast<std::size_t>(std::floor(place + 0.5))];
  };
  double sum = 0.0;
  for (const double x : sorted) sum += x;
  d.min = sorted.front();
  d.percentile_10 = at(0.1);
  d.median = at(0.5);
  d.mean = sum / static_cast<double>(sorted.size());
  d.percentile_90 = at(0.9);
  d.percentile_99 = at(0.99);
  d.max = sorted.back();
  return d;
}

/// Gini coefficient of ascending numbers: 2 sum(rank * x) / (n sum(x)) - (n + 1) / n.
double gini(const std::vector<double>& sorted) {
  double sum = 0.0;
  double ranked = 0.0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    sum += sorted[i];
    ranked += static_cast<double>(i + 1) * sorted[i];
  }
  if (!(sum > 0.0)) return 0.0;
  const auto n = static_cast<double>(sorted.size());
  return std::max(0.0, 2.0 * ranked / (n * sum) - (n + 1.0) / n);
}

void describe_sizes(const TriangleList& list, SceneInfo& info) {
  std::vector<double> values;
  values.reserve(list.triangles.size());
  for (const Triangle& t : list.triangles) values.push_back(area_of(t));
  std::sort(values.begin(), values.end());
  for (const double area : values) {
    info.surface_area += area;
    if (area == 0.0) ++info.degenerate_triangles;
  }
  info.area_unevenness = gini(values);
  info.area = distribution_of(values);
  const double mean = info.area.mean;
  if (mean > 0.0) {
    for (double& area : values) area /= mean;
    info.area = distribution_of(values);
  }

  const double scene_side = longest(sides_of(info.bounds));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double side = longest(sides_of(bounds_of(list.triangles[i])));
    values[i] = scene_side > 0.0 ? side / scene_side : 0.0;
  }
  std::sort(values.begin(), values.end());
  info.extent = distribution_of(values);
}

/// How evenly the triangles fill the bounds.
void describe_density(const TriangleList& list, SceneInfo& info) {
  if (list.triangles.empty()) return;
  const glm::dvec3 sides = sides_of(info.bounds);
  for (int axis = 0; axis < 3; ++axis) info.coarse_cells[axis] = sides[axis] > 0 ? kCoarseCells : 1;
  const glm::ivec3 cells = info.coarse_cells;
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(cells.x * cells.y * cells.z), 0);
  for (const Triangle& t : list.triangles) {
    const glm::dvec3 centre = (glm::dvec3(t.v0) + glm::dvec3(t.v1) + glm::dvec3(t.v2)) / 3.0;
    glm::ivec3 cell(0);
    for (int axis = 0; axis < 3; ++axis) {
      if (cells[axis] == 1) continue;
      const double along = (centre[axis] - double(info.bounds.min[axis])) / sides[axis];
      cell[axis] = std::clamp(static_cast<int>(along * cells[axis]), 0, cells[axis] - 1);
    }
    const int index = (cell.z * cells.y + cell.y) * cells.x + cell.x;
    ++counts[static_cast<std::size_t>(index)];
  }
  const auto occupied =
      counts.size() - static_cast<std::size_t>(std::count(counts.begin(), counts.end(), 0U));
  info.occupied_share = static_cast<double>(occupied) / static_cast<double>(counts.size());
  const auto all = static_cast<double>(list.triangles.size());
  info.fullest_cell_share =
      static_cast<double>(*std::max_element(counts.begin(), counts.end())) / all;
  const double volume = sides.x * sides.y * sides.z;
  if (volume > 0.0) info.triangles_per_volume = all / volume;
}

template <class T>
std::uint64_t bytes_of(const std::vector<T>& v) {
  return static_cast<std::uint64_t>(v.capacity()) * sizeof(T);
}

std::uint64_t bytes_of(const Mesh& m) {
  return bytes_of(m.positions) + bytes_of(m.normals) + bytes_of(m.texcoords) + bytes_of(m.colors) +
         bytes_of(m.triangles) + bytes_of(m.material_of);
}

std::string kind_of(const Motion& motion) {
  if (std::holds_alternative<RigidMotion>(motion)) return "rigid parts";
  if (std::holds_alternative<Deformer>(motion)) return "deforming";
  return "frame sequence";
}

void describe_motion(const Scene& scene, SceneInfo& info) {
  AnimationInfo& a = info.animation;
  a.duration_s = scene.duration_s();
  std::set<const Model*> models;
  for (const Instance& instance : scene.instances) {
    std::uint64_t fewest = instance.model ? instance.model->mesh.triangles.size() : 0;
    std::uint64_t most = fewest;
    if (instance.model) models.insert(instance.model.get());
    if (const auto* sequence = std::get_if<FrameSequence>(&instance.motion)) {
      a.frames = std::max<std::uint64_t>(a.frames, sequence->frames.size());
      if (!sequence->frames.empty()) {
        fewest = most = sequence->frames.front()->mesh.triangles.size();
      }
      for (const auto& frame : sequence->frames) {
        models.insert(frame.get());
        fewest = std::min<std::uint64_t>(fewest, frame->mesh.triangles.size());
        most = std::max<std::uint64_t>(most, frame->mesh.triangles.size());
      }
    }
    a.min_triangles += fewest;
    a.max_triangles += most;
    if (motion_duration_s(instance.motion) <= 0.0) continue;
    ++a.moving_instances;
    const std::string kind = kind_of(instance.motion);
    if (a.kind != kind) a.kind = a.kind == "static" ? kind : "mixed";
  }
  info.models = models.size();
  for (const Model* model : models) info.mesh_bytes += bytes_of(model->mesh);
}

}  // namespace

SceneInfo describe(const Scene& scene, const TriangleList& list) {
  SceneInfo info;
  info.name = scene.name;
  info.source = scene.source;
  info.triangles = list.triangles.size();
  info.instances = scene.instances.size();
  info.materials = scene.materials.size();
  info.lights = scene.lights.size();
  info.dropped_non_finite = list.dropped_non_finite;
  info.has_normals = !list.normals.empty();
  info.has_colors = !list.colors.empty();
  info.has_texcoords = !list.texcoords.empty();
  std::set<const Texture*> textures;
  for (const Material& material : scene.materials) {
    const Texture* texture = material.diffuse_texture.get();
    if (texture == nullptr || !textures.insert(texture).second) continue;
    info.texture_bytes += texture->bytes();
  }
  info.textures = textures.size();
  for (const WrittenInstance& shown : list.bookkeeping.instances) {
    if (shown.model) info.vertices += shown.model->mesh.positions.size();
  }
  info.bounds = list.bounds();
  const glm::dvec3 sides = sides_of(info.bounds);
  info.diagonal = std::sqrt(sides.x * sides.x + sides.y * sides.y + sides.z * sides.z);
  describe_sizes(list, info);
  describe_density(list, info);
  describe_motion(scene, info);
  info.triangle_list_bytes =
      bytes_of(list.triangles) + bytes_of(list.normals) + bytes_of(list.colors) +
      bytes_of(list.texcoords) + bytes_of(list.bookkeeping.positions) +
      bytes_of(list.bookkeeping.vertex_normals) + bytes_of(list.bookkeeping.instances);
  info.warnings = scene.warnings.messages;
  return info;
}

}  // namespace encore::scene
