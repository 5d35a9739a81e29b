#include "renderer/texture_lookup.h"

#include "renderer/portable_power.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace encore::renderer {

namespace {

std::array<float, 256> make_linear_table() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double c = static_cast<double>(i) / 255.0;
    table[i] =
        static_cast<float>(c <= 0.04045 ? c / 12.92 : portable_power((c + 0.055) / 1.055, 2.4));
  }
  return table;
}

const std::array<float, 256> kLinear = make_linear_table();

glm::vec3 texel(const scene::Texture& texture, int column, int row) {
  const auto place = static_cast<std::size_t>(row) * static_cast<std::size_t>(texture.width) +
                     static_cast<std::size_t>(column);
  const std::uint32_t value = texture.texels[place];
  return {kLinear[value & 255U], kLinear[(value >> 8U) & 255U], kLinear[(value >> 16U) & 255U]};
}

/// What is behind the point, in [0, 1); also where rounding would make it 1.
double wrapped(double coordinate) {
  const double inside = coordinate - std::floor(coordinate);
  return inside >= 0.0 && inside < 1.0 ? inside : 0.0;
}

/// Two neighbours on an axis of `size` texels, and how much the second counts.
struct Neighbours {
  int first = 0;
  int second = 0;
  float second_share = 0.0F;
};

/// `place`: from -0.5 to size - 0.5, in texels from the first one's centre.
Neighbours neighbours(double place, int size) {
  const double below = std::floor(place);
  const int first = static_cast<int>(below);
  return {.first = first < 0 ? size - 1 : first,
          .second = first + 1 < size ? first + 1 : 0,
          .second_share = static_cast<float>(place - below)};
}

glm::vec3 mix(const glm::vec3& a, const glm::vec3& b, float share_of_b) {
  return a * (1.0F - share_of_b) + b * share_of_b;
}

}  // namespace

float linear_of_srgb(std::uint32_t value) {
  return kLinear[value & 255U];
}

glm::vec3 texture_color(const scene::Texture& texture, const glm::vec2& coordinate) {
  const Neighbours across = neighbours(wrapped(coordinate.x) * texture.width - 0.5, texture.width);
  const Neighbours down =
      neighbours((1.0 - wrapped(coordinate.y)) * texture.height - 0.5, texture.height);
  const glm::vec3 upper = mix(texel(texture, across.first, down.first),
                              texel(texture, across.second, down.first), across.second_share);
  const glm::vec3 lower = mix(texel(texture, across.first, down.second),
                              texel(texture, across.second, down.second), across.second_share);
  return mix(upper, lower, down.second_share);
}

}  // namespace encore::renderer
