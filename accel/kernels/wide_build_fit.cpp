#include "accel/kernels/wide_build_boxes.h"
#include "accel/kernels/wide_build_tables.h"

namespace encore::accel::ENCORE_ISA {

namespace {

/// Blocks between what is fetched and what is worked on. Nodes go from the last to the first.
constexpr std::uint32_t kAhead = 32;

/// Lower and upper ends of a box.
struct Ends {
  Floats<4> lower, upper;
};

inline void transpose(const Floats<4>* rows, float (*axes)[4]) {
#if defined(__SSE4_2__)
  const __m128 xy01 = _mm_unpacklo_ps(rows[0].v, rows[1].v);
  const __m128 xy23 = _mm_unpacklo_ps(rows[2].v, rows[3].v);
  const __m128 z01 = _mm_unpackhi_ps(rows[0].v, rows[1].v);
  const __m128 z23 = _mm_unpackhi_ps(rows[2].v, rows[3].v);
  _mm_storeu_ps(axes[0], _mm_movelh_ps(xy01, xy23));
  _mm_storeu_ps(axes[1], _mm_movehl_ps(xy23, xy01));
  _mm_storeu_ps(axes[2], _mm_movelh_ps(z01, z23));
#else
  for (int axis = 0; axis < 3; ++axis) {
    for (int lane = 0; lane < 4; ++lane) axes[axis][lane] = rows[lane].lane[axis];
  }
#endif
}

/// Copies four triangles' corners into their block; returns their box.
inline Ends fill_block(const scene::Triangle* triangles, const std::uint32_t* ids,
                       TriangleBlock& block) {
  Ends box;
  for (int corner = 0; corner < 3; ++corner) {
    Floats<4> rows[4];
    for (int lane = 0; lane < 4; ++lane) {
      rows[lane] =
          Floats<4>::load(reinterpret_cast<const float*>(triangles + ids[lane]) + 4 * corner);
    }
    transpose(rows, block.corner[corner]);
    const Floats<4> lower = min(min(rows[0], rows[1]), min(rows[2], rows[3]));
    const Floats<4> upper = max(max(rows[0], rows[1]), max(rows[2], rows[3]));
    box.lower = corner == 0 ? lower : min(box.lower, lower);
    box.upper = corner == 0 ? upper : max(box.upper, upper);
  }
  return box;
}

/// The least of 16 numbers' halves.
inline void least_of_halves(const float* ends, float* low, float* high) {
  float a[4], b[4];
  min(Floats<4>::load(ends), Floats<4>::load(ends + 4)).store(a);
  min(Floats<4>::load(ends + 8), Floats<4>::load(ends + 12)).store(b);
  const auto least = [](const float* v) {
    const float x = v[0] < v[1] ? v[0] : v[1], y = v[2] < v[3] ? v[2] : v[3];
    return x < y ? x : y;
  };
  *low = least(a);
  *high = least(b);
}

/// Asks for the triangles of a block that comes later: one after the other they lie anywhere. Into
/// the second cache, as prefetch_rows() does.
inline void fetch_block(const scene::Triangle* triangles, const std::uint32_t* ids) {
  constexpr int kRead = 0, kSecondCache = 2;
  for (int lane = 0; lane < 4; ++lane) {
    const auto* const triangle = reinterpret_cast<const char*>(triangles + ids[lane]);
    __builtin_prefetch(triangle, kRead, kSecondCache);
    __builtin_prefetch(triangle + sizeof(scene::Triangle) - 1, kRead, kSecondCache);
  }
}

}  // namespace

void build_fit(const scene::Triangle* triangles, const std::uint32_t* ids, TriangleBlock* blocks,
               gpu::WideNode* nodes, const WideFit& fit) {
  const std::uint32_t fetched = fit.first_block + kAhead;
  const bool keep_leaves = fit.keep_leaves;
  for (std::size_t i = fit.end; i-- > fit.begin;) {
    gpu::WideNode& node = nodes[i];
    for (int k = 0; k < 8; ++k) {
      const std::uint32_t child = node.child[k];
      if (child == WideChild::kNoChild) break;  // empty places come last
      if (!WideChild::is_leaf(child)) {
        for (int axis = 0; axis < 3; ++axis) {
          least_of_halves(nodes[child].bounds + 16 * axis, node.bounds + 16 * axis + k,
                          node.bounds + 16 * axis + 8 + k);
        }
        continue;
      }
      const std::uint32_t first = WideChild::first_block(child), count = WideChild::blocks(child);
      if (first >= fetched) fetch_block(triangles, ids + 4 * std::size_t{first - kAhead});
      Ends box = fill_block(triangles, ids + 4 * std::size_t{first}, blocks[first]);
      for (std::uint32_t b = first + 1; b < first + count; ++b) {
        const Ends more = fill_block(triangles, ids + 4 * std::size_t{b}, blocks[b]);
        box = {min(box.lower, more.lower), max(box.upper, more.upper)};
      }
      if (keep_leaves) continue;
      float lower[4], upper[4];
      box.lower.store(lower);
      minus(box.upper).store(upper);
      for (int axis = 0; axis < 3; ++axis) {
        node.bounds[16 * axis + k] = lower[axis];
        node.bounds[16 * axis + 8 + k] = upper[axis];
      }
    }
  }
}

const WideBuildKernels& build_kernels() {
  static constexpr WideBuildKernels kKernels{
      build_bounds, build_items,       build_clear,          build_bin,  build_merge,
      build_split,  build_part,        build_fit_items,      build_keys, build_centers,
      build_refine, build_sah_subtree, build_morton_subtree, build_fit};
  return kKernels;
}

}  // namespace encore::accel::ENCORE_ISA
