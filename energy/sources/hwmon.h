#pragma once

#include "energy/sources/gauge_integral.h"
#include "energy/sources/hwmon_chips.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace encore::energy {

/// A channel that shows watts, integrated here.
class HwmonGauge final : public PowerSource {
 public:
  HwmonGauge(HwmonChannel channel, SensorFiles files);
  [[nodiscard]] const SourceInfo& info() const override { return channel_.info; }
  ReadResult read(Seconds now) override;

 private:
  HwmonChannel channel_;
  SensorFiles files_;
  GaugeIntegral integral_;
};

/// A channel that counts microjoules. A fall or an impossible leap is a reset: what lies before it
/// is not joined to what follows.
class HwmonCounter final : public PowerSource {
 public:
  HwmonCounter(HwmonChannel channel, SensorFiles files);
  [[nodiscard]] const SourceInfo& info() const override { return channel_.info; }
  ReadResult read(Seconds now) override;

 private:
  ReadResult join(Seconds now, std::uint64_t counted);

  HwmonChannel channel_;
  SensorFiles files_;
  std::optional<std::uint64_t> last_;
  Seconds last_change_;
  Joules energy_;
  bool failed_ = false;
};

/// As declared in discovery.h, with files that a test supplies.
std::vector<Finding> find_hwmon(const SensorFiles& files);

}  // namespace encore::energy
