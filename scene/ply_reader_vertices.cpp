#include "scene/ply_reader_vertices.h"

#include "scene/ply_reader_bytes.h"

#include <cmath>
#include <limits>
#include <span>

namespace encore::scene {

namespace {

struct SlotName {
  std::string_view name;
  PlySlot slot;
};
constexpr SlotName kSlotNames[] = {{"x", kPlyX},
                                   {"y", kPlyY},
                                   {"z", kPlyZ},
                                   {"nx", kPlyNormalX},
                                   {"ny", kPlyNormalY},
                                   {"nz", kPlyNormalZ},
                                   {"red", kPlyRed},
                                   {"green", kPlyGreen},
                                   {"blue", kPlyBlue},
                                   {"r", kPlyRed},
                                   {"g", kPlyGreen},
                                   {"b", kPlyBlue},
                                   {"diffuse_red", kPlyRed},
                                   {"diffuse_green", kPlyGreen},
                                   {"diffuse_blue", kPlyBlue},
                                   {"u", kPlyU},
                                   {"v", kPlyV},
                                   {"s", kPlyU},
                                   {"t", kPlyV},
                                   {"texture_u", kPlyU},
                                   {"texture_v", kPlyV}};

int slot_of(const PlyProperty& property) {
  if (property.is_list) return kPlySkip;
  for (const SlotName& known : kSlotNames) {
    if (known.name == property.name) return known.slot;
  }
  return kPlySkip;
}

// Colours of whole-number types count from 0 to the largest value, others from 0 to 1.
double color_scale(PlyType type) {
  switch (type) {
    case PlyType::int8:
      return 1.0 / 127.0;
    case PlyType::uint8:
      return 1.0 / 255.0;
    case PlyType::int16:
      return 1.0 / 32767.0;
    case PlyType::uint16:
      return 1.0 / 65535.0;
    case PlyType::int32:
      return 1.0 / 2147483647.0;
    case PlyType::uint32:
      return 1.0 / 4294967295.0;
    default:
      return 1.0;
  }
}

/// The rows of a binary file, as they lie.
struct Rows {
  const char* data;
  std::size_t stride;
  std::size_t count;
};

template <typename Value, bool swap, typename Vector>
void copy_column(const Rows& rows, const PlyColumn& column, Vector* to, int axis) {
  const char* at = rows.data + column.offset;
  for (std::size_t i = 0; i < rows.count; ++i, at += rows.stride) {
    const auto value = static_cast<double>(load_bytes<Value, swap>(at));
    to[i][axis] = ply_float(value * column.scale);
  }
}

template <bool swap, typename Vector>
void copy_any_column(const Rows& rows, const PlyColumn& column, Vector* to, int axis) {
  switch (column.type) {
    case PlyType::int8:
      return copy_column<std::int8_t, swap>(rows, column, to, axis);
    case PlyType::uint8:
      return copy_column<std::uint8_t, swap>(rows, column, to, axis);
    case PlyType::int16:
      return copy_column<std::int16_t, swap>(rows, column, to, axis);
    case PlyType::uint16:
      return copy_column<std::uint16_t, swap>(rows, column, to, axis);
    case PlyType::int32:
      return copy_column<std::int32_t, swap>(rows, column, to, axis);
    case PlyType::uint32:
      return copy_column<std::uint32_t, swap>(rows, column, to, axis);
    case PlyType::float32:
      return copy_column<float, swap>(rows, column, to, axis);
    case PlyType::float64:
      return copy_column<double, swap>(rows, column, to, axis);
  }
}

/// Fills the vector whose first component is `slot` from its columns.
template <typename Vector>
void fill(const Rows& rows, const PlyVertexLayout& layout, bool swap, int slot,
          std::vector<Vector>& vectors) {
  const std::size_t old = vectors.size();
  vectors.resize(old + rows.count);
  for (const PlyColumn& column : layout.columns) {
    const int axis = column.slot - slot;
    if (column.slot == kPlySkip || axis < 0 || axis >= Vector::length()) continue;
    if (swap) {
      copy_any_column<true>(rows, column, vectors.data() + old, axis);
    } else {
      copy_any_column<false>(rows, column, vectors.data() + old, axis);
    }
  }
}

/// Where x, y and z stand next to each other as the machine keeps them; null if they do not.
const PlyColumn* plain_positions(const PlyVertexLayout& layout) {
  const PlyColumn* first = nullptr;
  int found = 0;
  for (const PlyColumn& column : layout.columns) {
    if (column.slot > kPlyZ || column.slot == kPlySkip) continue;
    if (column.slot != found || column.type != PlyType::float32) return nullptr;
    if (found == 0) first = &column;
    if (column.offset != first->offset + 4 * static_cast<std::size_t>(found)) return nullptr;
    ++found;
  }
  return first;
}

void copy_positions(const Rows& rows, std::size_t offset, std::vector<glm::vec3>& positions) {
  const std::size_t old = positions.size();
  positions.resize(old + rows.count);
  const std::span<glm::vec3> fresh = std::span(positions).subspan(old);
  const char* at = rows.data + offset;
  for (glm::vec3& p : fresh) {
    std::memcpy(&p, at, sizeof p);
    at += rows.stride;
  }
}

}  // namespace

float ply_float(double value) {
  if (std::abs(value) > 3.4028235677973366e38) {
    return value > 0.0 ? std::numeric_limits<float>::infinity()
                       : -std::numeric_limits<float>::infinity();
  }
  return static_cast<float>(value);
}

PlyVertexLayout ply_vertex_layout(const PlyElement& element) {
  PlyVertexLayout layout;
  std::array<bool, kPlySlots> has{};
  for (const PlyProperty& property : element.properties) {
    const int slot = slot_of(property);
    const bool color = slot >= kPlyRed && slot <= kPlyBlue;
    const double scale = color ? color_scale(property.type) : 1.0;
    layout.columns.push_back({property.type, slot, scale, layout.row_bytes});
    layout.row_bytes += ply_size(property.type);
    layout.has_lists = layout.has_lists || property.is_list;
    if (slot != kPlySkip) has[static_cast<std::size_t>(slot)] = true;
  }
  layout.positions = has[kPlyX] && has[kPlyY] && has[kPlyZ];
  layout.normals = has[kPlyNormalX] && has[kPlyNormalY] && has[kPlyNormalZ];
  layout.colors = has[kPlyRed] && has[kPlyGreen] && has[kPlyBlue];
  layout.texcoords = has[kPlyU] && has[kPlyV];
  return layout;
}

void add_ply_vertex(const PlyRow& row, const PlyVertexLayout& layout, Mesh& mesh) {
  mesh.positions.emplace_back(row[kPlyX], row[kPlyY], row[kPlyZ]);
  if (layout.normals) {
    mesh.normals.emplace_back(row[kPlyNormalX], row[kPlyNormalY], row[kPlyNormalZ]);
  }
  if (layout.colors) mesh.colors.emplace_back(row[kPlyRed], row[kPlyGreen], row[kPlyBlue]);
  if (layout.texcoords) mesh.texcoords.emplace_back(row[kPlyU], row[kPlyV]);
}

void add_ply_rows(std::string_view rows, const PlyVertexLayout& layout, bool swap, Mesh& mesh) {
  const Rows all{rows.data(), layout.row_bytes, rows.size() / layout.row_bytes};
  const PlyColumn* const plain = swap ? nullptr : plain_positions(layout);
  if (plain != nullptr) {
    copy_positions(all, plain->offset, mesh.positions);
  } else {
    fill(all, layout, swap, kPlyX, mesh.positions);
  }
  if (layout.normals) fill(all, layout, swap, kPlyNormalX, mesh.normals);
  if (layout.colors) fill(all, layout, swap, kPlyRed, mesh.colors);
  if (layout.texcoords) fill(all, layout, swap, kPlyU, mesh.texcoords);
}

}  // namespace encore::scene
