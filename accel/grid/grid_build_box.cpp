#include "accel/grid/grid.h"

namespace encore::accel {

std::size_t list_range(const GridLayout& layout, CellRange range, std::uint32_t first_mark,
                       std::uint32_t* out) {
  const std::uint32_t row = layout.stride(1);
  const std::uint32_t slice = layout.stride(2);
  const std::uint32_t first = range.first(0) + row * range.first(1) + slice * range.first(2);
  const std::uint32_t sx = range.span(0);
  const std::uint32_t sy = range.span(1);
  const std::uint32_t sz = range.span(2);
  std::size_t n = 0;

  if (range.small()) {
    // Nearly all triangles of a dense mesh: write all eight cells, each over the last one unless
    // that was in the range, so that there is nothing for the processor to mispredict.
    out[n] = first;
    n += 1;
    out[n] = first + 1;
    n += sx;
    out[n] = first + row;
    n += sy;
    out[n] = first + row + 1;
    n += sx & sy;
    out[n] = first + slice;
    n += sz;
    out[n] = first + slice + 1;
    n += sx & sz;
    out[n] = first + slice + row;
    n += sy & sz;
    out[n] = first + slice + row + 1;
    n += sx & sy & sz;
  } else {
    for (std::uint32_t z = 0; z <= sz; ++z) {
      for (std::uint32_t y = 0; y <= sy; ++y) {
        const std::uint32_t start = first + slice * z + row * y;
        for (std::uint32_t x = 0; x <= sx; ++x) out[n++] = start + x;
      }
    }
  }
  out[0] |= first_mark;
  return n;
}

// grid-box: a triangle goes into every cell of its bounds.
std::size_t Grid::list_box(std::size_t begin, std::size_t end, std::uint32_t* out) const {
  std::size_t n = 0;
  for (const CellRange range : ranges_.span().subspan(begin, end - begin)) {
    n += list_range(layout_, range, kFirstOfTriangle, out + n);
  }
  return n;
}

}  // namespace encore::accel
