#pragma once

#include "scene/model.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace encore::scene {

/// A vertex index that refers to nothing; polygons that hold one are dropped.
inline constexpr std::uint32_t kNoVertex = 0xFFFFFFFFU;

/// What a reader had to leave out. Triangles are counted as the polygon would have given them.
struct Dropped {
  std::uint64_t bad_index = 0;    ///< triangles with a vertex index out of range
  std::uint64_t non_finite = 0;   ///< triangles with a NaN or infinite coordinate
  std::uint64_t two_corners = 0;  ///< faces with fewer than three corners
  std::uint64_t intricate = 0;    ///< polygons too large and too crooked to be cut exactly
  std::uint64_t points = 0;
  std::uint64_t lines = 0;
  std::string first_bad_index;  ///< ":12" or nothing; likewise for the others
  std::string first_non_finite;
};

/// Turns polygons into triangles of `mesh`, in order, and keeps count of those that cannot be used.
class PolygonAssembler {
 public:
  explicit PolygonAssembler(Mesh& mesh) : mesh_(mesh) {}

  /// Adds the polygon over mesh.positions; any index value is allowed. `place` (as ":12") is only
  /// asked for when the polygon is the first to be dropped for its reason.
  template <typename Place>
  void add(std::span<const std::uint32_t> corners, std::uint32_t material, const Place& place) {
    const Verdict verdict = try_add(corners, material);
    if (verdict == Verdict::bad_index && dropped.first_bad_index.empty()) {
      dropped.first_bad_index = place();
    }
    if (verdict == Verdict::non_finite && dropped.first_non_finite.empty()) {
      dropped.first_non_finite = place();
    }
  }
  void add(std::span<const std::uint32_t> corners, std::uint32_t material) {
    add(corners, material, [] { return std::string(); });
  }

  Dropped dropped;

 private:
  enum class Verdict { added, too_few, bad_index, non_finite };
  Verdict try_add(std::span<const std::uint32_t> corners, std::uint32_t material);

  Mesh& mesh_;
  std::vector<glm::vec3> outline_;
  std::vector<glm::uvec3> pieces_;
};

/// The last step of every reader: leaves out vertices that no triangle uses (the others keep their
/// order), attributes and material indices that say nothing, makes attributes finite, gives the
/// triangles a material if there is none, and turns `dropped` into warnings that start with
/// `source`. Throws InputError if the model is too large for 32-bit indices.
void finish_model(Model& model, const std::string& source, const Dropped& dropped);

}  // namespace encore::scene
