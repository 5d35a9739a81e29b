#include "accel/grid/grid.h"

#include "accel/grid/prefetch.h"
#include "accel/large_pages.h"
#include "shaders/shared/bindings.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace encore::accel {

namespace {

constexpr std::uint64_t kMostReferences = 0xFFFFFFFEU;

// The limits that the class comment promises.
std::uint64_t cell_limit(std::uint64_t triangles) {
  return (1U << 24) + 64 * triangles;
}
}  // namespace

std::uint64_t grid_reference_limit(const GridSettings& settings, std::uint64_t triangles) {
  const auto each = static_cast<std::uint64_t>(std::max(1, settings.most_references));
  return std::min<std::uint64_t>((1U << 22) + each * triangles, kMostReferences);
}

std::uint32_t grid_cells_per_axis(const GridSettings& settings, std::uint64_t triangles) {
  const double automatic =
      std::round(static_cast<double>(settings.density) * std::cbrt(static_cast<double>(triangles)));
  const double wanted = settings.cells_per_axis > 0 ? settings.cells_per_axis : automatic;
  // The comparison also turns a density that is not a number into one cell.
  if (!(wanted > 1.0)) return 1;
  auto cells = static_cast<std::uint32_t>(
      std::min(wanted, static_cast<double>(CellRange::kMaxCellsPerAxis)));
  while (std::uint64_t{cells} * cells * cells > cell_limit(triangles)) --cells;
  return cells;
}

void Grid::build(std::span<const Triangle> triangles) {
  if (triangles.size() > kMostReferences) {
    throw std::length_error("a grid holds at most 2^32 - 2 triangles");
  }
  mark_changed();
  BuildMeter meter(build_watch());
  Workers workers(build_threads(), triangles.size());
  try {
    workers.run([&] { build_over(triangles, meter, workers); });
  } catch (...) {
    references_.shrink(0);
    BuildMeter unwatched(nullptr);
    build_over({}, unwatched, Workers(1));
    throw;
  }
  meter.finish();
}

void Grid::build_over(std::span<const Triangle> triangles, BuildMeter& meter,
                      const Workers& workers) {
  triangles_ = triangles;
  allocations_ = {};
  triangle_box_tests_ = 0;
  choose_cells(find_bounds(meter, workers), meter, workers);

  // First pass: which cells each triangle goes into, and how many references each cell gets. Then
  // memory for exactly these, and the second pass.
  cell_starts_.reset(std::size_t{layout_.cell_count()} + 1, mode_, allocations_);
  prepare_list();
  if (workers.parallel()) {
    list_entries_together(meter, workers);
    insert_entries_together(meter, workers);
  } else {
    const std::size_t count = list_entries(meter);
    meter.report(kListDone);
    references_.reset(count, mode_, allocations_);
    ask_for_large_pages(references_.bytes());
    insert_entries(count, meter);
  }

  if (mode_ == MemoryMode::fresh) {
    ranges_.release();
    entries_.release();
    scaled_planes_.release();
    cursors_.release();
  }
}

Bounds Grid::bounds_of_triangles(std::size_t begin, std::size_t end, Bounds bounds) const {
  for (std::size_t i = begin; i < end; ++i) {
    prefetch_ahead(triangles_, i);
    bounds.extend(scene::bounds_of(triangles_[i]));
  }
  return bounds;
}

// Sets up the layout and every triangle's range, with as many cells as the limits allow.
void Grid::choose_cells(const Bounds& bounds, BuildMeter& meter, const Workers& workers) {
  const std::uint64_t limit = grid_reference_limit(settings_, triangles_.size());
  limited_ = false;
  ranges_.reset(triangles_.size(), mode_, allocations_);
  ask_for_large_pages(ranges_.bytes());
  std::uint32_t cells = grid_cells_per_axis(settings_, triangles_.size());
  std::uint64_t entries = 0;
  while (true) {
    layout_.divide(bounds, cells, mode_, allocations_);
    entries = find_ranges(meter, workers);
    if (entries <= limit || cells == 1) break;
    limited_ = true;
    // Volumes shrink about with the cube of the resolution, but never by less than a tenth, so few
    // rounds are needed. With one cell each triangle has one reference, which is within the limit.
    const double ratio = std::cbrt(static_cast<double>(limit) / static_cast<double>(entries));
    cells = std::max(1U, static_cast<std::uint32_t>(cells * std::min(ratio, 0.9)));
  }
  meter.report(kRangesDone);
  const std::size_t parts = (triangles_.size() + kPart - 1) / kPart;
  entries_.reset(entries + std::max<std::size_t>(parts, 1) * kEntryPadding, mode_, allocations_);
  if (kind_ == StructureKind::grid_box) ask_for_large_pages(entries_.bytes());
}

// Returns how many cells the ranges of these triangles hold together.
std::uint64_t Grid::find_ranges(std::size_t begin, std::size_t end) {
  std::uint64_t entries = 0;
  for (std::size_t i = begin; i < end; ++i) {
    prefetch_ahead(triangles_, i);
    const CellRange range = layout_.range_of(scene::bounds_of(triangles_[i]));
    entries += range.cells();
    ranges_[i] = range;
  }
  return entries;
}

std::size_t Grid::list(std::size_t begin, std::size_t end, std::uint32_t* out,
                       std::uint64_t& tests) const {
  return kind_ == StructureKind::grid_exact ? list_exact(begin, end, out, tests)
                                            : list_box(begin, end, out);
}

