// find_nvml: which GPUs there are, without waking one that sleeps.
#include "energy/sources/discovery.h"
#include "energy/sources/nvml.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

namespace encore::energy {

namespace {

constexpr std::string_view kPciFolder = "/sys/bus/pci/devices";

/// NVIDIA's display controllers as the kernel lists them; these files wake nothing.
std::vector<NvidiaGpu> list_gpus(const SensorRoot& root) {
  std::vector<NvidiaGpu> gpus;
  for (const std::string& id : root.list(kPciFolder)) {
    const std::string folder = fmt::format("{}/{}", kPciFolder, id);
    const FileText vendor = root.read(folder + "/vendor");
    const FileText type = root.read(folder + "/class");
    if (vendor.text != "0x10de" || !type.text || !type.text->starts_with("0x03")) continue;
    NvidiaGpu gpu;
    gpu.index = static_cast<unsigned>(gpus.size());
    gpu.pci_id = id;
    std::error_code error;
    const auto driver = std::filesystem::read_symlink(root.resolve(folder + "/driver"), error);
    if (!error) gpu.kernel_driver = driver.filename().string();
    const FileText status = root.read(folder + "/power/runtime_status");
    gpu.asleep = status.text == "suspended" || status.text == "suspending";
    gpu.sleeps_when_idle = root.read(folder + "/power/control").text == "auto";
    gpus.push_back(std::move(gpu));
  }
  return gpus;
}

Finding absent(const NvmlFault& fault) {
  Finding finding;
  finding.info.name = "nvml";
  finding.info.kind = SourceKind::nvml;
  finding.info.domain = Domain::gpu;
  finding.info.includes = "NVIDIA GPUs";
  finding.info.place = "libnvidia-ml.so.1";
  finding.info.provenance = {Origin::unavailable, fault.reason};
  finding.obstacle = Obstacle{fault.reason, fault.fix};
  return finding;
}

std::string one_line(const std::string& place, const NvmlFault& fault) {
  return fmt::format("{}: {}{}{}", place, fault.reason, fault.fix.empty() ? "" : "; ", fault.fix);
}

std::unique_ptr<PowerSource> open_gpu(const std::shared_ptr<NvmlLibrary>& library,
                                      const NvidiaGpu& gpu) {
  const std::string place = untried_nvml_info(gpu, library->path()).place;
  auto started = library->start();
  if (const auto* fault = std::get_if<NvmlFault>(&started)) {
    throw SensorError(one_line(place, *fault));
  }
  auto session = std::get<std::shared_ptr<NvmlSession>>(std::move(started));
  auto readable = probe_nvml(*session, gpu);
  if (const auto* fault = std::get_if<NvmlFault>(&readable)) {
    throw SensorError(one_line(place, *fault));
  }
  return std::make_unique<NvmlSource>(std::move(session), std::get<NvmlReadable>(readable));
}

Finding usable(const std::shared_ptr<NvmlLibrary>& library, const NvidiaGpu& gpu, SourceInfo info) {
  Finding finding;
  finding.info = std::move(info);
  finding.open = [library, gpu] { return open_gpu(library, gpu); };
  return finding;
}

/// What to say of a GPU while some GPU of the machine sleeps, so that NVML must not be started.
Finding untried(const std::shared_ptr<NvmlLibrary>& library, const NvidiaGpu& gpu) {
  Finding finding = usable(library, gpu, untried_nvml_info(gpu, library->path()));
  if (gpu.asleep) {
    finding.set_aside = fmt::format(
        "the GPU sleeps; reading it would wake it and keep it awake, which costs some watts: name "
        "{} yourself if the run renders on it",
        finding.info.name);
  }
  return finding;
}

Finding probed(const std::shared_ptr<NvmlLibrary>& library, const NvmlSession& session,
               const NvidiaGpu& gpu) {
  const auto readable = probe_nvml(session, gpu);
  if (const auto* found = std::get_if<NvmlReadable>(&readable)) {
    return usable(library, gpu, found->info);
  }
  const auto& fault = std::get<NvmlFault>(readable);
  Finding finding;
  finding.info = untried_nvml_info(gpu, library->path());
  finding.info.provenance = {Origin::unavailable, fault.reason};
  finding.obstacle =
      Obstacle{fmt::format("GPU {}: {}", finding.info.unit, fault.reason), fault.fix};
  return finding;
}

}  // namespace

std::vector<Finding> find_nvml(const SensorRoot& root, const std::string& library_path) {
  if (!root.is_real() && library_path.empty()) {
    return {
        absent({"NVML is a library of this machine and knows nothing of the folder given as "
                "sensor root",
                ""})};
  }
  std::vector<NvidiaGpu> gpus = list_gpus(root);
  auto loaded = NvmlLibrary::load(library_path);
  if (auto* fault = std::get_if<NvmlFault>(&loaded)) {
    if (!gpus.empty()) {
      fault->reason += fmt::format(" (the NVIDIA GPU {} is there)", gpus.front().pci_id);
    }
    return {absent(*fault)};
  }
  const auto library = std::get<std::shared_ptr<NvmlLibrary>>(loaded);

  std::vector<Finding> findings;
  bool one_sleeps = false;
  for (const NvidiaGpu& gpu : gpus) one_sleeps = one_sleeps || gpu.asleep;
  if (one_sleeps) {
    for (const NvidiaGpu& gpu : gpus) findings.push_back(untried(library, gpu));
    return findings;
  }

  auto started = library->start();
  if (const auto* fault = std::get_if<NvmlFault>(&started)) return {absent(*fault)};
  const auto& session = *std::get<std::shared_ptr<NvmlSession>>(started);
  if (gpus.empty()) {
    // WSL, embedded boards and some containers show no PCI devices; runtime power management is
    // not in this kernel's hands there.
    unsigned count = 0;
    const NvmlCode code = library->device_count(&count);
    if (code != NvmlCode::ok) return {absent(explain(code))};
    gpus.resize(count);
    for (unsigned i = 0; i < count; ++i) gpus[i].index = i;
  }
  for (const NvidiaGpu& gpu : gpus) findings.push_back(probed(library, session, gpu));
  if (findings.empty()) {
    return {absent({"NVIDIA's driver is loaded but shows no GPU",
                    "in a container pass the GPU in (--gpus all)"})};
  }
  return findings;
}

}  // namespace encore::energy
