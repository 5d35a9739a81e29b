// Feeds arbitrary bytes to what users type behind --model ('0') and --source ('1'): something that
// can be used, or the error of its kind.
#include "energy/sources/model_spec.h"
#include "energy/sources/source_spec.h"
#include "tests/fuzz/check_text.h"

namespace {

using namespace encore;
using namespace encore::energy;

void check_model(std::string_view text) {
  // Names of files would read the disk.
  if (text.find(".toml") != std::string_view::npos) return;
  std::optional<ModelSpec> spec;
  fuzz::check_parser<PowerModelError>([&] { spec = parse_model_spec(text); });
  if (spec) std::visit([](const auto& model) { check(model); }, *spec);
}

void check_source(std::string_view text) {
  fuzz::check_parser<SourceSpecError>([&] {
    const SourceSpec spec = parse_source_spec(text);
    fuzz::require(spec.meter.has_value() == (spec.kind == SourceKind::meter));
    fuzz::require(spec.replay.has_value() == (spec.kind == SourceKind::replay));
    if (spec.meter) {
      fuzz::require(!spec.meter->device.empty());
      fuzz::require_finite(spec.meter->volts);
      fuzz::require_finite(spec.meter->amps);
    }
    if (spec.replay) fuzz::require_finite(spec.replay->offset);
    (void)spec.names({});
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto input = fuzz::choice_of(data, size, 2);
  if (!input) return 0;
  input->which == 0 ? check_model(input->text) : check_source(input->text);
  return 0;
}
