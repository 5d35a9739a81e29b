#pragma once

#include "renderer/image.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace encore::renderer {

/// A picture that grows better part by part: the mean of all samples so far, and how far off that
/// still is.
class ProgressiveImage {
 public:
  /// Forgets everything, for pictures of another size or of something else.
  void reset(int width, int height);

  /// Adds `part`, the mean of the `samples` that follow those added before
  /// (Renderer::draw_samples). Throws std::invalid_argument if it has another size, or no samples.
  void add(const Image& part, std::uint32_t samples);

  /// Mean of all samples so far; black before the first.
  [[nodiscard]] const Image& mean() const { return mean_; }
  [[nodiscard]] std::uint32_t samples() const { return samples_; }

  /// Estimated error of the mean of error_samples() samples: root mean square over pixels and
  /// channels, linear RGB. Nothing before two parts of as many samples each.
  ///
  /// Taken from halves: with A and B the means of the first and of the second half of the samples,
  /// rms(A - B) / 2. Were samples independent, that would be the mean's standard error. Those of a
  /// (0, 2)-sequence (sample_pattern.h) do better together than apart, so it is rather an upper
  /// bound. Updated whenever the samples have doubled since the last time, so after 2, 4, 8 … parts
  /// of one size, or parts that double.
  [[nodiscard]] std::optional<double> error() const { return error_; }
  [[nodiscard]] std::uint32_t error_samples() const { return error_samples_; }

 private:
  void look_at_error();

  Image mean_;
  std::vector<glm::dvec3> sum_;
  std::vector<glm::dvec3> first_half_;  ///< the sum when there were half_samples_
  std::uint32_t samples_ = 0;
  std::uint32_t half_samples_ = 0;
  std::uint32_t error_samples_ = 0;
  std::optional<double> error_;
};

}  // namespace encore::renderer
