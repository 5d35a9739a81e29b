#include "app/gpu_device.h"

#include <utility>

namespace encore::app {

GpuContext::GpuContext(std::optional<int> device, Maker make)
    : device_(device), make_(std::move(make)) {}

std::shared_ptr<renderer::gl::Context> GpuContext::get() {
  if (context_ == nullptr) context_ = make_(device_);
  context_->make_current();
  return context_;
}

GpuInfo GpuContext::info() {
  const renderer::gl::Capabilities& found = get()->capabilities();
  return {found.device_name(), found.version};
}

void add_gl_device_option(CLI::App& command, std::optional<int>& device) {
  command
      .add_option("--gl-device", device,
                  "The graphics device for gpu and raster, by its number in 'encore doctor'; "
                  "default: the best there is")
      ->check(CLI::Range(0, 255));
}

}  // namespace encore::app
