#pragma once

#include "accel/acceleration_structure.h"
#include "accel/array.h"
#include "accel/grid/grid_layout.h"
#include "accel/grid/grid_tile.h"
#include "accel/parallel.h"
#include "accel/settings.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace encore::accel {

/// The thesis' uniform grid (3.1): M = round(cbrt(#T)) cells along every axis, so cells are as
/// oblong as the scene. Built by counting references, allocating once and inserting; `grid-exact`
/// keeps a triangle only in the cells that it overlaps (Akenine-Möller 2001), `grid-box` in all
/// cells that its bounds touch. Traversed by a three-dimensional DDA (Amanatides and Woo 1987).
///
/// Where we differ from the thesis: an axis without extent gets one cell, since more would all be
/// the same plane. M is at most 1024, and at most the cube root of 2^24 + 64 #T, also when set by
/// hand. Large triangles can put #T references each into any grid; so if all bounds together touch
/// more than 2^22 + 32 #T cells (GridSettings::most_references), M is lowered until they no longer
/// do (the same M for both kinds).
class Grid final : public TracedStructure<Grid> {
 public:
  /// `kind` is grid_exact or grid_box.
  Grid(StructureKind kind, GridSettings settings, MemoryMode mode)
      : kind_(kind), settings_(settings), mode_(mode) {}

  [[nodiscard]] std::string_view name() const override { return to_string(kind_); }
  /// Throws std::length_error for more than 2^32 - 2 triangles.
  void build(std::span<const Triangle> triangles) override;
  [[nodiscard]] BuildStats stats() const override;
  [[nodiscard]] GpuBuffers gpu_buffers() const override;
  [[nodiscard]] gpu::StructureParameters gpu_parameters() const override;
  void visit(const std::function<bool(const NodeView&)>& visitor) const override;

  /// Cells and planes of the last build.
  [[nodiscard]] const GridLayout& layout() const { return layout_; }
  /// The triangles of one cell, in ascending order.
  [[nodiscard]] std::span<const std::uint32_t> cell(std::uint32_t x, std::uint32_t y,
                                                    std::uint32_t z) const;

  template <bool AnyHit, class Tester, class Counter>
  void trace(const Ray& ray, Hit& hit, Counter& counter) const;

  /// Which instruction set traces tiles from now on; chosen_isa() unless a test asks for another.
  void set_isa(Isa isa) { isa_ = isa; }

 protected:
  void intersect_together(std::span<const Ray> rays, std::size_t width,
                          std::span<Hit> hits) const override;
  void occluded_together(std::span<const Ray> rays, std::size_t width,
                         std::span<std::uint8_t> blocked) const override;

 private:
  [[nodiscard]] GridTileView tile_view() const;

  /// Marks the first entry of a triangle in entries_; cell indices need only 30 bits.
  static constexpr std::uint32_t kFirstOfTriangle = 0x80000000U;
  // What is done after each pass, as measured for grid-exact over a million triangles; grid-box
  // lists faster and so is ahead of its figure.
  static constexpr double kBoundsDone = 0.05;
  static constexpr double kRangesDone = 0.15;
  static constexpr double kListDone = 0.65;
  static constexpr double kCountDone = 0.75;
  static constexpr double kStartsDone = 0.8;
  /// Emitting may write this many entries past the last valid one of a part.
  static constexpr std::size_t kEntryPadding = 8;

  /// Triangles that several threads take at a time.
  static constexpr std::size_t kPart = 4096;
  /// Such a part: where its entries begin, at most how many there may be, and how many there are.
  struct Part {
    std::size_t begin = 0;
    std::size_t most = 0;
    std::size_t count = 0;
  };

  // Building, in this order; what several threads do is in grid_build_parallel.cpp.
  void build_over(std::span<const Triangle> triangles, BuildMeter& meter, const Workers& workers);
  Bounds find_bounds(BuildMeter& meter, const Workers& workers) const;
  Bounds bounds_of_triangles(std::size_t begin, std::size_t end, Bounds bounds) const;
  void choose_cells(const Bounds& bounds, BuildMeter& meter, const Workers& workers);
  std::uint64_t find_ranges(BuildMeter& meter, const Workers& workers);
  std::uint64_t find_ranges(std::size_t begin, std::size_t end);
  void prepare_list();
  std::size_t list_entries(BuildMeter& meter);
  void list_entries_together(BuildMeter& meter, const Workers& workers);
  /// Lists the entries of some triangles; returns how many. Adds up the triangle-box tests.
  std::size_t list(std::size_t begin, std::size_t end, std::uint32_t* out,
                   std::uint64_t& tests) const;
  std::size_t list_box(std::size_t begin, std::size_t end, std::uint32_t* out) const;
  std::size_t list_exact(std::size_t begin, std::size_t end, std::uint32_t* out,
                         std::uint64_t& tests) const;
  void insert_entries(std::size_t count, BuildMeter& meter);
  void insert_entries_together(BuildMeter& meter, const Workers& workers);
  void sum_up_counts(std::size_t chunks, BuildMeter& meter, const Workers& workers);

  const StructureKind kind_;
  const GridSettings settings_;
  const MemoryMode mode_;
  Isa isa_ = chosen_isa();
  std::span<const Triangle> triangles_;

  // What tracing needs: the references of cell c are references_[starts_[c] .. starts_[c + 1]).
  GridLayout layout_;
  Array<std::uint32_t> cell_starts_;
  Array<std::uint32_t> references_;

  // What only building needs: the cells of each triangle's bounds; then, triangle by triangle, the
  // cells that it is to go into; the planes for the exact test and their scale; and for several
  // threads the parts of the list and how far each thread has filled the cells.
  Array<CellRange> ranges_;
  Array<std::uint32_t> entries_;
  Array<float> scaled_planes_;
  float scale_ = 1.0F;
  std::vector<Part> parts_;
  Array<std::uint32_t> cursors_;

  bool limited_ = false;  ///< M was lowered
  AllocationCount allocations_;
  std::uint64_t triangle_box_tests_ = 0;
};

/// What the class promises: the most cells that the boxes of so many triangles may touch, and the
/// cells per axis that a grid begins with.
std::uint64_t grid_reference_limit(const GridSettings& settings, std::uint64_t triangles);
std::uint32_t grid_cells_per_axis(const GridSettings& settings, std::uint64_t triangles);

/// Writes all cells of a range to `out`, the first one marked, and returns how many there are. May
/// write up to 8 values past them.
std::size_t list_range(const GridLayout& layout, CellRange range, std::uint32_t first_mark,
                       std::uint32_t* out);

}  // namespace encore::accel
