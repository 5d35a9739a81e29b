#include "accel/grid/cell_overlap.h"

#include "accel/tolerance.h"

namespace encore::accel {

namespace {

// Every sum below is off by at most 6 units of roundoff times the sum of its products' magnitudes
// (differences, products, sums, each rounded once); the plane's, whose normal is itself such a sum,
// by at most 10.
constexpr float kEdgeRounding = 8 * kUnitRoundoff;
constexpr float kPlaneRounding = 12 * kUnitRoundoff;
// Covers products that fall below the normal range; coordinates are scaled to about 1.
constexpr float kUnderflow = 0x1p-120F;

}  // namespace

CellOverlap::CellOverlap(const std::array<Float4, 3>& vertices, Float4 extent,
                         const std::array<bool, 3>& spans)
    : spans_(spans) {
  const std::array<Float4, 3> edge{vertices[1] - vertices[0], vertices[2] - vertices[1],
                                   vertices[0] - vertices[2]};
  // The normal's components are twice the areas of the three projections, with their orientation.
  const Float4 plus = next_axis(edge[0]) * next_axis(next_axis(edge[1]));
  const Float4 minus = next_axis(next_axis(edge[0])) * next_axis(edge[1]);
  const Float4 normal = plus - minus;
  const Float4 magnitude = abs4(plus) + abs4(minus);
  const Float4 area_error = kEdgeRounding * magnitude + kUnderflow;

  for (int axis = 0; axis < 3; ++axis) {
    const int u = axis == 2 ? 0 : axis + 1;
    const int w = axis == 0 ? 2 : axis - 1;
    if (!spans[static_cast<std::size_t>(u)] || !spans[static_cast<std::size_t>(w)]) continue;
    float sign = normal[axis] < 0 ? -1.0F : 1.0F;
    if (!(normal[axis] > area_error[axis] || -normal[axis] > area_error[axis])) {
      uncertain_ = true;
      sign = 0.0F;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const Float4 size = abs4(edge[i]);
      edges_[static_cast<std::size_t>(axis)][i] = {
          vertices[i][u], vertices[i][w], -sign * edge[i][w], sign * edge[i][u],
          kEdgeRounding * (size[u] * extent[w] + size[w] * extent[u]) + kUnderflow};
    }
  }
  const Float4 plane_error = kPlaneRounding * magnitude * extent;
  plane_slack_ = plane_error[0] + plane_error[1] + plane_error[2] + kUnderflow;
  v0_ = {vertices[0][0], vertices[0][1], vertices[0][2]};
  normal_ = {normal[0], normal[1], normal[2]};
}

// For each row of rectangles along u (one row for each of the w_count intervals along w): bit i is
// set if rectangle i may overlap the projected triangle.
inline std::array<unsigned, 4> CellOverlap::test_projection(int axis, const BoxRow& u_row,
                                                            const BoxRow& w_row,
                                                            std::uint32_t w_count) const {
  // The corner farthest inside an edge decides, and each axis contributes to it on its own.
  std::array<Float4, 3> from_u;
  std::array<Float4, 3> from_w;
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge& e = edges_[static_cast<std::size_t>(axis)][i];
    from_u[i] =
        max4(e.along_u * (u_row.low - e.start_u), e.along_u * (u_row.high - e.start_u)) + e.slack;
    from_w[i] = max4(e.along_w * (w_row.low - e.start_w), e.along_w * (w_row.high - e.start_w));
  }
  std::array<unsigned, 4> rows{};
  for (std::uint32_t k = 0; k < w_count; ++k) {
    const Float4 least =
        min4(min4(from_u[0] + from_w[0][k], from_u[1] + from_w[1][k]), from_u[2] + from_w[2][k]);
    rows[k] = lane_bits(least >= 0.0F);
  }
  return rows;
}

inline std::uint64_t CellOverlap::test_plane(const std::array<BoxRow, 3>& rows,
                                             const std::array<std::uint32_t, 3>& count) const {
  std::array<Float4, 3> nearest;
  std::array<Float4, 3> farthest;
  for (std::size_t a = 0; a < 3; ++a) {
    const Float4 to_low = normal_[a] * (rows[a].low - v0_[a]);
    const Float4 to_high = normal_[a] * (rows[a].high - v0_[a]);
    nearest[a] = min4(to_low, to_high);
    farthest[a] = max4(to_low, to_high);
  }
  std::uint64_t boxes = 0;
  for (std::uint32_t k = 0; k < count[2]; ++k) {
    for (std::uint32_t j = 0; j < count[1]; ++j) {
      const Float4 least = nearest[0] + (nearest[1][j] + nearest[2][k]);
      const Float4 most = farthest[0] + (farthest[1][j] + farthest[2][k]);
      const Int4 crossed = (least <= plane_slack_) & (most >= -plane_slack_);
      boxes |= std::uint64_t{lane_bits(crossed)} << (4 * j + 16 * k);
    }
  }
  return boxes;
}

std::uint64_t CellOverlap::test(const std::array<BoxRow, 3>& rows,
                                const std::array<std::uint32_t, 3>& count) const {
  const unsigned valid = (1U << count[0]) - 1U;
  std::array<unsigned, 4> xy{15, 15, 15, 15};  // [y], bits x
  std::array<unsigned, 4> zx{15, 15, 15, 15};  // [x], bits z
  std::array<unsigned, 4> yz{15, 15, 15, 15};  // [z], bits y
  if (spans_[0] && spans_[1]) xy = test_projection(2, rows[0], rows[1], count[1]);
  if (spans_[2] && spans_[0]) zx = test_projection(1, rows[2], rows[0], count[0]);
  if (spans_[1] && spans_[2]) yz = test_projection(0, rows[1], rows[2], count[2]);

  std::uint64_t boxes = 0;
  for (std::uint32_t k = 0; k < count[2]; ++k) {
    unsigned x_of_z = 0;
    for (std::uint32_t i = 0; i < 4; ++i) x_of_z |= (zx[i] >> k & 1U) << i;
    x_of_z &= valid;
    for (std::uint32_t j = 0; j < count[1]; ++j) {
      const unsigned row = (yz[k] >> j & 1U) != 0 ? xy[j] & x_of_z : 0U;
      boxes |= std::uint64_t{row} << (4 * j + 16 * k);
    }
  }
  if (spans_[0] && spans_[1] && spans_[2] && boxes != 0) boxes &= test_plane(rows, count);
  return boxes;
}

}  // namespace encore::accel
