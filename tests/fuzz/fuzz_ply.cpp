// Feeds arbitrary bytes to the PLY reader: it returns a sound model or throws InputError.
#include "scene/ply_reader.h"
#include "tests/fuzz/check_model.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace encore;
  fuzz::check_reader([&] {
    return scene::read_ply({reinterpret_cast<const char*>(data), size}, "fuzz.ply");
  });
  return 0;
}
