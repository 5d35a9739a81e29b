#pragma once

#include "energy/sources/meter.h"

#include <cstddef>

namespace encore::energy {

/// RDTech's USB meters UM24C, UM25C and UM34C over their serial Bluetooth link: one byte asks, a
/// frame of 130 bytes answers, high byte first. A frame is known by its model and its end mark
/// (UM34C: check byte), so that reading falls into step again after lost or foreign bytes.
class Um25cProtocol final : public MeterProtocol {
 public:
  static constexpr std::size_t kFrameSize = 130;

  [[nodiscard]] MeterFacts facts() const override;
  [[nodiscard]] unsigned usual_baud() const override { return 115200; }
  [[nodiscard]] std::string request() const override { return "\xf0"; }
  std::vector<MeterSample> take(std::span<const std::uint8_t> bytes, Seconds time) override;

  /// Bytes that belonged to no frame, so far.
  [[nodiscard]] std::size_t skipped() const { return skipped_; }

 private:
  Bytes pending_;
  std::size_t skipped_ = 0;
  std::uint16_t model_ = 0;
};

}  // namespace encore::energy
