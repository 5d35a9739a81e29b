#include "energy/sources/meter_um25c.h"

#include <array>

namespace encore::energy {

namespace {

constexpr std::uint16_t kUm24c = 0x0963;
constexpr std::uint16_t kUm25c = 0x09c9;
constexpr std::uint16_t kUm34c = 0x0d4c;
constexpr std::uint16_t kEndMark = 0xfff1;

// Where a frame holds what.
constexpr std::size_t kVoltsAt = 2;
constexpr std::size_t kAmpsAt = 4;
constexpr std::size_t kEnergyAt = 106;  // of the threshold recorder, mWh
constexpr std::size_t kEndAt = 128;

constexpr double kJoulesPerMilliwattHour = 3.6;

/// The UM34C's last byte is the exclusive or of these bytes of its frame.
constexpr std::array<std::uint8_t, 32> kChecked{1,  3,  7,  9,  15,  17,  19,  23,  31,  39, 41,
                                                45, 49, 53, 55, 57,  59,  63,  67,  69,  73, 79,
                                                83, 89, 97, 99, 109, 111, 113, 119, 121, 127};

using Frame = std::span<const std::uint8_t>;

std::uint16_t u16_at(Frame frame, std::size_t offset) {
  return static_cast<std::uint16_t>(frame[offset] << 8U | frame[offset + 1]);
}

std::uint32_t u32_at(Frame frame, std::size_t offset) {
  return static_cast<std::uint32_t>(u16_at(frame, offset)) << 16U | u16_at(frame, offset + 2);
}

bool is_model(std::uint16_t word) {
  return word == kUm24c || word == kUm25c || word == kUm34c;
}

bool is_whole(Frame frame) {
  if (u16_at(frame, 0) != kUm34c) return u16_at(frame, kEndAt) == kEndMark;
  std::uint8_t sum = 0;
  for (const std::uint8_t position : kChecked) sum ^= frame[position];
  return sum == frame[Um25cProtocol::kFrameSize - 1];
}

MeterSample sample_of(Frame frame, Seconds time) {
  // The UM25C has a digit more of both than its sisters.
  const bool fine = u16_at(frame, 0) == kUm25c;
  MeterSample sample;
  sample.time = time;
  sample.volts = u16_at(frame, kVoltsAt) * (fine ? 1e-3 : 1e-2);
  sample.amps = u16_at(frame, kAmpsAt) * (fine ? 1e-4 : 1e-3);
  sample.energy = Joules(u32_at(frame, kEnergyAt) * kJoulesPerMilliwattHour);
  return sample;
}

}  // namespace

MeterFacts Um25cProtocol::facts() const {
  MeterFacts facts;
  facts.name = model_ == kUm24c ? "um24c" : model_ == kUm34c ? "um34c" : "um25c";
  facts.product = model_ == kUm24c   ? "RDTech UM24C"
                  : model_ == kUm34c ? "RDTech UM34C"
                                     : "RDTech UM25C";
  facts.includes =
      "everything that flows through the USB meter: the whole machine, and what charges its "
      "battery "
      "unless that is full or taken out";
  facts.update_period = Seconds(0.1);
  // One digit of the current at 20 V.
  const bool fine = model_ == kUm25c;
  facts.power_step = Watts(20 * (fine ? 1e-4 : 1e-3));
  facts.gain_uncertainty = fine ? 0.005 : 0.01;
  return facts;
}

std::vector<MeterSample> Um25cProtocol::take(std::span<const std::uint8_t> bytes, Seconds time) {
  pending_.insert(pending_.end(), bytes.begin(), bytes.end());
  std::vector<MeterSample> samples;
  std::size_t at = 0;
  while (pending_.size() - at >= 2) {
    const Frame rest = Frame(pending_).subspan(at);
    if (is_model(u16_at(rest, 0))) {
      if (rest.size() < kFrameSize) break;
      if (is_whole(rest)) {
        model_ = u16_at(rest, 0);
        samples.push_back(sample_of(rest, time));
        at += kFrameSize;
        continue;
      }
    }
    ++at;
    ++skipped_;
  }
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(at));
  return samples;
}

}  // namespace encore::energy
