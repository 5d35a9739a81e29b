#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace encore::scene {

/// A picture that a surface wears: 8 bits a channel, row 0 at the top. Shared by the materials that
/// name the same file; never changed once it is read. Texture coordinates are (0, 0) at its lower
/// left corner and (1, 1) at its upper right one; beyond, it repeats.
struct Texture {
  std::string name;  ///< file it came from, or "checker"
  int width = 0;
  int height = 0;
  /// One texel a value: red in the lowest byte, then green, blue and 255. sRGB.
  std::vector<std::uint32_t> texels;

  [[nodiscard]] std::uint64_t bytes() const { return texels.size() * sizeof(std::uint32_t); }
};

}  // namespace encore::scene
