#include "energy/sources/nvml.h"

#include "energy/sources/nvml_timing.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

namespace encore::energy {

namespace {

constexpr std::uint32_t kPowerInstantField = 186;
/// No board draws more; the library's own mark for "no value" is far above.
constexpr double kMostWatts = 10000.0;
/// A counter updates each 100 ms. A GPU that is on draws power, so one that stands still this long
/// is dead.
constexpr Seconds kCounterDead(3.0);

using Milliwatts = std::variant<double, NvmlCode>;

Milliwatts plausible(double milliwatts) {
  const bool good = std::isfinite(milliwatts) && milliwatts > 0 && milliwatts < kMostWatts * 1e3;
  // 0 W is how some boards say that they measure nothing.
  return good ? Milliwatts(milliwatts) : Milliwatts(NvmlCode::not_supported);
}

std::variant<std::uint64_t, NvmlCode> read_energy(const NvmlLibrary& nvml, NvmlDevice device) {
  if (nvml.total_energy == nullptr) return NvmlCode::function_not_found;
  unsigned long long millijoules = 0;
  const NvmlCode code = nvml.total_energy(device, &millijoules);
  if (code != NvmlCode::ok) return code;
  return std::uint64_t{millijoules};
}

Milliwatts read_instant(const NvmlLibrary& nvml, NvmlDevice device) {
  if (nvml.field_values == nullptr) return NvmlCode::function_not_found;
  NvmlFieldValue value;
  value.field = kPowerInstantField;
  // Stands if a library forgets to fill it in.
  value.result = static_cast<std::int32_t>(NvmlCode::unknown);
  const NvmlCode code = nvml.field_values(device, 1, &value);
  if (code != NvmlCode::ok) return code;
  const auto number = number_of(value);
  if (const double* milliwatts = std::get_if<double>(&number)) return plausible(*milliwatts);
  return number;
}

Milliwatts read_usage(const NvmlLibrary& nvml, NvmlDevice device) {
  if (nvml.power_usage == nullptr) return NvmlCode::function_not_found;
  unsigned milliwatts = 0;
  const NvmlCode code = nvml.power_usage(device, &milliwatts);
  if (code != NvmlCode::ok) return code;
  return plausible(milliwatts);
}

bool will_not_come_back(NvmlCode code) {
  switch (code) {
    case NvmlCode::uninitialized:
    case NvmlCode::not_found:
    case NvmlCode::driver_not_loaded:
    case NvmlCode::gpu_lost:
    case NvmlCode::reset_required:
    case NvmlCode::version_mismatch:
      return true;
    default:
      return false;
  }
}

/// A text that one of NVML's functions writes into a buffer; empty if it does not.
template <std::size_t kSize, class Ask>
std::string text_of(const Ask& ask) {
  std::array<char, kSize + 1> buffer{};
  if (ask(buffer.data(), static_cast<unsigned>(kSize)) != NvmlCode::ok) return {};
  return {buffer.data(), ::strnlen(buffer.data(), kSize)};
}

std::string product_name(const NvmlLibrary& nvml, NvmlDevice device) {
  if (nvml.device_name == nullptr) return {};
  return text_of<96>(
      [&](char* text, unsigned size) { return nvml.device_name(device, text, size); });
}

std::string device_uuid(const NvmlLibrary& nvml, NvmlDevice device) {
  if (nvml.device_uuid == nullptr) return {};
  return text_of<80>(
      [&](char* text, unsigned size) { return nvml.device_uuid(device, text, size); });
}

int main_driver_version(const NvmlLibrary& nvml) {
  if (nvml.driver_version == nullptr) return 0;
  const std::string text = text_of<80>(nvml.driver_version);
  int version = 0;
  std::from_chars(text.data(), text.data() + text.size(), version);
  return version;
}

bool is_partitioned(const NvmlLibrary& nvml, NvmlDevice device) {
  unsigned current = 0;
  unsigned pending = 0;
  return nvml.mig_mode != nullptr && nvml.mig_mode(device, &current, &pending) == NvmlCode::ok &&
         current == 1;
}

/// The way that works, or the code that tells most about why none does.
std::variant<NvmlMethod, NvmlCode> best_method(const NvmlLibrary& nvml, NvmlDevice device) {
  const auto energy = read_energy(nvml, device);
  // A counter of exactly 0 has never counted.
  if (const auto* value = std::get_if<std::uint64_t>(&energy); value != nullptr && *value > 0) {
    return NvmlMethod::counter;
  }
  const Milliwatts instant = read_instant(nvml, device);
  if (std::holds_alternative<double>(instant)) return NvmlMethod::instant;
  const Milliwatts usage = read_usage(nvml, device);
  if (std::holds_alternative<double>(usage)) return NvmlMethod::usage;

  NvmlCode worst = NvmlCode::not_supported;
  const NvmlCode of_usage = std::get<NvmlCode>(usage);
  const NvmlCode of_instant = std::get<NvmlCode>(instant);
  const NvmlCode of_energy =
      std::holds_alternative<NvmlCode>(energy) ? std::get<NvmlCode>(energy) : worst;
  for (const NvmlCode code : {of_usage, of_instant, of_energy}) {
    const bool absent = code == NvmlCode::not_supported || code == NvmlCode::function_not_found ||
                        code == NvmlCode::invalid_argument;
    if (worst == NvmlCode::not_supported && !absent) worst = code;
  }
  return worst;
}

std::string described(NvmlMethod method, const std::optional<NvmlTiming>& timing, bool module,
                      bool partitioned, bool held_awake) {
  std::string text = module ? "the whole module: GPU, processor and their memory"
                            : "the whole board of the GPU: chip, memory, fans and losses";
  if (partitioned) text += ", all MIG instances together";
  switch (method) {
    case NvmlMethod::counter:
      text += ", by the driver's energy counter";
      break;
    case NvmlMethod::instant:
      text += ", by the driver's short-window power";
      break;
    case NvmlMethod::usage:
      text += ", by the driver's power reading";
      break;
  }
  if (timing) {
    text += fmt::format(
        "; the sensor {} the last {:.0f} ms each {:.0f} ms",
        method == NvmlMethod::counter ? "of this generation is known to average" : "averages",
        milliseconds(timing->window), milliseconds(timing->period));
    if (timing->unseen() > 0) {
      text += fmt::format(", so {:.0f} % of the time goes unseen", timing->unseen() * 100);
    }
  }
  if (held_awake) text += "; reading it keeps the GPU from sleeping";
  if (!module) text += "; not the processor";
  return text;
}

}  // namespace

SourceInfo untried_nvml_info(const NvidiaGpu& gpu, const std::string& library) {
  SourceInfo info;
  info.name = fmt::format("nvml:{}", gpu.index);
  info.kind = SourceKind::nvml;
  info.domain = Domain::gpu;
  info.unit = gpu.pci_id.empty() ? std::to_string(gpu.index) : gpu.pci_id;
  info.includes = "the whole board of the GPU: chip, memory, fans and losses; not the processor";
  info.place = fmt::format("{}, GPU {}", library, info.unit);
  info.provenance = {Origin::measured, "NVIDIA's management library (NVML), " + info.unit};
  info.is_counter = true;
  info.update_period = Seconds(0.1);
  info.poll_period = Seconds(0.05);
  info.energy_step = Joules(0.001);
  info.gain_uncertainty = 0.05;
  return info;
}

/// What probing adds to untried_nvml_info.
static SourceInfo probed_info(const NvmlLibrary& nvml, const NvidiaGpu& gpu,
                              const NvmlReadable& found, const std::string& product,
                              bool partitioned) {
  SourceInfo info = untried_nvml_info(gpu, nvml.path());
  if (gpu.pci_id.empty()) {
    if (const std::string uuid = device_uuid(nvml, found.device); !uuid.empty()) info.unit = uuid;
  }
  const bool module = is_module(product);
  if (module) info.domain = Domain::socket;
  info.place = fmt::format("{}, GPU {}", nvml.path(), info.unit);
  if (!product.empty()) info.place += fmt::format(" ({})", product);
  info.provenance.detail = fmt::format("NVIDIA's management library (NVML), {}{}{}", product,
                                       product.empty() ? "" : ", ", info.unit);

  // A counter sums what the same sensor samples, as its short-window gauge shows.
  const auto timing = gauge_timing(generation_of(product), found.method != NvmlMethod::usage,
                                   main_driver_version(nvml));
  info.includes = described(found.method, timing, module, partitioned, gpu.sleeps_when_idle);
  info.is_counter = found.method == NvmlMethod::counter;
  if (info.is_counter) return info;

  info.energy_step.reset();
  info.power_step = Watts(0.001);
  info.update_period = timing ? timing->period : Seconds(0.1);
  info.poll_period = info.update_period / 2;
  // A mean over a window lags by half of it, as smoothing with that time constant would.
  if (timing && timing->window > timing->period) info.smoothing = timing->window / 2;
  if (timing && timing->unseen() > 0) info.gain_uncertainty = 0.1;
  return info;
}

std::variant<NvmlReadable, NvmlFault> probe_nvml(const NvmlSession& session, const NvidiaGpu& gpu) {
  const NvmlLibrary& nvml = session.library();
  NvmlReadable found;
  const NvmlCode code = gpu.pci_id.empty()
                            ? nvml.device_by_index(gpu.index, &found.device)
                            : nvml.device_by_pci_id(gpu.pci_id.c_str(), &found.device);
  if (code != NvmlCode::ok) {
    NvmlFault fault = explain(code);
    if (code == NvmlCode::not_found && !gpu.kernel_driver.empty() &&
        gpu.kernel_driver != "nvidia") {
      fault.reason += fmt::format(": the kernel driver '{}' runs it", gpu.kernel_driver);
    }
    return fault;
  }

  const std::string product = product_name(nvml, found.device);
  const bool partitioned = is_partitioned(nvml, found.device);
  const auto method = best_method(nvml, found.device);
  if (const NvmlCode* failure = std::get_if<NvmlCode>(&method)) {
    NvmlFault fault = explain(*failure);
    if (!product.empty()) fault.reason = fmt::format("{}: {}", product, fault.reason);
    if (partitioned) {
      fault.reason += " (it is split into MIG instances, whose power is not measured)";
      fault.fix = "measure where the whole GPU is visible, or switch MIG off";
    }
    return fault;
  }
  found.method = std::get<NvmlMethod>(method);
  found.info = probed_info(nvml, gpu, found, product, partitioned);
  return found;
}

NvmlSource::NvmlSource(std::shared_ptr<NvmlSession> session, NvmlReadable readable)
    : session_(std::move(session)), readable_(std::move(readable)) {}

std::string NvmlSource::message(const NvmlFault& fault) const {
  std::string text = fmt::format("{}: {}", readable_.info.place, fault.reason);
  if (!fault.fix.empty()) text += "; " + fault.fix;
  return text;
}

ReadResult NvmlSource::read(Seconds now) {
  return readable_.method == NvmlMethod::counter ? read_counter(now) : read_gauge(now);
}

ReadResult NvmlSource::read_counter(Seconds now) {
  const auto energy = read_energy(session_->library(), readable_.device);
  ReadResult result;
  if (const NvmlCode* code = std::get_if<NvmlCode>(&energy)) {
    failed_ = true;
    result.state = will_not_come_back(*code) ? ReadState::lost : ReadState::failed;
    result.message = message(explain(*code));
    return result;
  }
  const std::uint64_t value = std::get<std::uint64_t>(energy);
  const bool first = !last_millijoules_;
  const bool changed = first || value != *last_millijoules_;
  if (changed) last_change_ = now;
  if (!changed && now - last_change_ > kCounterDead) {
    failed_ = true;
    result.message = message(
        {fmt::format("its energy counter has stood still for {:.0f} s", (now - last_change_).value),
         "reload the driver if it stays so"});
    return result;
  }

  result.state = ReadState::ok;
  if (!first && value < *last_millijoules_) {
    result.state = ReadState::restarted;
    result.message = message({"its energy counter began anew: the driver was reloaded", ""});
  } else if (!first) {
    sum_millijoules_ += value - *last_millijoules_;
    if (failed_) {
      result.state = ReadState::restarted;
      result.message = message({"readings are back", ""});
    }
  }
  failed_ = false;
  last_millijoules_ = value;
  result.reading = {.time = now,
                    .energy = Joules(static_cast<double>(sum_millijoules_) * 1e-3),
                    .power = std::nullopt,
                    .changed = changed};
  return result;
}

ReadResult NvmlSource::read_gauge(Seconds now) {
  const NvmlLibrary& nvml = session_->library();
  const Milliwatts power = readable_.method == NvmlMethod::instant
                               ? read_instant(nvml, readable_.device)
                               : read_usage(nvml, readable_.device);
  if (const NvmlCode* code = std::get_if<NvmlCode>(&power)) {
    const std::string text = message(explain(*code));
    return will_not_come_back(*code) ? integral_.lost(text) : integral_.failed(text);
  }
  return integral_.add(now, Watts(std::get<double>(power) * 1e-3));
}

}  // namespace encore::energy
