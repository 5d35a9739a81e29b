#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace encore::renderer::gl {

/// What the current context can do, asked once.
struct Capabilities {
  std::string vendor;
  std::string renderer;  ///< as the driver says it: "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string version;   ///< likewise: "4.5 (Core Profile) Mesa 22.3.6"
  int major = 0;
  int minor = 0;
  bool software = false;  ///< a rasteriser that runs on the CPU

  std::uint64_t storage_block_bytes = 0;  ///< the largest storage buffer that a shader may see
  int compute_storage_blocks = 0;         ///< storage buffers that one compute shader may see
  int storage_bindings = 0;               ///< places at which storage buffers can be bound
  std::array<std::uint32_t, 3> workgroups{};
  std::uint32_t workgroup_invocations = 0;
  int texture_size = 0;
  int timestamp_bits = 0;     ///< of the device's clock; 0: it has none
  bool clip_control = false;  ///< GL_ARB_clip_control, or OpenGL 4.5
  bool robust = false;        ///< a lost context is reported, not undefined

  /// For tables and files: the renderer, and ", software, runs on the CPU" where that is so.
  [[nodiscard]] std::string device_name() const;
};

/// Asks the context that is current in this thread.
Capabilities read_capabilities();

/// Whether this GL_RENDERER string is that of a known software rasteriser.
bool is_software_renderer(const std::string& renderer);

/// What a context lacks of what the tracer needs, against what it has; empty if it is good enough:
/// OpenGL 4.3 with enough storage buffers.
std::string compute_obstacle(const Capabilities& found);

/// Throws GlUnavailable, with what is missing and what was found, and the way out, if
/// there is an obstacle.
void require_compute(const Capabilities& found);

}  // namespace encore::renderer::gl
