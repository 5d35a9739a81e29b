#pragma once

#include "scene/mesh.h"
#include "scene/ply_reader_header.h"

#include <array>
#include <string_view>
#include <vector>

namespace encore::scene {

/// Where a vertex property goes; the numbers index a row of floats.
enum PlySlot {
  kPlyX,
  kPlyY,
  kPlyZ,
  kPlyNormalX,
  kPlyNormalY,
  kPlyNormalZ,
  kPlyRed,
  kPlyGreen,
  kPlyBlue,
  kPlyU,
  kPlyV,
  kPlySlots
};
inline constexpr int kPlySkip = -1;
using PlyRow = std::array<float, kPlySlots>;

/// One property of the vertices.
struct PlyColumn {
  PlyType type = PlyType::float32;
  int slot = kPlySkip;
  double scale = 1.0;      ///< what its values are multiplied by
  std::size_t offset = 0;  ///< in a row of a binary file, if there are no lists
};

/// Where the properties of the vertices go, decided once for all rows.
struct PlyVertexLayout {
  std::vector<PlyColumn> columns;  ///< one a property, of lists too (skipped)
  std::size_t row_bytes = 0;       ///< of a binary file, if there are no lists
  bool has_lists = false;
  bool positions = false, normals = false, colors = false, texcoords = false;  ///< complete ones
};

PlyVertexLayout ply_vertex_layout(const PlyElement& element);

/// Appends a vertex with the attributes that the layout has.
void add_ply_vertex(const PlyRow& row, const PlyVertexLayout& layout, Mesh& mesh);

/// Appends the vertices that lie in `rows`, whole rows of a binary file without lists; the same as
/// value by value. `swap`: the bytes of each value are the other way round.
void add_ply_rows(std::string_view rows, const PlyVertexLayout& layout, bool swap, Mesh& mesh);

/// A double beyond the range of floats is infinite as a float, which drops its triangles.
float ply_float(double value);

}  // namespace encore::scene
