#include "scene/checker_texture.h"

#include <algorithm>

namespace encore::scene {
namespace {

// Texels a side, about: wide enough squares that their edges look sharp also where lookups blend
// neighbours.
constexpr int kSide = 512;

/// base^2.4 for bases in (0, 1], by Newton's iteration for the fifth root of base^12: basic
/// operations only, so the same everywhere.
double power_2_4(double base) {
  const double cube = base * base * base;
  const double twelfth = (cube * cube) * (cube * cube);
  double root = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double fourth = (root * root) * (root * root);
    const double next = (4.0 * root + twelfth / fourth) / 5.0;
    if (!(next < root)) break;
    root = next;
  }
  return root;
}

/// Linear values half way (in codes) between neighbouring codes.
std::array<float, 255> make_steps() {
  std::array<float, 255> steps{};
  for (int k = 0; k < 255; ++k) {
    const double code = (k + 0.5) / 255.0;
    steps[static_cast<std::size_t>(k)] =
        static_cast<float>(code <= 0.04045 ? code / 12.92 : power_2_4((code + 0.055) / 1.055));
  }
  return steps;
}

std::uint32_t texel_of(const glm::vec3& color) {
  return 0xFF000000U | (srgb_code(color.b) << 16U) | (srgb_code(color.g) << 8U) |
         srgb_code(color.r);
}

}  // namespace

std::uint32_t srgb_code(float linear) {
  static const std::array<float, 255> kSteps = make_steps();
  return static_cast<std::uint32_t>(std::upper_bound(kSteps.begin(), kSteps.end(), linear) -
                                    kSteps.begin());
}

Texture checker_texture(const std::array<glm::vec3, 2>& colors, int cells) {
  cells = std::clamp(cells, 1, kMostCheckerCells);
  const int cell = std::max(kSide / cells, 1);
  const std::array<std::uint32_t, 2> texels{texel_of(colors[0]), texel_of(colors[1])};
  Texture texture;
  texture.name = "checker";
  texture.width = texture.height = cells * cell;
  texture.texels.reserve(static_cast<std::size_t>(texture.width) *
                         static_cast<std::size_t>(texture.height));
  for (int y = 0; y < texture.height; ++y) {
    for (int x = 0; x < texture.width; ++x) {
      texture.texels.push_back(texels[static_cast<std::size_t>((x / cell + y / cell) % 2)]);
    }
  }
  return texture;
}

}  // namespace encore::scene
