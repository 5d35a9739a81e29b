#include "renderer/heatmap_style.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace encore::renderer {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A range made ready for many values.
class Ruler {
 public:
  explicit Ruler(const HeatmapRange& range)
      : logarithmic_(range.scale == HeatmapScale::logarithmic) {
    if (!std::isfinite(range.low) || !std::isfinite(range.high) || range.low > range.high) {
      throw std::invalid_argument("a heatmap's range must run from a number to one not below it");
    }
    if (logarithmic_ && !(range.low > 0.0)) {
      throw std::invalid_argument(
          "a logarithmic scale must begin above 0; raise its low end or use a linear scale");
    }
    low_ = at(range.low);
    high_ = at(range.high);
    // By the inverse, as draw_heatmap() of counters does: the same values, the same pictures.
    per_unit_ = high_ > low_ ? 1.0 / (high_ - low_) : 0.0;
  }

  [[nodiscard]] double place(double value) const {
    if (std::isnan(value)) return value;
    const double x = at(value);
    if (x > high_) return per_unit_ > 0.0 ? std::max(beyond(), (x - low_) * per_unit_) : kInfinity;
    if (x < low_) return per_unit_ > 0.0 ? (x - low_) * per_unit_ : -kInfinity;
    if (per_unit_ > 0.0 && x == high_) return 1.0;  // which the product may miss by its rounding
    return per_unit_ > 0.0 ? std::min((x - low_) * per_unit_, 1.0) : 0.0;
  }

 private:
  /// The first place that is outside.
  static double beyond() { return std::nextafter(1.0, 2.0); }

  [[nodiscard]] double at(double value) const {
    if (!logarithmic_) return value;
    return value > 0.0 ? std::log2(value) : -kInfinity;
  }

  bool logarithmic_;
  double low_ = 0.0;
  double high_ = 0.0;
  double per_unit_ = 0.0;
};

/// Which colour a place has: one of the palette's, or one of the three beyond them.
constexpr std::size_t kBelow = 256;
constexpr std::size_t kAbove = 257;
constexpr std::size_t kMissing = 258;
constexpr std::size_t kChoices = 259;

std::size_t choice_of(double place) {
  if (std::isnan(place)) return kMissing;
  if (place < 0.0) return kBelow;
  if (place > 1.0) return kAbove;
  return palette_place(place);
}

/// All colours of a style, by choice.
std::array<glm::vec3, kChoices> colors_of(const HeatmapStyle& style) {
  std::array<glm::vec3, kChoices> colors{};
  const auto palette = palette_colors(style.palette);
  std::copy(palette.begin(), palette.end(), colors.begin());
  colors[kBelow] = style.below.value_or(palette.front());
  colors[kAbove] = style.above.value_or(palette.back());
  colors[kMissing] = style.missing;
  return colors;
}

void check_sizes(std::size_t values, std::size_t room) {
  if (values == room) return;
  throw std::invalid_argument("a heatmap needs one value a pixel");
}

}  // namespace

double heatmap_place(const HeatmapRange& range, double value) {
  return Ruler(range).place(value);
}

HeatmapRange default_range(const ValueStatistics& statistics, HeatmapScale scale) {
  const auto high = static_cast<double>(statistics.percentile_99);
  if (scale == HeatmapScale::logarithmic && statistics.smallest_positive) {
    const auto low = static_cast<double>(*statistics.smallest_positive);
    return {low, std::max(low, high), HeatmapScale::logarithmic};
  }
  return {std::min(0.0, static_cast<double>(statistics.min)), std::max(0.0, high),
          HeatmapScale::linear};
}

void draw_heatmap(std::span<const float> values, const HeatmapStyle& style, Image& image) {
  check_sizes(values.size(), image.pixels.size());
  const Ruler ruler(style.range);
  const std::array<glm::vec3, kChoices> colors = colors_of(style);
  for (std::size_t i = 0; i < values.size(); ++i) {
    image.pixels[i] = colors[choice_of(ruler.place(static_cast<double>(values[i])))];
  }
}

void draw_heatmap(std::span<const float> values, const HeatmapStyle& style,
                  std::span<std::uint8_t> rgba) {
  check_sizes(4 * values.size(), rgba.size());
  const Ruler ruler(style.range);
  std::array<std::array<std::uint8_t, 4>, kChoices> codes{};
  const std::array<glm::vec3, kChoices> colors = colors_of(style);
  for (std::size_t i = 0; i < kChoices; ++i) {
    const std::uint32_t code = rgba8_of(colors[i]);
    for (unsigned byte = 0; byte < 4; ++byte) {
      codes[i][byte] = static_cast<std::uint8_t>(code >> 8U * byte & 0xFFU);
    }
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t choice = choice_of(ruler.place(static_cast<double>(values[i])));
    std::memcpy(&rgba[4 * i], codes[choice].data(), 4);
  }
}

HeatmapHistogram heatmap_histogram(std::span<const float> values, const HeatmapRange& range,
                                   std::size_t bins) {
  if (bins == 0) throw std::invalid_argument("a histogram needs at least one bin");
  const Ruler ruler(range);
  HeatmapHistogram histogram;
  histogram.bins.resize(bins);
  histogram.low = range.low;
  histogram.high = range.high;
  histogram.scale = range.scale;
  for (const float value : values) {
    const double place = ruler.place(static_cast<double>(value));
    if (std::isnan(place)) {
      ++histogram.missing;
    } else if (place < 0.0) {
      ++histogram.below;
    } else if (place > 1.0) {
      ++histogram.above;
    } else {
      const auto bin = static_cast<std::size_t>(place * static_cast<double>(bins));
      ++histogram.bins[std::min(bin, bins - 1)];
    }
  }
  return histogram;
}

}  // namespace encore::renderer
