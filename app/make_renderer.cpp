#include "app/make_renderer.h"

#include "renderer/cpu_tracer.h"
#include "renderer/gpu_tracer.h"
#include "renderer/raster_renderer.h"

namespace encore::app {

std::unique_ptr<renderer::Renderer> make_renderer(Device device, int threads, GpuContext& gpu) {
  switch (device) {
    case Device::cpu:
      return std::make_unique<renderer::CpuTracer>(threads);
    case Device::gpu:
      return std::make_unique<renderer::GpuTracer>(gpu.get());
    case Device::raster:
      return std::make_unique<renderer::RasterRenderer>(gpu.get());
  }
  return nullptr;
}

}  // namespace encore::app
