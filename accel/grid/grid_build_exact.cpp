#include "accel/grid/cell_overlap.h"
#include "accel/grid/grid.h"
#include "accel/grid/prefetch.h"
#include "accel/triangle_box.h"

#include <algorithm>
#include <cmath>

namespace encore::accel {

namespace {

using Index3 = std::array<std::uint32_t, 3>;

// A power of two that brings every coordinate to at most 4 (to 1..2 if it can), so that the test
// neither overflows nor underflows. Multiplying by it is exact.
float normalising_scale(const Bounds& bounds) {
  float largest = 0.0F;
  for (int axis = 0; axis < 3; ++axis) {
    largest = std::max({largest, std::fabs(bounds.min[axis]), std::fabs(bounds.max[axis])});
  }
  if (!(largest > 0.0F)) return 1.0F;
  return std::ldexp(1.0F, -std::clamp(std::ilogb(largest), -126, 126));
}

Float4 scaled(const glm::vec3& p, float scale) {
  return Float4{p.x, p.y, p.z, 0.0F} * scale;
}

// Lists the cells that one triangle overlaps, by descending into blocks of 4^level cells an axis,
// 64 of them tested at a time.
class CellLister {
 public:
  CellLister(const GridLayout& layout, const std::array<const float*, 3>& planes, float scale)
      : layout_(layout), planes_(planes), scale_(scale) {}

  // Appends the entries of a triangle to `out` and returns how many.
  std::size_t list(const Triangle& triangle, CellRange range, std::uint32_t* out) {
    Index3 end;
    Index3 first;
    std::array<bool, 3> spans;
    Float4 extent{};
    std::uint32_t longest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      first[a] = range.first(axis);
      end[a] = first[a] + range.span(axis) + 1;
      spans[a] = range.span(axis) != 0;
      extent[axis] = planes_[a][end[a]] - planes_[a][first[a]];
      longest = std::max(longest, range.span(axis));
    }
    const CellOverlap overlap(
        {scaled(triangle.v0, scale_), scaled(triangle.v1, scale_), scaled(triangle.v2, scale_)},
        extent, spans);
    unsigned level = 0;
    while (longest >> (2 * level) >= 4) ++level;
    triangle_ = &triangle;
    out_ = out;
    descend(overlap, first, end, level);
    return static_cast<std::size_t>(out_ - out);
  }

  [[nodiscard]] std::uint64_t tests() const { return tests_; }

 private:
  // Tests the at most 4 x 4 x 4 blocks of [first, end). Recursion is at most five deep, as 4^5 is
  // the largest number of cells per axis.
  void descend(const CellOverlap& overlap, const Index3& first, const Index3& end, unsigned level) {
    const std::uint32_t block = 1U << (2 * level);
    Index3 count;
    std::array<BoxRow, 3> rows;
    for (std::size_t a = 0; a < 3; ++a) {
      count[a] = (end[a] - first[a] + block - 1) / block;
      for (std::uint32_t i = 0; i < 4; ++i) {
        // Boxes past the end repeat it; their results are not looked at.
        rows[a].low[i] = planes_[a][std::min(first[a] + i * block, end[a])];
        rows[a].high[i] = planes_[a][std::min(first[a] + (i + 1) * block, end[a])];
      }
    }
    tests_ += std::uint64_t{count[0]} * count[1] * count[2];
    std::uint64_t boxes = overlap.test(rows, count);
    for (; boxes != 0; boxes &= boxes - 1) {
      const auto box = static_cast<std::uint32_t>(__builtin_ctzll(boxes));
      const Index3 low{first[0] + (box & 3U) * block, first[1] + (box >> 2 & 3U) * block,
                       first[2] + (box >> 4) * block};
      if (level == 0) {
        emit(overlap, low);
      } else {
        const Index3 high{std::min(low[0] + block, end[0]), std::min(low[1] + block, end[1]),
                          std::min(low[2] + block, end[2])};
        descend(overlap, low, high, level - 1);
      }
    }
  }

  void emit(const CellOverlap& overlap, const Index3& c) {
    if (overlap.uncertain() && !overlaps(*triangle_, layout_.cell_bounds(c[0], c[1], c[2]))) return;
    *out_++ = c[0] + layout_.stride(1) * c[1] + layout_.stride(2) * c[2];
  }

  const GridLayout& layout_;
  const std::array<const float*, 3> planes_;
  const float scale_;
  const Triangle* triangle_ = nullptr;
  std::uint32_t* out_ = nullptr;
  std::uint64_t tests_ = 0;
};

}  // namespace

// What the exact test needs: planes brought to the size of about 1.
void Grid::prepare_list() {
  if (kind_ != StructureKind::grid_exact) return;
  scale_ = normalising_scale(layout_.bounds());
  scaled_planes_.reset(layout_.all_planes().size(), mode_, allocations_);
  for (std::size_t i = 0; i < scaled_planes_.size(); ++i) {
    scaled_planes_[i] = layout_.all_planes()[i] * scale_;
  }
}

// grid-exact: a triangle goes into the cells that it overlaps.
std::size_t Grid::list_exact(std::size_t begin, std::size_t end, std::uint32_t* out,
                             std::uint64_t& tests) const {
  std::array<const float*, 3> planes;
  for (int axis = 0; axis < 3; ++axis) {
    planes[static_cast<std::size_t>(axis)] =
        scaled_planes_.data() + (layout_.planes(axis) - layout_.all_planes().data());
  }
  CellLister lister(layout_, planes, scale_);
  std::size_t n = 0;
  for (std::size_t i = begin; i < end; ++i) {
    prefetch_ahead(triangles_, i);
    const CellRange range = ranges_[i];
    if (range.ambiguous()) {
      // A triangle is connected, so it passes through at least one cell of its range.
      const std::size_t added = lister.list(triangles_[i], range, out + n);
      out[n] |= kFirstOfTriangle;
      n += added;
    } else {
      // A single cell, or a straight line of cells: all of them are overlapped.
      n += list_range(layout_, range, kFirstOfTriangle, out + n);
    }
  }
  tests += lister.tests();
  return n;
}

}  // namespace encore::accel
