#include "energy/sources/hwmon_chips.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <system_error>

namespace encore::energy {

namespace {

/// A chip that is being looked at.
struct Chip {
  const SensorFiles& files;
  std::string folder;
  std::string name;
  std::string device;

  [[nodiscard]] std::string path(const std::string& file) const { return folder + "/" + file; }
  /// Whether the file exists, without reading it: that could wake the device.
  [[nodiscard]] bool has(const std::string& file) const {
    std::error_code error;
    return std::filesystem::exists(files.root().resolve(path(file)), error);
  }
  [[nodiscard]] std::string text(const std::string& file) const {
    return files.text(path(file)).value_or("");
  }
};

HwmonChannel channel_of(const Chip& chip, const std::string& suffix, HwmonForm form,
                        std::vector<std::string> inputs) {
  HwmonChannel channel;
  channel.form = form;
  channel.folder = chip.folder;
  channel.chip = chip.name;
  channel.device = chip.device;
  channel.files = std::move(inputs);
  SourceInfo& info = channel.info;
  info.kind = SourceKind::hwmon;
  // A chip without a device has only its number, which may be another one after the next start.
  const std::string where =
      chip.device.empty() ? chip.folder.substr(chip.folder.rfind('/') + 1) : chip.device;
  info.name = fmt::format("hwmon:{}-{}", chip.name, where);
  if (!suffix.empty()) info.name += "/" + suffix;
  info.place = chip.path(channel.files.front());
  info.unit = where;
  info.is_counter = form == HwmonForm::energy;
  info.update_period = Seconds(0.1);
  info.poll_period = Seconds(0.05);
  info.provenance = {Origin::measured, fmt::format("{} through hwmon", chip.name)};
  return channel;
}

/// A sensor can be switched off; its input then has no data.
void check_enabled(const Chip& chip, const std::string& input, HwmonChannel& channel) {
  const std::string enable = chip.path(input + "_enable");
  if (chip.files.integer(enable) != 0) return;
  channel.obstacle = Obstacle{enable + " is 0: the sensor is switched off",
                              fmt::format("echo 1 | sudo tee {}", enable)};
}

std::string missing_text(const Chip& chip, std::string_view wanted) {
  return fmt::format("{} ({}): no {}", chip.folder, chip.name, wanted);
}

/// Polling keeps a card awake that would otherwise fall asleep on its own.
void mark_gpu(const Chip& chip, HwmonChannel& channel) {
  channel.is_gpu = true;
  channel.info.domain = Domain::gpu;
  if (hwmon_asleep(chip.files, chip.folder, chip.device)) {
    channel.obstacle = Obstacle{
        fmt::format("{} ({} {}): the GPU is asleep (runtime_status is not active), and reading its "
                    "sensors would wake it",
                    chip.folder, chip.name, chip.device),
        "start what renders on it first, then look again"};
  } else if (chip.text("device/power/control") == "auto") {
    channel.info.includes += "; while it is read, the card does not fall asleep";
  }
}

std::vector<HwmonChannel> amdgpu(const Chip& chip) {
  std::vector<std::string> inputs;
  // The mean loses nothing between readings; newer cards have only one of the two.
  for (const char* file : {"power1_average", "power1_input"}) {
    if (chip.has(file)) inputs.emplace_back(file);
  }
  const bool found = !inputs.empty();
  if (!found) inputs.emplace_back("power1_average");
  HwmonChannel channel = channel_of(chip, "", HwmonForm::power, inputs);
  const std::string label = chip.has("power1_label") ? chip.text("power1_label") : "";
  // Only APUs measure the voltage of a north bridge or limit their power in two speeds.
  channel.is_apu = chip.has("in1_input") || label == "slowPPT" || label == "fastPPT";
  channel.info.includes =
      channel.is_apu ? "the APU's socket: processor cores and GPU together; not the memory modules"
                     : "the graphics card as its driver tells; some cards leave the memory and the "
                       "voltage converters out";
  mark_gpu(chip, channel);
  if (channel.is_apu) channel.info.domain = Domain::socket;
  if (!found) channel.obstacle = Obstacle{missing_text(chip, "power1_average or power1_input"), ""};
  check_enabled(chip, "power1", channel);
  if (!channel.is_apu && !chip.has("device/gpu_metrics")) {
    channel.may_hang = true;
    channel.set_aside =
        "a card before gpu_metrics: reading the power of some of these hangs in the driver; name "
        "the source to use it (it is read with a time limit)";
  }
  return {channel};
}

std::vector<HwmonChannel> i915(const Chip& chip) {
  // An integrated GPU has no energy here, and is part of the processor package anyway.
  if (!chip.has("energy1_input")) return {};
  HwmonChannel channel = channel_of(chip, "", HwmonForm::energy, {"energy1_input"});
  channel.info.includes = "the graphics card as its driver tells";
  mark_gpu(chip, channel);
  check_enabled(chip, "energy1", channel);
  return {channel};
}

std::vector<HwmonChannel> xe(const Chip& chip) {
  const bool card = chip.has("energy1_input");
  const bool package = chip.has("energy2_input");
  if (!card && !package) return {};
  HwmonChannel channel = channel_of(chip, "", HwmonForm::energy, {"energy1_input"});
  mark_gpu(chip, channel);
  std::uint64_t counted = 0;
  if (card && !channel.obstacle) {
    counted = parse_unsigned(chip.text("energy1_input")).value_or(0);
  }
  // A card's counter that stays at 0 is not connected; the chip package's is the next best.
  const bool by_card = card && (counted > 0 || !package);
  const char* includes = by_card
                             ? "the whole graphics card as its driver tells"
                             : "the GPU's chip package with its memory; not the rest of the card";
  channel.info.includes = includes + channel.info.includes;
  if (!by_card) {
    channel.files = {"energy2_input"};
    channel.info.place = chip.path("energy2_input");
  }
  check_enabled(chip, by_card ? "energy1" : "energy2", channel);
  return {channel};
}

void name_shunt(HwmonChannel& channel, const std::string& label) {
  channel.info.domain = Domain::system;
  channel.info.gain_uncertainty = 0.01;
  channel.info.includes = fmt::format("what flows through the shunt of {}{}{}", channel.chip,
                                      label.empty() ? "" : ", ", label);
  channel.set_aside =
      "only the board's maker knows what this shunt feeds; name the source if it is what you want";
}

/// One bus voltage (in1), one current; in0 is the voltage across the shunt.
std::vector<HwmonChannel> ina2xx(const Chip& chip) {
  const bool power = chip.has("power1_input");
  if (!power && !(chip.has("in1_input") && chip.has("curr1_input"))) return {};
  HwmonChannel channel =
      power ? channel_of(chip, "", HwmonForm::power, {"power1_input"})
            : channel_of(chip, "", HwmonForm::product, {"in1_input", "curr1_input"});
  name_shunt(channel, chip.text("power1_label"));
  for (const char* input : {"power1", "in1", "curr1"}) check_enabled(chip, input, channel);
  return {channel};
}

/// Three pairs inN, currN; in4 and above are voltages across the shunts and their sum.
std::vector<HwmonChannel> ina3221(const Chip& chip) {
  std::vector<HwmonChannel> channels;
  for (const char* n : {"1", "2", "3"}) {
    const std::string in = std::string("in") + n;
    const std::string current = std::string("curr") + n;
    if (!chip.has(in + "_input") || !chip.has(current + "_input")) continue;
    HwmonChannel channel =
        channel_of(chip, n, HwmonForm::product, {in + "_input", current + "_input"});
    channel.info.unit += std::string("/") + n;
    name_shunt(channel, chip.text(in + "_label"));
    check_enabled(chip, in, channel);
    channels.push_back(std::move(channel));
  }
  return channels;
}

std::vector<HwmonChannel> corsairpsu(const Chip& chip) {
  if (!chip.has("power1_input")) return {};
  HwmonChannel channel = channel_of(chip, "", HwmonForm::power, {"power1_input"});
  channel.info.unit.clear();
  channel.info.includes =
      "everything that the power supply unit feeds; not its own losses, not the screen";
  channel.info.update_period = Seconds(1.0);
  channel.info.poll_period = Seconds(0.3);
  return {channel};
}

std::vector<HwmonChannel> acpi_meter(const Chip& chip) {
  if (!chip.has("power1_average")) return {};
  HwmonChannel channel = channel_of(chip, "", HwmonForm::power, {"power1_average"});
  SourceInfo& info = channel.info;
  info.unit.clear();
  info.includes = "the whole machine as its firmware measures it at the power supplies";
  const auto interval = chip.files.integer(chip.path("power1_average_interval"));
  const double seconds = interval && *interval > 0 ? static_cast<double>(*interval) / 1e3 : 1.0;
  info.update_period = Seconds(seconds);
  info.smoothing = Seconds(interval && *interval > 0 ? seconds : 0.0);
  info.poll_period = Seconds(std::clamp(seconds / 2, 0.1, 1.0));
  // "98.5%": how far the firmware trusts itself.
  const std::string accuracy = chip.text("power1_accuracy");
  const auto percent = parse_unsigned(accuracy.substr(0, accuracy.find_first_of(".%")));
  if (percent && *percent >= 50 && *percent < 100) {
    info.gain_uncertainty = (100.0 - static_cast<double>(*percent)) / 100.0;
  }
  check_enabled(chip, "power1", channel);
  return {channel};
}

using Rule = std::vector<HwmonChannel> (*)(const Chip&);
struct NamedRule {
  std::string_view name;
  Rule rule;
};
constexpr std::array kRules = {
    NamedRule{"amdgpu", amdgpu},
    NamedRule{"i915", i915},
    NamedRule{"xe", xe},
    NamedRule{"ina219", ina2xx},
    NamedRule{"ina220", ina2xx},
    NamedRule{"ina226", ina2xx},
    NamedRule{"ina230", ina2xx},
    NamedRule{"ina231", ina2xx},
    NamedRule{"ina237", ina2xx},
    NamedRule{"ina238", ina2xx},
    NamedRule{"ina3221", ina3221},
    NamedRule{"corsairpsu", corsairpsu},
    NamedRule{"power_meter", acpi_meter},
};

}  // namespace

std::string hwmon_device(const SensorFiles& files, const std::string& folder) {
  std::error_code error;
  const auto device = std::filesystem::canonical(files.root().resolve(folder + "/device"), error);
  return error ? std::string() : device.filename().string();
}

bool hwmon_asleep(const SensorFiles& files, const std::string& folder, const std::string& device) {
  auto status = files.text(folder + "/device/power/runtime_status");
  if (!status) status = files.text("/sys/bus/pci/devices/" + device + "/power/runtime_status");
  return status && *status != "active" && *status != "unsupported";
}

std::vector<HwmonChannel> hwmon_channels(const SensorFiles& files, const std::string& folder) {
  const Chip chip{files, folder, files.text(folder + "/name").value_or(""),
                  hwmon_device(files, folder)};
  for (const NamedRule& known : kRules) {
    if (chip.name == known.name) return known.rule(chip);
  }
  // The firmware's power meter has gone by more than one name.
  if (chip.device.starts_with("ACPI000D")) return acpi_meter(chip);
  return {};
}

}  // namespace encore::energy
