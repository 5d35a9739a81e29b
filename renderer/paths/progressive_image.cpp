#include "renderer/paths/progressive_image.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace encore::renderer {

void ProgressiveImage::reset(int width, int height) {
  mean_.resize(width, height);
  mean_.pixels.assign(mean_.pixels.size(), glm::vec3(0.0F));
  sum_.assign(mean_.pixels.size(), glm::dvec3(0.0));
  first_half_.clear();
  samples_ = half_samples_ = error_samples_ = 0;
  error_.reset();
}

void ProgressiveImage::add(const Image& part, std::uint32_t samples) {
  if (part.width != mean_.width || part.height != mean_.height || samples == 0) {
    throw std::invalid_argument(
        fmt::format("a part of {} x {} pixels and {} samples does not fit a picture of {} x {}",
                    part.width, part.height, samples, mean_.width, mean_.height));
  }
  samples_ += samples;
  const double weight = samples;
  for (std::size_t i = 0; i < sum_.size(); ++i) {
    sum_[i] += glm::dvec3(part.pixels[i]) * weight;
    mean_.pixels[i] = glm::vec3(sum_[i] / static_cast<double>(samples_));
  }
  if (half_samples_ == 0 || samples_ >= 2 * half_samples_) look_at_error();
}

void ProgressiveImage::look_at_error() {
  if (half_samples_ > 0 && samples_ == 2 * half_samples_) {
    double squared = 0.0;
    for (std::size_t i = 0; i < sum_.size(); ++i) {
      // B's sum is what has come since, so A - B = (2 * first - all) / half.
      const glm::dvec3 apart =
          (2.0 * first_half_[i] - sum_[i]) / static_cast<double>(half_samples_);
      squared += glm::dot(apart, apart);
    }
    error_ = 0.5 * std::sqrt(squared / (3.0 * static_cast<double>(sum_.size())));
    error_samples_ = samples_;
  }
  first_half_ = sum_;
  half_samples_ = samples_;
}

}  // namespace encore::renderer
