#include "tests/renderer/png.h"

#include <stb/stb_image.h>

namespace encore::renderer::test {

Codes read_png(const std::filesystem::path& path) {
  Codes codes;
  int channels = 0;
  unsigned char* data = stbi_load(path.c_str(), &codes.width, &codes.height, &channels, 3);
  if (data == nullptr) return {};
  codes.values.assign(data, data + 3 * codes.width * codes.height);
  stbi_image_free(data);
  return codes;
}

}  // namespace encore::renderer::test
