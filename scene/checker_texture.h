#pragma once

#include "scene/texture.h"

#include <glm/vec3.hpp>

#include <array>

namespace encore::scene {

/// The sRGB code that is nearest to a linear value, which is brought into [0, 1] first. The same on
/// every machine.
std::uint32_t srgb_code(float linear);

inline constexpr int kMostCheckerCells = 256;

/// A board of `cells` x `cells` squares (1 … kMostCheckerCells) in two linear colours by turns, the
/// first one at the upper left. An even number of cells makes it seamless where it repeats.
Texture checker_texture(const std::array<glm::vec3, 2>& colors, int cells);

}  // namespace encore::scene
