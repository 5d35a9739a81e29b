// What a grid's build does with several threads. The grid is the same: bounds and sums do not
// depend on how they are cut, and the threads' chunks of the list follow each other within a cell
// as they do in the list.
#include "accel/grid/grid.h"
#include "accel/grid/prefetch.h"
#include "accel/large_pages.h"
#include "accel/shared_meter.h"

#include <algorithm>

namespace encore::accel {

namespace {

// Each thread has counters of its own for all cells, which are memory.
constexpr std::size_t kMostChunks = 16;
constexpr std::size_t kCells = 1U << 14U;  ///< whose counters are summed up at a time

}  // namespace

Bounds Grid::find_bounds(BuildMeter& meter, const Workers& workers) const {
  Bounds bounds;
  if (!workers.parallel()) {
    meter.pass(triangles_.size(), kBoundsDone, [&](std::size_t begin, std::size_t end) {
      bounds = bounds_of_triangles(begin, end, bounds);
    });
    return bounds;
  }
  SharedMeter shared(meter, kBoundsDone, double(triangles_.size()));
  std::vector<Bounds> of_parts((triangles_.size() + kPart - 1) / kPart);
  workers.for_parts(triangles_.size(), kPart, [&](std::size_t begin, std::size_t end) {
    of_parts[begin / kPart] = bounds_of_triangles(begin, end, Bounds{});
    shared.add(double(end - begin));
  });
  for (const Bounds& part : of_parts) bounds.extend(part);
  return bounds;
}

// Returns how many cells all ranges hold together.
std::uint64_t Grid::find_ranges(BuildMeter& meter, const Workers& workers) {
  const std::size_t count = triangles_.size();
  // Where there is more than one round, progress stays until the last one is over.
  const double until = meter.done() > kBoundsDone ? meter.done() : 0.5 * kRangesDone;
  std::uint64_t entries = 0;
  if (!workers.parallel()) {
    meter.pass(count, until,
               [&](std::size_t begin, std::size_t end) { entries += find_ranges(begin, end); });
    return entries;
  }
  SharedMeter shared(meter, until, double(count));
  parts_.resize((count + kPart - 1) / kPart);
  workers.for_parts(count, kPart, [&](std::size_t begin, std::size_t end) {
    parts_[begin / kPart].most = find_ranges(begin, end);
    shared.add(double(end - begin));
  });
  for (const Part& part : parts_) entries += part.most;
  return entries;
}

// Every part lists its entries from where they would begin if all before it had as many as their
// triangles' bounds touch cells.
void Grid::list_entries_together(BuildMeter& meter, const Workers& workers) {
  std::size_t begin = 0;
  for (Part& part : parts_) {
    part.begin = begin;
    begin += part.most + kEntryPadding;
  }
  SharedMeter shared(meter, kListDone, double(begin));
  std::vector<std::uint64_t> tests(parts_.size(), 0);
  workers.for_parts(triangles_.size(), kPart, [&](std::size_t first, std::size_t last) {
    Part& part = parts_[first / kPart];
    part.count = list(first, last, entries_.data() + part.begin, tests[first / kPart]);
    shared.add(double(part.most + kEntryPadding));
  });
  for (const std::uint64_t n : tests) triangle_box_tests_ += n;
}

// A counting sort whose list is cut into chunks of whole parts, one a thread.
void Grid::insert_entries_together(BuildMeter& meter, const Workers& workers) {
  std::size_t count = 0;
  for (const Part& part : parts_) count += part.count;
  references_.reset(count, mode_, allocations_);
  ask_for_large_pages(references_.bytes());
  const std::size_t chunks = std::min(static_cast<std::size_t>(workers.threads()), kMostChunks);
  const std::size_t cells = layout_.cell_count();
  cursors_.reset(chunks * cells, mode_, allocations_);

  // The first part of each chunk: the chunks have about as many entries each.
  std::vector<std::size_t> first(chunks + 1, parts_.size());
  std::size_t before = 0;
  for (std::size_t p = 0, chunk = 0; p < parts_.size(); ++p) {
    for (; chunk < chunks && before * chunks >= chunk * count; ++chunk) first[chunk] = p;
    before += parts_[p].count;
  }

  const std::uint32_t* const entries = entries_.data();
  SharedMeter counting(meter, kCountDone, double(count));
  workers.for_parts(chunks, 1, [&](std::size_t chunk, std::size_t) {
    std::uint32_t* const counts = cursors_.data() + chunk * cells;
    std::fill(counts, counts + cells, 0U);
    for (std::size_t p = first[chunk]; p < first[chunk + 1]; ++p) {
      const std::uint32_t* const list = entries + parts_[p].begin;
      for (std::size_t i = 0; i < parts_[p].count; ++i) ++counts[list[i] & ~kFirstOfTriangle];
      counting.add(double(parts_[p].count));
    }
  });
  sum_up_counts(chunks, meter, workers);

  std::uint32_t* const references = references_.data();
  SharedMeter inserting(meter, 1.0, double(count));
  workers.for_parts(chunks, 1, [&](std::size_t chunk, std::size_t) {
    std::uint32_t* const next = cursors_.data() + chunk * cells;
    for (std::size_t p = first[chunk]; p < first[chunk + 1]; ++p) {
      const std::uint32_t* const list = entries + parts_[p].begin;
      auto triangle = static_cast<std::uint32_t>(p * kPart) - 1U;
      for (std::size_t i = 0; i < parts_[p].count; ++i) {
        triangle += list[i] >> 31;
        references[next[list[i] & ~kFirstOfTriangle]++] = triangle;
      }
      inserting.add(double(parts_[p].count));
    }
  });
}

// Turns the chunks' counts into where each of them goes on in every cell, and writes the cells'
// starts.
void Grid::sum_up_counts(std::size_t chunks, BuildMeter& meter, const Workers& workers) {
  const std::size_t cells = layout_.cell_count();
  std::uint32_t* const counts = cursors_.data();
  std::vector<std::uint32_t> block_starts((cells + kCells - 1) / kCells + 1, 0U);
  workers.for_parts(cells, kCells, [&](std::size_t begin, std::size_t end) {
    std::uint32_t sum = 0;
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      for (std::size_t c = begin; c < end; ++c) sum += counts[chunk * cells + c];
    }
    block_starts[begin / kCells + 1] = sum;
  });
  for (std::size_t b = 1; b < block_starts.size(); ++b) block_starts[b] += block_starts[b - 1];
  meter.report(0.5 * (kCountDone + kStartsDone));
  workers.for_parts(cells, kCells, [&](std::size_t begin, std::size_t end) {
    std::uint32_t running = block_starts[begin / kCells];
    for (std::size_t c = begin; c < end; ++c) {
      cell_starts_[c] = running;
      for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        const std::uint32_t n = counts[chunk * cells + c];
        counts[chunk * cells + c] = running;
        running += n;
      }
    }
  });
  cell_starts_[cells] = block_starts.back();
  meter.report(kStartsDone);
}

}  // namespace encore::accel
