#include "accel/wide/wide_codes.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <utility>

namespace encore::accel {

namespace {

constexpr std::uint32_t kCodeBits = 32;
constexpr std::uint32_t kMostAxisBits = 24;
constexpr std::uint32_t kLeaf = WideTopology::kLargestLeaf;

/// A run of equal codes.
class Run {
 public:
  Run(WideBuildRun& run, WidePlace place)
      : run_(run),
        old_(run.memory.keys[0].data() + place.node),
        fine_(run.memory.keys[1].data() + place.node),
        count_(place.block) {}

  void refine() {
    WideBox centers;
    run_.kernels.centers(run_.triangles.data(), old_, count_, run_.unit, centers);
    const float upper[3] = {-centers.ends[4], -centers.ends[5], -centers.ends[6]};
    set_morton(morton_, run_.unit, centers.ends, upper);
    run_.kernels.refine(run_.triangles.data(), old_, count_, morton_, fine_);
    const std::uint64_t code = old_[0] >> 32 << 32;
    sort();
    for (std::uint32_t i = 0; i < count_; ++i) old_[i] = code | (fine_[i] & 0xFFFFFFFFU);
  }

 private:
  void sort() {
    if (count_ < 256) {
      std::sort(fine_, fine_ + count_);
      return;
    }
    for (int shift = 32; shift < 64; shift += 16) {
      pass(fine_, old_, shift);
      pass(old_, fine_, shift + 8);
    }
  }

  void pass(const std::uint64_t* from, std::uint64_t* to, int shift) const {
    std::uint32_t next[256] = {};
    for (std::uint32_t i = 0; i < count_; ++i) ++next[from[i] >> shift & 255U];
    std::uint32_t sum = 0;
    for (std::uint32_t& place : next) sum += std::exchange(place, sum);
    for (std::uint32_t i = 0; i < count_; ++i) to[next[from[i] >> shift & 255U]++] = from[i];
  }

  WideBuildRun& run_;
  std::uint64_t* old_;
  std::uint64_t* fine_;
  std::uint32_t count_;
  WideMorton morton_;
};

/// Whether any leaf's worth of triangles and one more have the same code.
bool any_run(WideBuildRun& run) {
  const std::uint64_t* const keys = run.memory.keys[0].data();
  const std::size_t count = run.triangles.size();
  if (count <= kLeaf) return false;
  std::atomic<std::uint32_t> runs = 0;
  run.workers.for_parts(count - kLeaf, 4 * kWidePart, [&](std::size_t begin, std::size_t end) {
    std::uint32_t found = 0;
    for (std::size_t i = begin; i < end; ++i) {
      found += (keys[i] ^ keys[i + kLeaf]) >> 32 == 0 ? 1U : 0U;
    }
    runs.fetch_add(found, std::memory_order_relaxed);
  });
  return runs.load(std::memory_order_relaxed) > 0;
}

}  // namespace

void set_morton(WideMorton& morton, float unit, const float* lower, const float* upper) {
  morton.unit = unit;
  std::uint32_t bits[3] = {0, 0, 0};
  float cell[3];
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    morton.mask[axis] = 0;
    cell[axis] = upper[axis] - lower[axis];
  }
  for (std::uint32_t bit = kCodeBits; bit-- > 0;) {
    const std::uint32_t longest =
        cell[0] >= cell[1] ? (cell[0] >= cell[2] ? 0 : 2) : (cell[1] >= cell[2] ? 1 : 2);
    if (!(cell[longest] > 0x1p-100F)) break;
    morton.mask[longest] |= std::uint32_t{1} << bit;
    cell[longest] = ++bits[longest] == kMostAxisBits ? 0.0F : 0.5F * cell[longest];
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto cells = static_cast<float>(std::uint32_t{1} << bits[axis]);
    morton.first[axis] = lower[axis];
    morton.scale[axis] = bits[axis] > 0 ? cells / (upper[axis] - lower[axis]) : 0.0F;
    morton.most[axis] = cells - 1.0F;
  }
  morton.first[3] = morton.scale[3] = morton.most[3] = 0.0F;
}

void spread_morton(WideMorton& morton) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int byte = 0; byte < 3; ++byte) std::fill_n(morton.spread[axis][byte], 256, 0U);
    std::uint32_t place_bit = 0;
    for (std::uint32_t bit = 0; bit < kCodeBits; ++bit) {
      if ((morton.mask[axis] >> bit & 1U) == 0) continue;
      for (std::uint32_t value = 0; value < 256; ++value) {
        if ((value >> (place_bit % 8) & 1U) != 0) {
          morton.spread[axis][place_bit / 8][value] |= std::uint32_t{1} << bit;
        }
      }
      ++place_bit;
    }
  }
}

void refine_wide_keys(WideBuildRun& run) {
  if (!any_run(run)) return;
  const std::uint64_t* const keys = run.memory.keys[0].data();
  const auto count = static_cast<std::uint32_t>(run.triangles.size());
  Array<WidePlace>& runs = run.memory.runs;
  runs.reset(0, run.mode, run.allocations);
  for (std::uint32_t begin = 0, end = 0; begin < count; begin = end) {
    for (end = begin + 1; end < count && (keys[begin] ^ keys[end]) >> 32 == 0;) ++end;
    if (end - begin <= kLeaf) continue;
    runs.grow(runs.size() + 1, run.allocations);
    runs[runs.size() - 1] = {begin, end - begin};
  }
  constexpr std::size_t kTogether = 16;
  run.workers.for_parts(runs.size(), kTogether, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) Run(run, runs[i]).refine();
  });
}

}  // namespace encore::accel
