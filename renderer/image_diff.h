#pragma once

#include "renderer/image.h"

#include <cstdint>

namespace encore::renderer {

/// How far two images are apart, over all three channels of linear RGB.
struct ImageDifference {
  double rmse = 0.0;     ///< root of the mean squared difference of a channel
  double largest = 0.0;  ///< largest difference of one channel
  int largest_x = 0;     ///< the first pixel that has it
  int largest_y = 0;
  std::uint64_t differing = 0;  ///< pixels with a channel that differs by more than the tolerance
};

/// Compares two images of the same size. Channels that are both NaN, or the same infinity, are
/// equal; where only one is not finite the difference is infinite.
/// Throws std::invalid_argument if the sizes differ.
ImageDifference compare_images(const Image& a, const Image& b, double tolerance = 0.0);

}  // namespace encore::renderer
