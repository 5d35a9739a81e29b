#pragma once

#include "scene/bounds.h"
#include "scene/scene.h"
#include "scene/triangle.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace encore::scene {

/// What update_triangles remembers of the instance it last wrote, to see what need not be written
/// again.
struct WrittenInstance {
  std::shared_ptr<const Model> model;  ///< the mesh, or the frame of a sequence, that was written
  glm::mat4 before{1.0F};              ///< what was applied before a deformer, or alone
  glm::mat4 after{1.0F};               ///< what was applied after a deformer
  double phase = 0.0;                  ///< of a deformer
  glm::vec3 centre{0.0F};              ///< of a deformer: the middle of the shape at rest
  std::size_t first = 0;               ///< place of its triangles in the list
  std::size_t count = 0;               ///< their number, without those left out
  std::uint64_t left_out = 0;
  std::uint64_t left_out_pattern = 0;  ///< a hash of which ones were left out
  std::uint64_t version = 0;           ///< of the list, when one of them last changed
};

/// The one triangle list of a scene at one time, in world space: what structures are built over.
struct TriangleList {
  std::vector<Triangle> triangles;
  /// Shading normals, three a triangle, not normalised; empty if no instance has any. A triangle
  /// of an instance without normals holds three zero vectors here: use its geometric normal.
  std::vector<std::array<glm::vec3, 3>> normals;
  /// Vertex colours, three a triangle; empty if no instance has any. They multiply the diffuse
  /// colour; triangles of instances without colours hold ones.
  std::vector<std::array<glm::vec3, 3>> colors;
  /// Texture coordinates, three a triangle; empty unless some instance has a material with a
  /// texture and a mesh with coordinates. Triangles of instances without any hold zeros.
  std::vector<std::array<glm::vec2, 3>> texcoords;
  /// Triangles left out because a coordinate was NaN, infinite or beyond kLargestCoordinate
  /// (triangle.h) at this time.
  std::uint64_t dropped_non_finite = 0;
  /// Grows when any vertex changed.
  std::uint64_t version = 0;
  /// Grows when triangles appeared, vanished or changed places: refitting is then impossible.
  std::uint64_t topology_version = 0;

  /// Bookkeeping of update_triangles; of no use to others.
  struct Bookkeeping {
    std::uint64_t scene_version = 0;
    bool has_normals = false;  ///< some mesh of the scene has normals, colours
    bool has_colors = false;
    bool has_texcoords = false;  ///< and some instance with coordinates wears a texture
    std::vector<WrittenInstance> instances;
    std::vector<glm::vec3> positions;  ///< scratch: one mesh's vertices in world space
    std::vector<glm::vec3> vertex_normals;
  };
  Bookkeeping bookkeeping{};

  [[nodiscard]] Bounds bounds() const;
};

/// Triangles that lie side by side in a list.
struct TriangleRange {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// Those triangles (with their normals, colours and texture coordinates) that may have changed
/// since the list had this version, in ascending order, neighbours joined. Of use only while
/// `topology_version` is the same; otherwise everything may have changed.
std::vector<TriangleRange> changed_since(const TriangleList& list, std::uint64_t version);

enum class TriangleChange { none, moved, topology };

/// Writes the triangles of `scene` at `time_s` (wrapped to the animation's loop) into `list`,
/// touching only what differs from what the list holds; no allocation if the count stays the same.
/// A list may only ever be used with one scene, whose edits are seen by Scene::version(). Returns
/// what changed; `none` also leaves the versions alone, so nothing downstream rebuilds. The first
/// call always returns `topology`. Frames of a sequence that name the same vertices in the same
/// order are `moved`; any other change of frame is `topology`, and so is a triangle that becomes
/// finite or ceases to be. Normals are turned by the inverse transpose, and only where there are
/// any.
TriangleChange update_triangles(const Scene& scene, double time_s, TriangleList& list);

}  // namespace encore::scene
