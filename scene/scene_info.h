#pragma once

#include "scene/bounds.h"
#include "scene/scene.h"
#include "scene/triangles.h"

#include <cstdint>
#include <string>
#include <vector>

namespace encore::scene {

/// Figures of a set of numbers; all 0 for none.
struct Distribution {
  double min = 0.0;
  double percentile_10 = 0.0;
  double median = 0.0;
  double mean = 0.0;
  double percentile_90 = 0.0;
  double percentile_99 = 0.0;
  double max = 0.0;
};

/// How a scene moves.
struct AnimationInfo {
  std::string kind = "static";  ///< or "rigid parts", "deforming", "frame sequence", "mixed"
  std::uint64_t moving_instances = 0;
  std::uint64_t frames = 0;  ///< of the longest sequence; 0 if there is none
  double duration_s = 0.0;
  std::uint64_t min_triangles = 0;  ///< sums of each instance's fewest and most triangles over
  std::uint64_t max_triangles = 0;  ///< its frames
};

/// What is to be known of a scene before structures are built over it. Lengths are in world units;
/// everything geometric is at the time of the triangle list.
struct SceneInfo {
  std::string name;
  std::string source;
  std::uint64_t triangles = 0;
  std::uint64_t vertices = 0;  ///< of the meshes shown, once an instance
  std::uint64_t instances = 0;
  std::uint64_t models = 0;  ///< different meshes in memory, all frames counted
  std::uint64_t materials = 0;
  std::uint64_t lights = 0;
  std::uint64_t degenerate_triangles = 0;  ///< of area 0
  std::uint64_t dropped_non_finite = 0;
  bool has_normals = false;
  bool has_colors = false;
  bool has_texcoords = false;       ///< in the list: some surface with coordinates wears a texture
  std::uint64_t textures = 0;       ///< different ones
  std::uint64_t texture_bytes = 0;  ///< of their texels

  Bounds bounds;
  double diagonal = 0.0;
  double surface_area = 0.0;  ///< sum over the triangles
  /// Longest side of a triangle's box, as a share of the scene's longest side.
  Distribution extent;
  /// Area of a triangle, as a multiple of the mean area.
  Distribution area;
  /// Gini coefficient of the areas: 0 when all are equal, near 1 when few hold almost all.
  double area_unevenness = 0.0;

  /// The coarse grid over the bounds, and what lies where; a triangle counts at its centre.
  glm::ivec3 coarse_cells{0};
  double occupied_share = 0.0;        ///< share of the cells that hold a triangle
  double fullest_cell_share = 0.0;    ///< share of the triangles that lie in the fullest cell
  double triangles_per_volume = 0.0;  ///< a unit of volume of the bounds; 0 for a flat scene

  AnimationInfo animation;
  std::uint64_t mesh_bytes = 0;           ///< all models
  std::uint64_t triangle_list_bytes = 0;  ///< the list, with normals, colours, texture coordinates
                                          ///< and scratch
  std::vector<std::string> warnings;
};

/// Sides of the coarse grid; a side along which the scene is flat has one cell.
inline constexpr int kCoarseCells = 16;

/// Describes a scene and its triangle list (see update_triangles). Sorts the triangles' sizes: a
/// second or so for millions of triangles.
SceneInfo describe(const Scene& scene, const TriangleList& list);

}  // namespace encore::scene
