#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace encore::renderer {

/// How values become colours. All are made in OKLab (Ottosson 2020), where equal distances look
/// equal.
enum class Palette {
  helix,      ///< palette_color()'s: dark violet over green to light yellow; the default
  grey,       ///< black to white, lightness growing evenly
  diverging,  ///< blue over a light grey to red, for values to both sides of a middle
  rainbow,    ///< many hues, blue over green to red, for finding equal values; its order is not
              ///< told by lightness alone
};

inline constexpr Palette kPalettes[] = {Palette::helix, Palette::grey, Palette::diverging,
                                        Palette::rainbow};

/// "helix", …
std::string_view to_string(Palette palette);
std::optional<Palette> parse_palette(std::string_view name);

/// A palette's colours (linear RGB, inside what a screen shows), evenly from 0 to 1.
std::span<const glm::vec3, 256> palette_colors(Palette palette);
/// The same as sRGB codes, red in the lowest byte, opaque.
std::span<const std::uint32_t, 256> palette_codes(Palette palette);

/// Which of the 256 a value in [0, 1] has; values outside are clamped, NaN counts as 0.
std::size_t palette_place(double value);
/// The colour of a value.
glm::vec3 palette_color(Palette palette, double value);

/// A linear colour as sRGB codes, red in the lowest byte, opaque.
std::uint32_t rgba8_of(const glm::vec3& color);

}  // namespace encore::renderer
