#include "energy/sources/hwmon.h"

#include "energy/sources/timed_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>

namespace encore::energy {

namespace {

constexpr std::string_view kClass = "/sys/class/hwmon";
constexpr Seconds kLongestGap{10.0};
/// No card takes so much; a counter that says so was set anew.
constexpr Watts kMostPower{5000.0};
constexpr std::chrono::milliseconds kHangLimit{1000};

/// What reading one file of a channel gave: a number, or why not.
template <class Integer>
struct Input {
  std::optional<Integer> value;
  std::string message;
  bool gone = false;
};

std::string message_of(const SensorFiles& files, const std::string& path, int error) {
  switch (error) {
    case ENODATA:
      return path + ": the sensor has no data (it is switched off, or the device asleep)";
    case ETIMEDOUT:
      return path + ": the driver does not answer; use another source for this device";
    case ENOENT:
    case ENODEV:
      return path + ": the device is gone; look for sources again";
    default:
      return files.describe(path, error);
  }
}

template <class Integer>
Input<Integer> read_input(const SensorFiles& files, const HwmonChannel& channel,
                          const std::string& file,
                          std::optional<Integer> (*parse)(std::string_view)) {
  const std::string path = channel.folder + "/" + file;
  const FileText content = files.read(path);
  Input<Integer> input;
  if (!content.text) {
    input.message = message_of(files, path, content.error);
    input.gone = content.error == ENOENT || content.error == ENODEV;
    return input;
  }
  input.value = parse(*content.text);
  if (!input.value) input.message = fmt::format("{}: '{}' is no number", path, *content.text);
  return input;
}

/// What a gauge shows.
Input<std::int64_t> read_gauge(const SensorFiles& files, const HwmonChannel& channel,
                               const std::string& file) {
  return read_input(files, channel, file, parse_integer);
}
/// A counter; it uses all 64 bits.
Input<std::uint64_t> read_counter(const SensorFiles& files, const HwmonChannel& channel) {
  return read_input(files, channel, channel.files.front(), parse_unsigned);
}

/// All bits set, in each unit that the 16-bit value is passed on in: the firmware does not know.
bool is_invalid_amd(std::int64_t microwatts, bool is_apu) {
  constexpr std::int64_t kAllBits = 0xFFFF;
  // An APU's value may also be taken for watts and 1/256 W, and so come out as 255 W and 255 mW.
  return microwatts == kAllBits * 1000 || microwatts == kAllBits * 1'000'000 ||
         (is_apu && microwatts == 255'255'000);
}

std::string asleep_message(const HwmonChannel& channel) {
  return fmt::format("{} ({} {}): the GPU fell asleep; it is not woken", channel.folder,
                     channel.chip, channel.device);
}

/// hwmonN may have become another chip since it was found.
bool is_same_chip(const SensorFiles& files, const HwmonChannel& channel) {
  return files.text(channel.folder + "/name").value_or("") == channel.chip &&
         hwmon_device(files, channel.folder) == channel.device;
}

/// One of several files that say the same: the first that can be read.
void keep_readable(const SensorFiles& files, HwmonChannel& channel) {
  const auto readable = std::find_if(
      channel.files.begin(), channel.files.end(),
      [&](const std::string& file) { return read_gauge(files, channel, file).value.has_value(); });
  const auto chosen = readable == channel.files.end() ? channel.files.begin() : readable;
  channel.files = {std::string(*chosen)};
}

std::unique_ptr<PowerSource> open_channel(HwmonChannel channel, const SensorFiles& files) {
  if (!is_same_chip(files, channel)) {
    throw SensorError(
        fmt::format("{}: no longer the {} {} that was found there; look for sources again",
                    channel.folder, channel.chip, channel.device));
  }
  SensorFiles own = files;
  if (channel.may_hang) {
    own = SensorFiles(
        files.root(),
        timed_reader([files](std::string_view path) { return files.read(path); }, kHangLimit));
  }
  if (channel.form == HwmonForm::energy) {
    return std::make_unique<HwmonCounter>(std::move(channel), std::move(own));
  }
  return std::make_unique<HwmonGauge>(std::move(channel), std::move(own));
}

/// Why a sensor cannot be read right now; empty if it can.
std::string failure(const SensorFiles& files, const HwmonChannel& channel) {
  if (channel.form == HwmonForm::energy) return read_counter(files, channel).message;
  std::string message;
  for (const std::string& file : channel.files) {
    const auto input = read_gauge(files, channel, file);
    // Several files of power say the same; a product needs both.
    if (input.value && channel.form == HwmonForm::power) return {};
    if (!input.value) message = input.message;
  }
  return message;
}

Finding finding_of(const SensorFiles& files, const HwmonChannel& channel) {
  Finding finding;
  finding.info = channel.info;
  finding.obstacle = channel.obstacle;
  finding.set_aside = channel.set_aside;
  if (!finding.obstacle && !channel.may_hang) {
    const std::string why = failure(files, channel);
    if (!why.empty()) finding.obstacle = Obstacle{why, ""};
  }
  if (finding.obstacle) {
    finding.info.provenance = {Origin::unavailable, finding.obstacle->reason};
  } else {
    finding.open = [channel, files] { return open_channel(channel, files); };
  }
  return finding;
}

}  // namespace

HwmonGauge::HwmonGauge(HwmonChannel channel, SensorFiles files)
    : channel_(std::move(channel)), files_(std::move(files)), integral_(kLongestGap) {
  if (channel_.form == HwmonForm::power) keep_readable(files_, channel_);
}

ReadResult HwmonGauge::read(Seconds now) {
  if (channel_.is_gpu && hwmon_asleep(files_, channel_.folder, channel_.device)) {
    return integral_.failed(asleep_message(channel_));
  }
  const auto without = [&](const Input<std::int64_t>& input) {
    return input.gone ? integral_.lost(input.message) : integral_.failed(input.message);
  };
  const auto first = read_gauge(files_, channel_, channel_.files.front());
  if (!first.value) return without(first);
  if (channel_.form == HwmonForm::power) {
    if (channel_.chip == "amdgpu" && is_invalid_amd(*first.value, channel_.is_apu)) {
      return integral_.failed(
          fmt::format("{}/{}: {} means that the firmware does not know the power", channel_.folder,
                      channel_.files.front(), *first.value));
    }
    return integral_.add(now, Watts(static_cast<double>(*first.value) / 1e6));
  }
  const auto second = read_gauge(files_, channel_, channel_.files.back());
  if (!second.value) return without(second);
  // Millivolts times milliamperes.
  const double microwatts = static_cast<double>(*first.value) * static_cast<double>(*second.value);
  return integral_.add(now, Watts(microwatts / 1e6));
}

HwmonCounter::HwmonCounter(HwmonChannel channel, SensorFiles files)
    : channel_(std::move(channel)), files_(std::move(files)) {}

ReadResult HwmonCounter::read(Seconds now) {
  const auto without = [&](ReadState state, std::string message) {
    failed_ = last_.has_value();
    ReadResult result;
    result.state = state;
    result.message = std::move(message);
    return result;
  };
  if (channel_.is_gpu && hwmon_asleep(files_, channel_.folder, channel_.device)) {
    return without(ReadState::failed, asleep_message(channel_));
  }
  const auto counted = read_counter(files_, channel_);
  if (!counted.value) {
    return without(counted.gone ? ReadState::lost : ReadState::failed, counted.message);
  }
  return join(now, *counted.value);
}

ReadResult HwmonCounter::join(Seconds now, std::uint64_t counted) {
  ReadResult result;
  result.state = ReadState::ok;
  const bool changed = !last_ || counted != *last_;
  if (last_ && !failed_) {
    const Joules step(counted < *last_ ? 0.0 : static_cast<double>(counted - *last_) / 1e6);
    // A counter moves in steps: what it gained may stem from as long as it stood still, and a step.
    const Seconds since = now - last_change_ + channel_.info.update_period;
    if (counted < *last_ || step > kMostPower * since) {
      result.state = ReadState::restarted;
      result.message = fmt::format(
          "{}: the counter was set anew ({} after {}); the energy in between is unknown",
          channel_.info.place, counted, *last_);
    } else {
      energy_ += step;
    }
  } else if (failed_) {
    result.state = ReadState::restarted;
    result.message = channel_.info.place + ": readings are back; the energy in between is unknown";
  }
  failed_ = false;
  last_ = counted;
  if (changed || result.state == ReadState::restarted) last_change_ = now;
  result.reading = {.time = now, .energy = energy_, .power = std::nullopt, .changed = changed};
  return result;
}

std::vector<Finding> find_hwmon(const SensorFiles& files) {
  std::vector<Finding> findings;
  std::string unknown;
  for (const std::string& entry : files.list(kClass)) {
    const std::string folder = fmt::format("{}/{}", kClass, entry);
    const std::vector<HwmonChannel> channels = hwmon_channels(files, folder);
    for (const HwmonChannel& channel : channels) findings.push_back(finding_of(files, channel));
    if (!channels.empty()) continue;
    const std::string name = files.text(folder + "/name").value_or("");
    if (!name.empty()) unknown += (unknown.empty() ? "" : ", ") + name;
  }
  if (!findings.empty()) return findings;
  Finding none;
  none.info.kind = SourceKind::hwmon;
  none.info.name = "hwmon";
  none.info.place = kClass;
  std::string why = fmt::format("no power sensor below {}", kClass);
  if (!unknown.empty()) why += fmt::format(" ({} tell no power that is known here)", unknown);
  none.info.provenance.detail = why;
  none.obstacle = Obstacle{why, ""};
  return {none};
}

std::vector<Finding> find_hwmon(const SensorRoot& root) {
  return find_hwmon(SensorFiles(root));
}

}  // namespace encore::energy
