// Feeds arbitrary bytes to whatever importer their content asks for (STL if nothing tells), behind
// its guard: the host survives and gets a sound model or InputError.
#include "scene/mesh_reader.h"
#include "scene/model_sniff.h"
#include "tests/fuzz/check_model.h"

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  encore::fuzz::expect_crashes_in_children();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace encore;
  const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
  std::string extension = scene::sniff_extension({reinterpret_cast<const char*>(data), size});
  if (extension.empty()) extension = ".stl";
  fuzz::check_reader([&] { return scene::read_with_assimp(bytes, extension, "fuzz" + extension); });
  return 0;
}
