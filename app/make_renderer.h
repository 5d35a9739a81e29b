#pragma once

#include "app/device.h"
#include "app/gpu_device.h"
#include "renderer/renderer.h"

#include <memory>

namespace encore::app {

/// The renderer of a device: the one place that chooses among them. For devices that trace rays it
/// is a renderer::Tracer. `threads`: of the CPU; 0: all. `gpu` is asked for its context only by
/// devices that use OpenGL. Throws GlUnavailable or GlError.
std::unique_ptr<renderer::Renderer> make_renderer(Device device, int threads, GpuContext& gpu);

}  // namespace encore::app
