#include "scene/diagnostics.h"
#include "scene/scene_file.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

/// Any bytes as a scene file: a scene or an InputError, nothing else. The empty folder keeps the
/// disk out of it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    encore::scene::parse_scene_toml(text, "fuzz.toml", {});
  } catch (const encore::scene::InputError&) {
  }
  return 0;
}
