#include "scene/classic_scene_file.h"
#include "scene/diagnostics.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

/// Any bytes as a scene of the original system: a scene or an InputError, nothing else. The empty
/// folder keeps the disk out of it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  // 4,000 spheres are as good as 40,000, and each costs its triangles for the bounds.
  if (text.size() > 16384) return 0;
  try {
    encore::scene::parse_classic_scene(text, "fuzz.txt", {});
  } catch (const encore::scene::InputError&) {
  }
  return 0;
}
