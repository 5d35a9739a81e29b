#pragma once

#include "scene/mesh.h"
#include "scene/samples/shapes.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace encore::scene::samples {

/// An organic shape made of soft brush strokes: a signed distance (negative inside) to which each
/// stroke is joined, or from which it is carved, with a smooth seam `blend` units wide. Strokes
/// work in the order in which they were made.
class Sculpture {
 public:
  void ellipsoid(const Frame& frame, const Vec& radii, double blend);
  void ball(const Vec& center, double radius, double blend);
  /// A limb that tapers along a smooth path; `pieces` straight pieces.
  void limb(const std::vector<PathPoint>& path, int pieces, double blend);
  void carve_ellipsoid(const Frame& frame, const Vec& radii, double blend);
  /// Removes a disc: a cylinder around the frame's y axis, 2 * half_height tall.
  void carve_disc(const Frame& frame, double radius, double half_height, double blend);

  /// The surface sampled on a lattice of the given cell size: one vertex a cell that the surface
  /// crosses, two triangles a lattice edge that it crosses (Gibson's surface nets, 1998; we place
  /// each vertex at the mean of its cell's crossings and leave it there). Closed, facing outwards.
  [[nodiscard]] Mesh surface(double cell) const;

  /// surface() with the finest cell whose triangle count stays within `most`, and within a few
  /// per cent of it.
  [[nodiscard]] Mesh surface_of(std::size_t most) const;

 private:
  struct Stroke {
    Vec low;  ///< box beyond which the stroke has no effect but the blend
    Vec high;
    std::function<double(const Vec&)> distance;
    double blend;
    bool carve;
  };
  std::vector<Stroke> strokes_;
};

/// How far a point of a surface is pushed out along its normal; arguments: point and normal.
using Relief = std::function<double(const Vec&, const Vec&)>;

/// Pushes every vertex out along its smooth normal.
void emboss(Mesh& mesh, const Relief& relief);

/// The finished surface of a sculpture with exactly `target` triangles (even): sampled at a count
/// of target / 4^levels, subdivided `levels` times, embossed, and smooth normals computed.
/// The few triangles that are missing after each step come from splitting the longest edges.
Mesh finished(const Sculpture& sculpture, std::size_t target, int levels, const Relief& relief);

/// The same from a sampled surface that may be open.
Mesh finished(Mesh base, std::size_t target, int levels, const Relief& relief);

}  // namespace encore::scene::samples
