#pragma once

#include <filesystem>
#include <vector>

namespace encore::renderer::test {

/// 8-bit RGB values of a PNG, read back by a decoder of its own.
struct Codes {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> values;  ///< 3 * width * height; empty if the file cannot be read
};
Codes read_png(const std::filesystem::path& path);

}  // namespace encore::renderer::test
