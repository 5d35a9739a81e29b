// Feeds arbitrary bytes to the picture decoder behind textures, in this process: it gives texels
// within the limits or an InputError.
#include "scene/texture_reader.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace encore::scene;
  try {
    const Texture texture = decode_texture({reinterpret_cast<const char*>(data), size}, "fuzz");
    const auto count =
        static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
    const bool sound = texture.width > 0 && texture.height > 0 &&
                       texture.width <= kMaxTextureSide && texture.height <= kMaxTextureSide &&
                       texture.texels.size() == count && texture.bytes() <= kMaxTextureBytes;
    if (!sound) std::abort();
    for (const std::uint32_t texel : texture.texels) {
      if (texel >> 24U != 255U) std::abort();
    }
  } catch (const InputError&) {
    // The answer for most inputs.
  }
  return 0;
}
