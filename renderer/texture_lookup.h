#pragma once

#include "scene/texture.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace encore::renderer {

/// Linear value of an 8-bit sRGB one (IEC 61966-2-1): c / 12.92 up to c = 0.04045, above
/// ((c + 0.055) / 1.055)^2.4, with c = value / 255.
float linear_of_srgb(std::uint32_t value);

/// The texture's colour, linear RGB, at a coordinate: repeated without end, u to the right and v
/// upwards (v = 0 is the lower edge of the last row), bilinear between the centres of four texels.
///
///   x = (u - floor(u)) * width - 0.5, y = (1 - (v - floor(v))) * height - 0.5
///   columns floor(x), floor(x) + 1 and rows floor(y), floor(y) + 1, wrapped round at the edges
///   mix over x (weights fx = x - floor(x) and 1 - fx) of each row, then over y
///
/// Texels become linear before they are mixed. Where u or v is no finite number, 0 takes its place.
/// Coordinates are computed in double here and in single precision in shaders/texture_lookup.glsl.
/// The texture must hold width * height > 0 texels.
glm::vec3 texture_color(const scene::Texture& texture, const glm::vec2& coordinate);

}  // namespace encore::renderer
