#include "accel/grid/grid_layout.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace encore::accel {

namespace {

using scene::Bounds;

// Floats in ascending order have ascending keys, so that they can be bisected.
std::int64_t key_of(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  return bits >= 0 ? std::int64_t{bits} : -std::int64_t{bits & 0x7FFFFFFF};
}

float float_of(std::int64_t key) {
  const auto bits = static_cast<std::int32_t>(key >= 0 ? key : -key);
  const auto magnitude = std::bit_cast<float>(bits);
  return key >= 0 ? magnitude : -magnitude;
}

}  // namespace

void GridLayout::divide(const Bounds& bounds, std::uint32_t cells, MemoryMode mode,
                        AllocationCount& count) {
  const Bounds box = bounds.empty() ? Bounds{glm::vec3(0.0F), glm::vec3(0.0F)} : bounds;
  std::size_t planes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double extent = static_cast<double>(box.max[axis]) - static_cast<double>(box.min[axis]);
    size_[a] = extent > 0.0 ? cells : 1;
    origin_[a] = static_cast<double>(box.min[axis]);
    // Rounded upwards by a hair, so that an exact multiple of the cell size is never put below it.
    cells_per_unit_[a] = extent > 0.0 ? size_[a] / extent * (1.0 + 0x1p-50) : 0.0;
    last_[a] = size_[a] - 1;
    plane_start_[a] = planes;
    planes += size_[a] + 1;
  }
  planes_.reset(planes, mode, count);
  for (int axis = 0; axis < 3; ++axis) {
    place_planes(axis, box.min[axis], box.max[axis],
                 planes_.data() + plane_start_[static_cast<std::size_t>(axis)]);
  }
}

void GridLayout::place_planes(int axis, float low, float high, float* planes) {
  const std::uint32_t n = size(axis);
  planes[0] = low;
  planes[n] = high;
  for (std::uint32_t i = 1; i < n; ++i) planes[i] = first_float_of_cell(axis, i, low, high);
  float gap = std::numeric_limits<float>::infinity();
  for (std::uint32_t i = 0; i < n; ++i) gap = std::min(gap, planes[i + 1] - planes[i]);
  smallest_gap_[static_cast<std::size_t>(axis)] = gap;
}

// The smallest float in [low, high] that cell_of() puts into `cell` or above.
float GridLayout::first_float_of_cell(int axis, std::uint32_t cell, float low, float high) const {
  // Usually it is the rounded plane position itself.
  const double extent = static_cast<double>(high) - static_cast<double>(low);
  const float guess = static_cast<float>(static_cast<double>(low) + extent * cell / size(axis));
  std::int64_t above = key_of(high);
  std::int64_t below = key_of(low);
  if (guess > low && guess <= high) {
    const std::int64_t key = key_of(guess);
    (cell_of(axis, guess) >= cell ? above : below) = key;
    if (above == key && cell_of(axis, float_of(key - 1)) < cell) return guess;
  }

  // Else bisect; the low end is in cell 0, the high end in the last one.
  while (above - below > 1) {
    const std::int64_t middle = below + (above - below) / 2;
    (cell_of(axis, float_of(middle)) >= cell ? above : below) = middle;
  }
  return float_of(above);
}

Bounds GridLayout::bounds() const {
  Bounds box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = planes(axis)[0];
    box.max[axis] = planes(axis)[size(axis)];
  }
  return box;
}

Bounds GridLayout::cell_bounds(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
  return {{planes(0)[x], planes(1)[y], planes(2)[z]},
          {planes(0)[x + 1], planes(1)[y + 1], planes(2)[z + 1]}};
}

}  // namespace encore::accel
