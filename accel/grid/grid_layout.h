#pragma once

#include "accel/array.h"
#include "accel/settings.h"
#include "scene/bounds.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace encore::accel {

/// The cells that a box touches, packed so that millions of them can be kept: ten bits an axis.
class CellRange {
 public:
  static constexpr std::uint32_t kMaxCellsPerAxis = 1024;

  CellRange() = default;  // uninitialised
  CellRange(const std::array<std::uint32_t, 3>& first, const std::array<std::uint32_t, 3>& last)
      : first_(first[0] | first[1] << 10 | first[2] << 20),
        span_((last[0] - first[0]) | (last[1] - first[1]) << 10 | (last[2] - first[2]) << 20) {}

  /// The lowest cell index along an axis, and how many further cells follow it there.
  [[nodiscard]] std::uint32_t first(int axis) const { return first_ >> (10 * axis) & 1023U; }
  [[nodiscard]] std::uint32_t span(int axis) const { return span_ >> (10 * axis) & 1023U; }
  [[nodiscard]] std::uint64_t cells() const {
    return std::uint64_t{span(0) + 1} * (span(1) + 1) * (span(2) + 1);
  }
  /// At most two cells along every axis.
  [[nodiscard]] bool small() const { return (span_ & ~(1U | 1U << 10 | 1U << 20)) == 0; }
  /// More than one cell along at least two axes: only then can a box's cells miss its triangle.
  [[nodiscard]] bool ambiguous() const {
    return (span(0) != 0) + (span(1) != 0) + (span(2) != 0) >= 2;
  }

 private:
  std::uint32_t first_;
  std::uint32_t span_;
};

/// How a grid divides a box: cells per axis, and the cell boundaries ("planes") as floats.
///
/// Cells are half-open, [plane i, plane i + 1), the last one closed. cell_of() is a monotone
/// function of the coordinate, evaluated in double; each stored plane is the smallest float that it
/// puts into the cell above. Whoever asks cell_of() and whoever compares with the planes therefore
/// agree on every float, which is what lets the build and the traversal never lose a triangle
/// between two cells. Where the extent holds fewer floats than cells, planes coincide and cells
/// stay empty. An axis without extent has a single cell.
class GridLayout {
 public:
  /// Divides the box (empty: a single cell at the origin) into `cells` per axis, 1 to 1024.
  void divide(const scene::Bounds& bounds, std::uint32_t cells, MemoryMode mode,
              AllocationCount& count);

  [[nodiscard]] std::uint32_t size(int axis) const { return size_[static_cast<std::size_t>(axis)]; }
  [[nodiscard]] const std::array<std::uint32_t, 3>& sizes() const { return size_; }
  [[nodiscard]] std::uint32_t cell_count() const { return size_[0] * size_[1] * size_[2]; }
  /// Distance in the cell array from one cell to the next along an axis: x runs fastest.
  [[nodiscard]] std::uint32_t stride(int axis) const {
    return axis == 0 ? 1 : axis == 1 ? size_[0] : size_[0] * size_[1];
  }

  /// The coordinates of a cell of the cell array.
  [[nodiscard]] std::array<std::uint32_t, 3> position(std::uint32_t cell) const {
    return {cell % size_[0], cell / size_[0] % size_[1], cell / (size_[0] * size_[1])};
  }

  /// The cell of a coordinate; coordinates outside the box belong to the nearest cell.
  [[nodiscard]] std::uint32_t cell_of(int axis, float x) const {
    const auto a = static_cast<std::size_t>(axis);
    const double cell = (static_cast<double>(x) - origin_[a]) * cells_per_unit_[a];
    const double clamped = cell < last_[a] ? cell : last_[a];
    return clamped > 0.0 ? static_cast<std::uint32_t>(clamped) : 0U;
  }
  /// The cells of a box that lies within the divided one.
  [[nodiscard]] CellRange range_of(const scene::Bounds& box) const {
    return {
        {inner_cell_of(0, box.min.x), inner_cell_of(1, box.min.y), inner_cell_of(2, box.min.z)},
        {inner_cell_of(0, box.max.x), inner_cell_of(1, box.max.y), inner_cell_of(2, box.max.z)}};
  }

  /// size(axis) + 1 boundaries, ascending; the first and the last are the box's own.
  [[nodiscard]] const float* planes(int axis) const {
    return planes_.data() + plane_start_[static_cast<std::size_t>(axis)];
  }
  /// All boundaries: those of x, then y, then z.
  [[nodiscard]] const Array<float>& all_planes() const { return planes_; }
  /// The least distance between neighbouring planes; 0 where some coincide.
  [[nodiscard]] float smallest_gap(int axis) const {
    return smallest_gap_[static_cast<std::size_t>(axis)];
  }
  [[nodiscard]] scene::Bounds bounds() const;
  [[nodiscard]] scene::Bounds cell_bounds(std::uint32_t x, std::uint32_t y, std::uint32_t z) const;

 private:
  [[nodiscard]] std::uint32_t inner_cell_of(int axis, float x) const {
    const auto a = static_cast<std::size_t>(axis);
    const double cell = (static_cast<double>(x) - origin_[a]) * cells_per_unit_[a];
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(cell < last_[a] ? cell : last_[a]));
  }
  [[nodiscard]] float first_float_of_cell(int axis, std::uint32_t cell, float low,
                                          float high) const;
  void place_planes(int axis, float low, float high, float* planes);

  std::array<std::uint32_t, 3> size_{1, 1, 1};
  std::array<std::size_t, 3> plane_start_{};
  std::array<double, 3> origin_{};
  std::array<double, 3> cells_per_unit_{};
  std::array<double, 3> last_{};  // index of the last cell
  std::array<float, 3> smallest_gap_{};
  Array<float> planes_;
};

}  // namespace encore::accel
