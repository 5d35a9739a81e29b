// Feeds arbitrary bytes to Assimp's 3DS importer behind its guard (a child process an input): the
// host survives and gets a sound model or InputError.
#include "scene/mesh_reader.h"
#include "tests/fuzz/check_model.h"

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  encore::fuzz::expect_crashes_in_children();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace encore;
  const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
  fuzz::check_reader([&] { return scene::read_with_assimp(bytes, ".3ds", "fuzz.3ds"); });
  return 0;
}
