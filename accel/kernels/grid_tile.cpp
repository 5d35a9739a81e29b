// Grids, rectangles of rays in packets of 64.
#include "accel/grid/grid_tile.h"

#include "accel/kernels/tile_packets.h"

namespace encore::accel::ENCORE_ISA {

const GridTileKernels& grid_tile_kernels_here();

namespace {

static_assert(kPacketRays == 64);

/// Slice by slice along the frustum's axis.
template <class Tile>
class GridTrace {
 public:
  static constexpr bool kKeepSign = false;

  GridTrace(const GridTileView& view, Tile& tile)
      : view_(view), tile_(tile), w_(tile.frustums().axis[0]), down_(tile.frustums().down) {
    const PacketFrustums& of = tile.frustums();
    near_origin_ = lane(of.whole.near_origin);
    far_origin_ = lane(of.whole.far_origin);
    begin_ = lane(of.whole.begin);
    for (int k = 0; k < 4; ++k) {
      origin_[k] = lane(of.whole.origin[k]);
      slope_[k] = lane(of.whole.slope[k]);
    }
    const std::uint32_t strides[3] = {1, view.size[0], view.size[0] * view.size[1]};
    for (int k = 0; k < 3; ++k) stride_[k] = strides[of.axis[k]];
    for (Seen& seen : seen_) seen = {scene::kNoHit, 0};
  }

  bool run() {
    const float* const planes = view_.planes[w_];
    const std::uint32_t size = view_.size[w_];
    for (std::uint32_t step = 0; step < size; ++step) {
      const std::uint32_t slice = down_ ? size - 1 - step : step;
      const float near = down_ ? -planes[slice + 1] : planes[slice];
      const float far = down_ ? planes[slice] : -planes[slice + 1];
      const float ahead = (near - near_origin_) * kNarrow;
      const float enter = ahead > begin_ ? ahead : begin_;
      if (enter > tile_.limit()) return true;
      const float behind = -((far - far_origin_) * kWiden);
      const float leave = behind < tile_.limit() ? behind : tile_.limit();
      if (leave < enter) continue;
      for (int k = 0; k < 2; ++k) {
        if (!find_cells(k, enter, leave)) return false;
      }
      visit_slice(slice);
      if (tile_.scattered()) return false;
    }
    return true;
  }

 private:
  /// Which rays have been held against a triangle.
  struct Seen {
    std::uint32_t triangle;
    std::uint64_t rays;
  };
  static constexpr std::uint32_t kSeen = 64;

  [[gnu::always_inline]] static float lane(const Floats<8>& all) {
    alignas(32) float lanes[8];
    all.store(lanes);
    return lanes[0];
  }

  /// The cells along u or v that the frustum may overlap between two distances, by the comparisons
  /// of Frustum::meets(). False where those are of no use. They are near the last slice's.
  [[gnu::always_inline]] bool find_cells(int k, float enter, float leave) {
    const int axis = tile_.frustums().axis[1 + k];
    const float* const planes = view_.planes[axis];
    const std::uint32_t size = view_.size[axis];
    const auto widest = [&](int side) {
      const float a = slope_[side] * enter, b = slope_[side] * leave;
      return a > b ? a : b;
    };
    const float high = widest(2 * k), low = widest(2 * k + 1);
    if (!(high == high && low == low)) return false;
    const float high_origin = origin_[2 * k], low_origin = origin_[2 * k + 1];
    const auto ends_before = [&](std::uint32_t cell) {
      return -planes[cell + 1] - low_origin > low;
    };
    const auto begins_behind = [&](std::uint32_t cell) {
      return planes[cell] - high_origin > high;
    };
    std::uint32_t first = first_[k], end = end_[k];
    while (first > 0 && !ends_before(first - 1)) --first;
    while (first < size && ends_before(first)) ++first;
    while (end < size && !begins_behind(end)) ++end;
    while (end > 0 && begins_behind(end - 1)) --end;
    first_[k] = first;
    end_[k] = end;
    return true;
  }

  [[gnu::always_inline]] void visit_slice(std::uint32_t slice) {
    for (std::uint32_t v = first_[1]; v < end_[1]; ++v) {
      const std::uint32_t row = slice * stride_[0] + v * stride_[2];
      for (std::uint32_t u = first_[0]; u < end_[0]; ++u) {
        const std::uint32_t cell = row + u * stride_[1];
        const std::uint32_t first = view_.starts[cell];
        const std::uint32_t end = view_.starts[cell + 1];
        if (first == end) continue;
        const std::uint64_t rays = rays_in(slice, u, v);
        if (rays != 0) test(view_.references + first, end - first, rays);
      }
    }
  }

