#include "app/gpu_device.h"

#include "app/session_input.h"

#include <utility>

namespace encore::app {

std::vector<energy::KeyValue> gpu_settings(const std::optional<GpuInfo>& gpu) {
  if (!gpu) return {};
  return {{"gl_renderer", gpu->name}, {"gl_version", gpu->version}};
}

std::optional<GpuInfo> gpu_of(const energy::SessionInfo& info) {
  GpuInfo gpu{configuration_value(info.settings, "gl_renderer"),
              configuration_value(info.settings, "gl_version")};
  if (gpu.name.empty()) return std::nullopt;
  return gpu;
}

GpuContext::GpuContext(std::optional<int> device, Maker make)
    : device_(device), make_(std::move(make)) {}

std::shared_ptr<renderer::gl::Context> GpuContext::get() {
  if (context_ == nullptr) context_ = make_(device_);
  context_->make_current();
  return context_;
}

GpuInfo GpuContext::info() {
  const renderer::gl::Capabilities& found = get()->capabilities();
  return {found.device_name(), found.version, found.software};
}

void add_gl_device_option(CLI::App& command, std::optional<int>& device) {
  command
      .add_option("--gl-device", device,
                  "The graphics device for gpu and raster, by its number in 'encore doctor'; "
                  "default: the best there is")
      ->check(CLI::Range(0, 255));
}

}  // namespace encore::app