std::size_t Grid::list_entries(BuildMeter& meter) {
  const std::size_t count = ranges_.size();
  const double from = meter.done();
  // A few triangles at a time: each may have as many entries as there are cells.
  constexpr std::size_t kTriangles = 256;
  const std::size_t part = meter.watched() ? kTriangles : std::max<std::size_t>(count, 1);
  std::size_t n = 0;
  std::size_t next_call = 0;
  for (std::size_t begin = 0; begin < count; begin += part) {
    if (n >= next_call) next_call = meter.next_call(begin, count, n, from, kListDone);
    n += list(begin, std::min(begin + part, count), entries_.data() + n, triangle_box_tests_);
  }
  return n;
}

void Grid::insert_entries(std::size_t count, BuildMeter& meter) {
  // Count into the slot after each cell's own.
  std::uint32_t* const starts = cell_starts_.data();
  meter.pass(cell_starts_.size(), [&](std::size_t begin, std::size_t end) {
    std::fill(starts + begin, starts + end, 0U);
  });
  const std::uint32_t* const entries = entries_.data();
  meter.pass(count, kCountDone, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++starts[(entries[i] & ~kFirstOfTriangle) + 1];
  });

  // Turn counts into starts; each cell's start now stands in the slot after its own.
  std::uint32_t running = 0;
  meter.pass(cell_starts_.size() - 1, kStartsDone, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin + 1; c <= end; ++c) {
      const std::uint32_t n = starts[c];
      starts[c] = running;
      running += n;
    }
  });

  // Insert. That slot moves on with every reference and ends where the next cell starts, which is
  // what it has to hold. Triangles come in ascending order, so each cell's are sorted.
  std::uint32_t* const references = references_.data();
  std::uint32_t triangle = 0xFFFFFFFFU;
  meter.pass(count, 1.0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      triangle += entries[i] >> 31;
      references[starts[(entries[i] & ~kFirstOfTriangle) + 1]++] = triangle;
    }
  });
}

std::span<const std::uint32_t> Grid::cell(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
  const std::uint32_t c = x + layout_.stride(1) * y + layout_.stride(2) * z;
  return references_.span().subspan(cell_starts_[c], cell_starts_[c + 1] - cell_starts_[c]);
}

BuildStats Grid::stats() const {
  BuildStats stats;
  stats.triangles = triangles_.size();
  stats.allocations = allocations_.requests;
  stats.allocated_bytes = allocations_.bytes;
  stats.triangle_box_tests = triangle_box_tests_;
  if (cell_starts_.empty()) return stats;

  stats.nodes = layout_.cell_count();
  stats.grid_size = layout_.sizes();
  stats.references = references_.size();
  stats.bytes = cell_starts_.bytes().size() + references_.bytes().size() +
                layout_.all_planes().bytes().size();
  stats.limited = limited_;
  // A ray enters a cell with the probability area(cell) / area(grid); it then pays one step and
  // one test for each reference. Without area every ray meets everything.
  double cost = 0.0;
  for (std::uint32_t z = 0; z < layout_.size(2); ++z) {
    for (std::uint32_t y = 0; y < layout_.size(1); ++y) {
      for (std::uint32_t x = 0; x < layout_.size(0); ++x) {
        const std::uint64_t n = cell(x, y, z).size();
        if (n > 0) ++stats.leaves;
        stats.largest_leaf = std::max(stats.largest_leaf, n);
        cost += layout_.cell_bounds(x, y, z).area() * static_cast<double>(1 + n);
      }
    }
  }
  const double area = layout_.bounds().area();
  stats.sah_cost = area > 0.0 ? cost / area : static_cast<double>(stats.references);
  return stats;
}

GpuBuffers Grid::gpu_buffers() const {
  return {{ENCORE_BINDING_REFERENCES, references_.bytes()},
          {ENCORE_BINDING_CELL_STARTS, cell_starts_.bytes()},
          {ENCORE_BINDING_CELL_PLANES, layout_.all_planes().bytes()}};
}

gpu::StructureParameters Grid::gpu_parameters() const {
  gpu::StructureParameters parameters{};
  if (references_.empty()) return parameters;
  const Bounds bounds = layout_.bounds();
  parameters.min = bounds.min;
  parameters.max = bounds.max;
  parameters.references = static_cast<std::uint32_t>(references_.size());
  parameters.cells = {layout_.size(0), layout_.size(1), layout_.size(2)};
  parameters.first_plane_y = layout_.size(0) + 1;
  parameters.first_plane_z = parameters.first_plane_y + layout_.size(1) + 1;
  parameters.smallest_gap = {layout_.smallest_gap(0), layout_.smallest_gap(1),
                             layout_.smallest_gap(2)};
  return parameters;
}

void Grid::visit(const std::function<bool(const NodeView&)>& visitor) const {
  if (references_.empty()) return;
  for (std::uint32_t z = 0; z < layout_.size(2); ++z) {
    for (std::uint32_t y = 0; y < layout_.size(1); ++y) {
      for (std::uint32_t x = 0; x < layout_.size(0); ++x) {
        const auto triangles = cell(x, y, z);
        if (triangles.empty()) continue;
        visitor(NodeView{.bounds = layout_.cell_bounds(x, y, z),
                         .leaf = true,
                         .triangles = triangles,
                         .place = x + layout_.stride(1) * y + layout_.stride(2) * z});
      }
    }
  }
}

}  // namespace encore::accel
