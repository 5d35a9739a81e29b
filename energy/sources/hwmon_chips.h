#pragma once

#include "energy/sources/discovery.h"
#include "energy/sources/sensor_files.h"

#include <optional>
#include <string>
#include <vector>

namespace encore::energy {

/// How the power of a hwmon channel is told.
enum class HwmonForm {
  power,    ///< powerN_*: microwatts
  product,  ///< inN (mV) times currN (mA)
  energy,   ///< energyN_input: microjoules that count up
};

/// One power channel of a hwmon chip whose meaning is known. Chips that are not listed are left
/// alone: which of their inputs belong together cannot be guessed.
struct HwmonChannel {
  SourceInfo info;
  HwmonForm form = HwmonForm::power;
  std::string folder;              ///< "/sys/class/hwmon/hwmon3"
  std::string chip;                ///< the content of its `name`
  std::string device;              ///< where it is plugged in: "0000:03:00.0"; empty if untold
  std::vector<std::string> files;  ///< below the folder; two of them for a product
  bool is_gpu = false;             ///< asleep, it must not be asked: reading would wake it
  bool is_apu = false;
  bool may_hang = false;  ///< reading is known to hang in some drivers: read with a time limit
  std::optional<Obstacle> obstacle;
  std::string set_aside;
};

/// The channels of one chip; none if it is unknown.
std::vector<HwmonChannel> hwmon_channels(const SensorFiles& files, const std::string& folder);

/// What the kernel says of a chip's device: its name on its bus ("0000:03:00.0"), empty if it has
/// none.
std::string hwmon_device(const SensorFiles& files, const std::string& folder);

/// Whether the device sleeps or is about to; reading its sensors would wake it. Where the kernel
/// does not say, it does not sleep.
bool hwmon_asleep(const SensorFiles& files, const std::string& folder, const std::string& device);

}  // namespace encore::energy
