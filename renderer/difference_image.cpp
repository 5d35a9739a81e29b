#include "renderer/difference_image.h"

#include "renderer/heatmap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace encore::renderer {

namespace {

const glm::vec3 kSame{0.0F, 0.0F, 0.0F};
const glm::vec3 kNotFinite{1.0F, 1.0F, 1.0F};
const glm::vec3 kMarked{1.0F, 0.0F, 1.0F};
// The palette starts dark; what differs must stand out from the black around it.
constexpr double kDarkest = 0.15;

/// Infinite where only one of the two is finite, or they are not the same infinity.
double distance(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0.0;
  const double d = std::fabs(static_cast<double>(a) - static_cast<double>(b));
  return std::isnan(d) ? HUGE_VAL : d;
}

glm::vec3 color_of(const glm::vec3& a, const glm::vec3& b) {
  const double d = std::max({distance(a.r, b.r), distance(a.g, b.g), distance(a.b, b.b)});
  if (d == 0.0) return kSame;
  if (std::isinf(d)) return kNotFinite;
  const double share =
      std::log(d / kDifferenceFirst) / std::log(kDifferenceLast / kDifferenceFirst);
  return palette_color(kDarkest + (1.0 - kDarkest) * std::clamp(share, 0.0, 1.0));
}

}  // namespace

Image difference_image(const Image& a, const Image& b, std::span<const std::uint8_t> marked) {
  const std::size_t count = a.pixels.size();
  if (a.width != b.width || a.height != b.height || b.pixels.size() != count ||
      (!marked.empty() && marked.size() != count)) {
    throw std::invalid_argument("a difference image needs two images and marks of one size");
  }
  Image result;
  result.resize(a.width, a.height);
  for (std::size_t i = 0; i < count; ++i) {
    const bool mark = !marked.empty() && marked[i] != 0;
    result.pixels[i] = mark ? kMarked : color_of(a.pixels[i], b.pixels[i]);
  }
  return result;
}

}  // namespace encore::renderer
