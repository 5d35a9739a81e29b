#pragma once

#include "accel/grid/float4.h"
#include "scene/triangle.h"

#include <array>
#include <cstdint>

namespace encore::accel {

/// Up to four neighbouring boxes along one axis: their lower and upper planes.
struct BoxRow {
  Float4 low;
  Float4 high;
};

/// The triangle-box overlap test of Akenine-Möller (2001) for one triangle and up to 4 x 4 x 4
/// neighbouring boxes at once, in single precision. What depends on the triangle alone is computed
/// once; since boxes in a grid share planes, what depends on one plane is computed once a plane.
///
/// A triangle's projection along an axis is a two-dimensional triangle, which a rectangle misses
/// only if it lies beyond an edge, on the outer side (Schwarz and Seidel 2010 use the same form);
/// so the paper's nine cross-product axes become three one-sided tests in each of three
/// projections.
///
/// Conservative like overlaps() in triangle_box.h: a box is turned away only beyond a bound on the
/// rounding errors, which is relative to the range of cells that is tested. The box's own normals
/// are not tested: boxes must touch the triangle's bounds. A projection too thin for its
/// orientation to be known turns away nothing; uncertain() then says that what remains should be
/// tested with overlaps().
class CellOverlap {
 public:
  /// `extent`: size of the range of cells that the triangle's bounds touch. `spans`: the range has
  /// more than one cell along that axis; tests that could turn nothing away are left out.
  /// Coordinates must be at most 4 in magnitude, so that nothing overflows.
  CellOverlap(const std::array<Float4, 3>& vertices, Float4 extent,
              const std::array<bool, 3>& spans);

  /// Bit x + 4 * y + 16 * z of the result is set if box (x, y, z) may overlap the triangle;
  /// count[axis] boxes along each axis are valid.
  [[nodiscard]] std::uint64_t test(const std::array<BoxRow, 3>& rows,
                                   const std::array<std::uint32_t, 3>& count) const;

  [[nodiscard]] bool uncertain() const { return uncertain_; }

 private:
  /// One edge of one projection: inside where along_u * (u - start u) + along_w * (w - start w) +
  /// slack >= 0, with u and w the two axes after the projection's.
  struct Edge {
    float start_u, start_w, along_u, along_w, slack;
  };

  [[nodiscard]] std::array<unsigned, 4> test_projection(int axis, const BoxRow& u_row,
                                                        const BoxRow& w_row,
                                                        std::uint32_t w_count) const;
  [[nodiscard]] std::uint64_t test_plane(const std::array<BoxRow, 3>& rows,
                                         const std::array<std::uint32_t, 3>& count) const;

  std::array<bool, 3> spans_;
  bool uncertain_ = false;
  std::array<std::array<Edge, 3>, 3> edges_;  // [projection][edge]
  std::array<float, 3> v0_;
  std::array<float, 3> normal_;
  float plane_slack_ = 0.0F;
};

}  // namespace encore::accel
