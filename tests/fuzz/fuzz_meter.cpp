// Feeds arbitrary bytes to the protocols of external meters, which never throw. The first byte
// picks the protocol: '0' the USB meters' frames, '1' SCPI watts, '2' and '3' SCPI with constant
// volts or amperes.
#include "energy/sources/meter_scpi.h"
#include "energy/sources/meter_um25c.h"
#include "tests/fuzz/check_text.h"

#include <algorithm>

namespace {

using namespace encore;
using namespace encore::energy;

using ByteView = std::span<const std::uint8_t>;

void check_sample(const MeterSample& sample) {
  for (const auto& value : {sample.volts, sample.amps}) fuzz::require_finite(value);
  fuzz::require_finite(sample.power);
  fuzz::require_finite(sample.energy);
}

/// Every sample of a stream that comes in pieces.
std::vector<MeterSample> take_in_pieces(MeterProtocol& protocol, ByteView bytes,
                                        std::size_t piece) {
  std::vector<MeterSample> samples;
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    const auto some = protocol.take(bytes.subspan(at, std::min(piece, bytes.size() - at)), {});
    samples.insert(samples.end(), some.begin(), some.end());
  }
  for (const MeterSample& sample : samples) check_sample(sample);
  (void)protocol.facts();
  return samples;
}

/// How a stream is cut must not matter, and every byte counts once.
void check_frames(ByteView bytes) {
  Um25cProtocol whole;
  Um25cProtocol pieces;
  const auto one = take_in_pieces(whole, bytes, std::max<std::size_t>(bytes.size(), 1));
  const auto many = take_in_pieces(pieces, bytes, 1 + bytes.size() % 13);
  fuzz::require(one.size() == many.size() && whole.skipped() == pieces.skipped());
  for (std::size_t i = 0; i < one.size(); ++i) {
    fuzz::require(one[i].volts == many[i].volts && one[i].energy == many[i].energy);
  }
  fuzz::require(whole.skipped() + one.size() * Um25cProtocol::kFrameSize <= bytes.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto input = fuzz::choice_of(data, size, 4);
  if (!input) return 0;
  const ByteView bytes(data + 1, size - 1);
  if (input->which == 0) {
    check_frames(bytes);
    return 0;
  }
  if (const auto number = parse_scpi_number(input->text)) fuzz::require_finite(*number);
  MeterSettings settings;
  settings.kind = MeterKind::scpi;
  if (input->which == 2) settings.volts = 19.5;
  if (input->which == 3) settings.amps = 0.5;
  ScpiProtocol scpi(settings);
  take_in_pieces(scpi, bytes, 1 + bytes.size() % 13);
  return 0;
}
