#pragma once

#include "renderer/image.h"

#include <cstdint>
#include <span>

namespace encore::renderer {

/// The largest channel differences that the first and the last colour of a difference image stand
/// for: from about one rounding of single precision to the whole range of a screen.
inline constexpr double kDifferenceFirst = 1e-7;
inline constexpr double kDifferenceLast = 1.0;

/// Where two images differ, as a picture (linear RGB) a person can read. Black: all channels
/// are equal. Otherwise a palette_color() for the largest difference of a channel of linear RGB, on
/// a logarithmic scale from kDifferenceFirst to kDifferenceLast that is the same for every pair of
/// images; what lies outside has the first or the last colour, so no difference is black. White:
/// only one of the two is a finite number. Magenta, which the palette does not have: `marked` says
/// so; it may be empty, else holds one number a pixel, not 0 where marked. Throws
/// std::invalid_argument if the sizes differ.
Image difference_image(const Image& a, const Image& b, std::span<const std::uint8_t> marked = {});

}  // namespace encore::renderer
