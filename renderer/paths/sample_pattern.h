#pragma once

#include <glm/vec2.hpp>

#include <cstdint>

namespace encore::renderer {

/// Where in its pixel a camera ray goes through: (0, 0) is the pixel's upper left corner, (0.5,
/// 0.5) its centre.
///
/// A (0, 2)-sequence: the first two dimensions of Sobol' (1967), each scrambled by exclusive or
/// with a hash of pixel, seed and dimension (Kollig and Keller 2002), which keeps that property. So
/// the first 2^k samples of a pixel are stratified in every way that 2^k equal boxes allow (4 x 4,
/// 2 x 8, … for 16), any prefix is well spread, and a picture may be refined sample by sample.
/// Pixels are independent of each other and of the picture's size.
///
///   x = van_der_corput(sample) ^ hash(pixel, seed, 0), y = sobol2(sample) ^ hash(pixel, seed, 1),
///   each as a 32-bit fraction of which the upper 24 bits count (shaders/sample_pattern.glsl)
///
/// `samples`: how many the picture is to have in all; where that is 1, the centre.
glm::dvec2 sample_offset(int x, int y, std::uint32_t sample, std::uint32_t samples,
                         std::uint32_t seed);

}  // namespace encore::renderer
