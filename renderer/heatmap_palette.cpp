#include "renderer/heatmap_palette.h"

#include "renderer/image_io.h"
#include "scene/portable_math.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace encore::renderer {

namespace {

constexpr std::size_t kColors = 256;
using Colors = std::array<glm::vec3, kColors>;
using Codes = std::array<std::uint32_t, kColors>;

constexpr std::array<std::pair<Palette, std::string_view>, 4> kNames = {{
    {Palette::helix, "helix"},
    {Palette::grey, "grey"},
    {Palette::diverging, "diverging"},
    {Palette::rainbow, "rainbow"},
}};

/// A colour in OKLab by lightness, chroma and hue.
struct Tone {
  double lightness;
  double chroma;
  double hue;  ///< in degrees
};

/// Its linear sRGB, which may be outside what a screen shows.
glm::dvec3 linear_of(const Tone& tone) {
  const auto cube = [](double x) { return x * x * x; };
  const double a = tone.chroma * scene::portable_cos_degrees(tone.hue);
  const double b = tone.chroma * scene::portable_sin_degrees(tone.hue);
  const double l = cube(tone.lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(tone.lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(tone.lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool is_shown(const Tone& tone) {
  const glm::dvec3 c = linear_of(tone);
  return std::min({c.r, c.g, c.b}) >= 0.0 && std::max({c.r, c.g, c.b}) <= 1.0;
}

/// The tone, or the strongest of its lightness and hue that a screen shows.
Tone shown(Tone tone) {
  if (is_shown(tone)) return tone;
  double inside = 0.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (inside + tone.chroma);
    (is_shown({tone.lightness, middle, tone.hue}) ? inside : tone.chroma) = middle;
  }
  tone.chroma = inside;
  return tone;
}

Tone helix(double t) {
  // The chroma is the largest with which the whole helix stays inside what a screen can show.
  return {0.22 + (0.93 - 0.22) * t, 0.092, 305.0 + (100.0 - 305.0) * t};
}

Tone diverging(double t) {
  const double away = std::fabs(2.0 * t - 1.0);
  return shown({0.93 - 0.45 * away, 0.17 * away, t < 0.5 ? 260.0 : 27.0});
}

Tone rainbow(double t) {
  // The hue falls evenly; lightness is highest at two thirds, among the yellows.
  const double from_top = (t - 2.0 / 3.0) / (t < 2.0 / 3.0 ? 2.0 / 3.0 : 1.0 / 3.0);
  const double lowest = t < 2.0 / 3.0 ? 0.35 : 0.45;
  const double lightness = 0.88 - (0.88 - lowest) * from_top * from_top;
  return shown({lightness, 0.17, 285.0 + (27.0 - 285.0) * t});
}

Tone tone_of(Palette palette, double t) {
  switch (palette) {
    case Palette::helix:
      return helix(t);
    case Palette::grey:
      return {t, 0.0, 0.0};
    case Palette::diverging:
      return diverging(t);
    case Palette::rainbow:
      return rainbow(t);
  }
  return helix(t);
}

struct Tables {
  std::array<Colors, kNames.size()> colors{};
  std::array<Codes, kNames.size()> codes{};

  Tables() {
    for (std::size_t p = 0; p < kNames.size(); ++p) {
      for (std::size_t i = 0; i < kColors; ++i) {
        const double t = static_cast<double>(i) / (kColors - 1);
        const glm::dvec3 color = linear_of(tone_of(kNames[p].first, t));
        colors[p][i] = glm::vec3(glm::clamp(color, 0.0, 1.0));
        codes[p][i] = rgba8_of(colors[p][i]);
      }
    }
  }
};

const Tables& tables() {
  static const Tables kTables;
  return kTables;
}

/// The palette's place in the tables.
std::size_t index_of(Palette palette) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i].first == palette) return i;
  }
  return 0;
}

}  // namespace

std::string_view to_string(Palette palette) {
  return kNames[index_of(palette)].second;
}

std::optional<Palette> parse_palette(std::string_view name) {
  for (const auto& [value, known] : kNames) {
    if (known == name) return value;
  }
  return std::nullopt;
}

std::span<const glm::vec3, 256> palette_colors(Palette palette) {
  return tables().colors[index_of(palette)];
}

std::span<const std::uint32_t, 256> palette_codes(Palette palette) {
  return tables().codes[index_of(palette)];
}

std::size_t palette_place(double value) {
  if (!(value > 0.0)) return 0;
  return static_cast<std::size_t>(std::min(value, 1.0) * (kColors - 1) + 0.5);
}

glm::vec3 palette_color(Palette palette, double value) {
  return palette_colors(palette)[palette_place(value)];
}

std::uint32_t rgba8_of(const glm::vec3& color) {
  return std::uint32_t{to_srgb8(color.r)} | std::uint32_t{to_srgb8(color.g)} << 8U |
         std::uint32_t{to_srgb8(color.b)} << 16U | 0xFF000000U;
}

}  // namespace encore::renderer
