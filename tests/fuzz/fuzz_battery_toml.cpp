// Feeds arbitrary bytes to the reader of battery descriptions: a pack without fault, or
// BatteryError.
#include "energy/battery_life/battery_toml.h"
#include "tests/fuzz/check_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace encore;
  fuzz::check_parser<energy::BatteryError>([&] {
    const auto battery = energy::parse_battery_toml(fuzz::text_of(data, size), "fuzz.toml");
    fuzz::require(energy::battery_fault(battery).empty());
  });
  return 0;
}
