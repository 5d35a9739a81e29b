#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace encore::app {

/// Who draws.
enum class Device {
  cpu,     ///< traces rays on all cores
  gpu,     ///< traces rays in OpenGL compute shaders, through a copy of the CPU's structure
  raster,  ///< OpenGL's own pipeline: no rays, no structure; what ray tracing is compared with
};
/// The words of command line and files.
std::string_view to_string(Device device);
std::optional<Device> parse_device(std::string_view name);
/// All of them, in their order.
std::span<const Device> all_devices();
/// "unknown device 'gpo', did you mean 'gpu'?; there are cpu, gpu, raster".
std::string unknown_device(std::string_view name);

/// Whether it draws with OpenGL.
bool uses_opengl(Device device);
/// Whether it traces rays, and so needs a structure.
bool traces_rays(Device device);

}  // namespace encore::app
