#include "renderer/image_diff.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace encore::renderer {

namespace {

double distance(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0.0;
  if (!std::isfinite(a) || !std::isfinite(b)) return std::numeric_limits<double>::infinity();
  return std::fabs(static_cast<double>(a) - static_cast<double>(b));
}

}  // namespace

ImageDifference compare_images(const Image& a, const Image& b, double tolerance) {
  if (a.width != b.width || a.height != b.height || a.pixels.size() != b.pixels.size()) {
    throw std::invalid_argument(
        fmt::format("images of {} x {} and {} x {} pixels cannot be compared", a.width, a.height,
                    b.width, b.height));
  }
  ImageDifference result;
  double squares = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    bool differs = false;
    for (int channel = 0; channel < 3; ++channel) {
      const double d = distance(a.pixels[i][channel], b.pixels[i][channel]);
      squares += d * d;
      differs |= d > tolerance;
      if (d > result.largest) {
        result.largest = d;
        result.largest_x = static_cast<int>(i % static_cast<std::size_t>(a.width));
        result.largest_y = static_cast<int>(i / static_cast<std::size_t>(a.width));
      }
    }
    result.differing += differs ? 1 : 0;
  }
  if (!a.pixels.empty()) {
    result.rmse = std::sqrt(squares / (3.0 * static_cast<double>(a.pixels.size())));
  }
  return result;
}

}  // namespace encore::renderer
