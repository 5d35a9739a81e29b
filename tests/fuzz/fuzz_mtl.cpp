// Feeds arbitrary bytes to the MTL reader: it never throws, and its numbers are in their ranges.
#include "scene/obj_reader_mtl.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace encore::scene;
  MaterialsByName materials;
  Warnings warnings;
  read_mtl({reinterpret_cast<const char*>(data), size}, "fuzz.mtl", materials, warnings);
  for (const auto& [name, material] : materials) {
    const bool sound = material.opacity >= 0.0F && material.opacity <= 1.0F &&
                       material.ambient.x <= 1.0F && material.diffuse.x >= 0.0F &&
                       material.shininess >= 0.0F && !name.empty();
    if (!sound) std::abort();
  }
  return 0;
}