  /// Which groups may meet a box before their limits.
  [[gnu::always_inline]] unsigned groups_at(const float* low, const float* high) const {
    const PacketFrustums& frustums = tile_.frustums();
    const auto row = [&](int k) {
      const int at = frustums.rows[k];
      const bool upper = at % 16 != 0;
      const float plane = (upper ? high : low)[at / 16];
      return Floats<kGroups>::all(upper ? -plane : plane);
    };
    Floats<kGroups> enter;
    return frustums.groups.meets(row, enter).bits();
  }
  [[gnu::always_inline]] unsigned groups_at(const scene::Triangle& triangle) const {
    const auto* const corners = reinterpret_cast<const float*>(&triangle);
    const Floats<4> a = Floats<4>::load(corners), b = Floats<4>::load(corners + 4);
    const Floats<4> c = Floats<4>::load(corners + 8);
    alignas(16) float low[4], high[4];
    min(min(a, b), c).store(low);
    max(max(a, b), c).store(high);
    return groups_at(low, high);
  }

  /// Which rays meet a cell before their best hits.
  [[gnu::always_inline]] std::uint64_t rays_in(std::uint32_t slice, std::uint32_t u,
                                               std::uint32_t v) const {
    const PacketFrustums& frustums = tile_.frustums();
    float ends[2][3];
    const std::uint32_t place[3] = {slice, u, v};
    for (int k = 0; k < 3; ++k) {
      const float* const plane = view_.planes[frustums.axis[k]] + place[k];
      ends[0][frustums.axis[k]] = plane[0];
      ends[1][frustums.axis[k]] = plane[1];
    }
    std::uint64_t rays = 0;
    for (unsigned groups = groups_at(ends[0], ends[1]); groups != 0; groups &= groups - 1) {
      const int group = __builtin_ctz(groups);
      rays |= std::uint64_t{tile_.meets_box(group, ends[0], ends[1]).bits()} << (group * kLanes);
    }
    return rays;
  }

  /// Holds a cell's triangles against those of its rays that have not met them in another cell.
  [[gnu::always_inline]] void test(const std::uint32_t* references, std::uint32_t count,
                                   std::uint64_t rays) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t triangle = references[i];
      Seen& seen = seen_[triangle % kSeen];
      if (seen.triangle != triangle) seen = {triangle, 0};
      const std::uint64_t left = rays & ~seen.rays;
      if (left == 0) continue;
      seen.rays |= left;
      // Möller-Trumbore may find hits outside of a triangle's box, and single rays do not look.
      unsigned groups = ~0U;
      if constexpr (Tile::Tester::kFilter) groups = groups_at(tile_.triangle(triangle));
      Mask<kLanes> active[kGroups];
      unsigned any = 0;
      for (int group = 0; group < kGroups; ++group) {
        active[group] = Mask<kLanes>::of_bits(0);
        if ((groups >> group & 1U) == 0) continue;
        constexpr std::uint64_t kAll = (std::uint64_t{1} << kLanes) - 1;
        active[group] =
            Mask<kLanes>::of_bits(static_cast<unsigned>(left >> (group * kLanes) & kAll));
        any |= active[group].bits();
      }
      if (any != 0) tile_.test(triangle, active);
    }
  }

  const GridTileView& view_;
  Tile& tile_;
  int w_;
  bool down_;
  float near_origin_, far_origin_, begin_;
  float origin_[4], slope_[4];
  std::uint32_t stride_[3];  ///< of w, u, v
  std::uint32_t first_[2] = {0, 0}, end_[2] = {0, 0};
  Seen seen_[kSeen];
};

template <int kMode, bool kAnyHit>
void trace(const GridTileView& view, const TileJob& job) {
  trace_tile<GridTrace, kMode, kAnyHit>(view, job);
}

}  // namespace

const GridTileKernels& grid_tile_kernels_here() {
  static constexpr GridTileKernels kernels{{trace<0, false>, trace<1, false>, trace<2, false>},
                                           {trace<0, true>, trace<1, true>, trace<2, true>}};
  return kernels;
}

}  // namespace encore::accel::ENCORE_ISA
