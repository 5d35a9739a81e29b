// Feeds arbitrary bytes to the reader of power calibrations: constants that can be used, or
// PowerModelError.
#include "energy/sources/calibration.h"
#include "tests/fuzz/check_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace encore;
  energy::PowerModel model;
  bool read = false;
  fuzz::check_parser<energy::PowerModelError>([&] {
    model = energy::parse_calibration(fuzz::text_of(data, size), "fuzz.toml").model;
    read = true;
  });
  if (!read) return 0;
  energy::check(model);
  fuzz::require(!energy::describe(model).empty());
  return 0;
}
