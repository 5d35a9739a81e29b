#include "energy/sources/nvml_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <mutex>
#include <utility>

namespace encore::energy {

namespace {

/// Guards every library's start and end: NVML itself is safe to call from any thread.
std::mutex& session_mutex() {
  static std::mutex mutex;
  return mutex;
}

constexpr const char* kSoname = "libnvidia-ml.so.1";

/// Where the loader does not look by itself: WSL, NixOS, and a name without a version.
constexpr const char* kPlaces[] = {
    kSoname,
    "libnvidia-ml.so",
    "/usr/lib/wsl/lib/libnvidia-ml.so.1",
    "/run/opengl-driver/lib/libnvidia-ml.so.1",
};

template <class F>
bool find(void* handle, const char* name, F& function) {
  // POSIX promises that a function's address survives this cast.
  function = reinterpret_cast<F>(::dlsym(handle, name));
  return function != nullptr;
}

std::string last_loader_error() {
  const char* text = ::dlerror();
  return text != nullptr ? text : "unknown error of the loader";
}

NvmlFault no_library() {
  return {fmt::format("{} not found: no NVIDIA driver is installed", kSoname),
          "on a machine with an NVIDIA GPU install NVIDIA's driver; in a container let the runtime "
          "pass it in (--gpus all with the driver capability 'utility')"};
}

}  // namespace

NvmlFault explain(NvmlCode code) {
  switch (code) {
    case NvmlCode::ok:
      return {"no error", ""};
    case NvmlCode::uninitialized:
      return {"NVML is not started", ""};
    case NvmlCode::invalid_argument:
      return {"NVML took an argument for invalid", "update NVIDIA's driver"};
    case NvmlCode::not_supported:
      return {"this GPU does not report its power",
              "many laptop and embedded GPUs measure none: use the battery or an external meter"};
    case NvmlCode::no_permission:
      return {"permission denied by the driver",
              "give the user access to /dev/nvidia* or, in a container, pass these devices in"};
    case NvmlCode::not_found:
      return {"NVIDIA's driver does not know this GPU",
              "check with nvidia-smi that the driver, not nouveau or vfio, runs it"};
    case NvmlCode::driver_not_loaded:
      return {"NVIDIA's kernel driver is not loaded", "sudo modprobe nvidia"};
    case NvmlCode::function_not_found:
      return {"the library lacks this function", "update NVIDIA's driver"};
    case NvmlCode::gpu_lost:
      return {"the GPU fell off the bus", "look into the kernel log (dmesg) and reboot"};
    case NvmlCode::reset_required:
      return {"the GPU must be reset before it can be used",
              "sudo nvidia-smi --gpu-reset, or reboot"};
    case NvmlCode::version_mismatch:
      return {
          "NVIDIA's library and kernel driver are of different versions (the driver was updated "
          "while it ran)",
          "reboot, or unload and load the nvidia kernel modules"};
    case NvmlCode::unknown:
      break;
  }
  return {fmt::format("NVML failed with error {}", static_cast<int>(code)),
          "see whether nvidia-smi works"};
}

std::variant<double, NvmlCode> number_of(const NvmlFieldValue& value) {
  if (value.result != 0) return static_cast<NvmlCode>(value.result);
  switch (value.value_type) {
    case 0:
      return value.as_double;
    case 1:
      return static_cast<double>(value.as_u32);
    // Two of the types are 64 bits wide on every Linux that NVIDIA ships to.
    case 2:
    case 3:
      return static_cast<double>(value.as_u64);
    default:
      return NvmlCode::unknown;
  }
}

NvmlLibrary::NvmlLibrary(void* handle, std::string path)
    : handle_(handle), path_(std::move(path)) {}

NvmlLibrary::~NvmlLibrary() {
  ::dlclose(handle_);
}

std::string NvmlLibrary::look_up() {
  find(handle_, "nvmlDeviceGetName", device_name);
  find(handle_, "nvmlDeviceGetUUID", device_uuid);
  find(handle_, "nvmlSystemGetDriverVersion", driver_version);
  find(handle_, "nvmlDeviceGetMigMode", mig_mode);
  find(handle_, "nvmlDeviceGetPowerUsage", power_usage);
  find(handle_, "nvmlDeviceGetTotalEnergyConsumption", total_energy);
  find(handle_, "nvmlDeviceGetFieldValues", field_values);

  if (!find(handle_, "nvmlInit_v2", init)) return "nvmlInit_v2";
  if (!find(handle_, "nvmlShutdown", shutdown)) return "nvmlShutdown";
  if (!find(handle_, "nvmlDeviceGetCount_v2", device_count)) return "nvmlDeviceGetCount_v2";
  if (!find(handle_, "nvmlDeviceGetHandleByIndex_v2", device_by_index)) {
    return "nvmlDeviceGetHandleByIndex_v2";
  }
  if (!find(handle_, "nvmlDeviceGetHandleByPciBusId_v2", device_by_pci_id)) {
    return "nvmlDeviceGetHandleByPciBusId_v2";
  }
  return {};
}

std::variant<std::shared_ptr<NvmlLibrary>, NvmlFault> NvmlLibrary::load(const std::string& path) {
  void* handle = nullptr;
  std::string found = path;
  std::string broken;
  if (!path.empty()) {
    handle = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) broken = last_loader_error();
  } else {
    for (const char* place : kPlaces) {
      handle = ::dlopen(place, RTLD_NOW | RTLD_LOCAL);
      found = place;
      if (handle != nullptr) break;
      // A library that is there but does not load (wrong architecture, missing parts) has a reason
      // of its own; one that is not there has not.
      const std::string error = last_loader_error();
      if (error.find("No such file or directory") == std::string::npos) broken = error;
    }
  }
  if (handle == nullptr && broken.empty()) return no_library();
  if (handle == nullptr) {
    return NvmlFault{"NVIDIA's management library does not load: " + broken,
                     "install the driver's libraries for this architecture"};
  }
  // The constructor is private, so make_shared cannot call it.
  std::shared_ptr<NvmlLibrary> library(new NvmlLibrary(handle, std::move(found)));
  if (const std::string missing = library->look_up(); !missing.empty()) {
    return NvmlFault{
        fmt::format("{} lacks {}: it is too old or not NVIDIA's", library->path(), missing),
        "update NVIDIA's driver"};
  }
  return library;
}

std::variant<std::shared_ptr<NvmlSession>, NvmlFault> NvmlLibrary::start() {
  const std::lock_guard lock(session_mutex());
  if (auto running = session_.lock()) return running;
  const NvmlCode code = init();
  if (code != NvmlCode::ok) return explain(code);
  auto session = std::make_shared<NvmlSession>(shared_from_this());
  session_ = session;
  return session;
}

NvmlSession::NvmlSession(std::shared_ptr<NvmlLibrary> library) : library_(std::move(library)) {}

NvmlSession::~NvmlSession() {
  // A session that starts at this moment has its own nvmlInit, which NVML counts.
  const std::lock_guard lock(session_mutex());
  library_->shutdown();
}

}  // namespace encore::energy
