#include "accel/wide/wide_clip.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace encore::accel {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The largest number of single precision that is not above x.
float rounded_down(double x) {
  const auto near = static_cast<float>(x);
  if (!(double(near) > x)) return near;
  const auto bits = std::bit_cast<std::uint32_t>(near);
  if (near == 0.0F) return -std::numeric_limits<float>::denorm_min();
  return std::bit_cast<float>(near > 0.0F ? bits - 1 : bits + 1);
}

void extend(WideItem& item, int axis, float lower, float minus_upper) {
  item.lower[axis] = std::min(item.lower[axis], lower);
  item.minus_upper[axis] = std::min(item.minus_upper[axis], minus_upper);
}

}  // namespace

void clip_wide_item(const scene::Triangle& triangle, const WideItem& item, int axis, float plane,
                    WideItem sides[2]) {
  for (int side = 0; side < 2; ++side) {
    sides[side] = {{kInfinity, kInfinity, kInfinity},
                   item.triangle,
                   {kInfinity, kInfinity, kInfinity},
                   item.reserved};
  }
  const glm::vec3* const corners[3] = {&triangle.v0, &triangle.v1, &triangle.v2};
  for (int i = 0; i < 3; ++i) {
    const glm::vec3& a = *corners[i];
    const glm::vec3& b = *corners[(i + 1) % 3];
    for (int k = 0; k < 3; ++k) {
      if (a[axis] <= plane) extend(sides[0], k, a[k], -a[k]);
      if (a[axis] >= plane) extend(sides[1], k, a[k], -a[k]);
    }
    const bool across =
        (a[axis] < plane && b[axis] > plane) || (a[axis] > plane && b[axis] < plane);
    if (!across) continue;
    const double share = (double(plane) - a[axis]) / (double(b[axis]) - a[axis]);
    for (int k = 0; k < 3; ++k) {
      float lower = plane, minus_upper = -plane;
      if (k != axis) {
        const double point = a[k] + (double(b[k]) - a[k]) * share;
        // Off by some 2^-51 of what it is made of.
        const double error = 0x1p-48 * (std::fabs(double(a[k])) + std::fabs(double(b[k])));
        lower = rounded_down(point - error);
        minus_upper = rounded_down(-point - error);
      }
      extend(sides[0], k, lower, minus_upper);
      extend(sides[1], k, lower, minus_upper);
    }
  }
  for (int side = 0; side < 2; ++side) {
    for (int k = 0; k < 3; ++k) {
      sides[side].lower[k] = std::max(sides[side].lower[k], item.lower[k]);
      sides[side].minus_upper[k] = std::max(sides[side].minus_upper[k], item.minus_upper[k]);
    }
  }
}

}  // namespace encore::accel
