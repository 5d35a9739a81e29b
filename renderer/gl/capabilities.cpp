#include "renderer/gl/capabilities.h"

#include "renderer/gl/error.h"
#include "shaders/shared/bindings.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace encore::renderer::gl {

namespace {

std::string text_of(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

int integer_of(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

void read_compute_limits(Capabilities& found) {
  GLint64 block = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block);
  found.storage_block_bytes = static_cast<std::uint64_t>(std::max<GLint64>(block, 0));
  found.compute_storage_blocks = integer_of(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS);
  found.storage_bindings = integer_of(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS);
  for (GLuint axis = 0; axis < 3; ++axis) {
    GLint count = 0;
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, axis, &count);
    // Some drivers say 2^32 - 1, which reads as -1.
    found.workgroups[axis] = static_cast<std::uint32_t>(count);
  }
  found.workgroup_invocations =
      static_cast<std::uint32_t>(integer_of(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS));
}

}  // namespace

std::string Capabilities::device_name() const {
  return software ? renderer + ", software, runs on the CPU" : renderer;
}

bool is_software_renderer(const std::string& renderer) {
  std::string lower = renderer;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  // Layers (zink, virgl, ANGLE, D3D12) name what they run on, so that a part of the name decides.
  constexpr std::string_view kNames[] = {"llvmpipe",
                                         "softpipe",
                                         "swrast",
                                         "swiftshader",
                                         "lavapipe",
                                         "software rasterizer",
                                         "software renderer",
                                         "openswr",
                                         "swr (",
                                         "microsoft basic render",
                                         "gdi generic"};
  return std::any_of(std::begin(kNames), std::end(kNames),
                     [&](std::string_view name) { return lower.find(name) != std::string::npos; });
}

Capabilities read_capabilities() {
  Capabilities found;
  found.vendor = text_of(GL_VENDOR);
  found.renderer = text_of(GL_RENDERER);
  found.version = text_of(GL_VERSION);
  found.major = integer_of(GL_MAJOR_VERSION);
  found.minor = integer_of(GL_MINOR_VERSION);
  found.software = is_software_renderer(found.renderer);
  found.texture_size = integer_of(GL_MAX_TEXTURE_SIZE);
  const int version = 10 * found.major + found.minor;
  if (version >= 43) read_compute_limits(found);
  if (version >= 33) glGetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &found.timestamp_bits);
  found.clip_control = version >= 45 || epoxy_has_gl_extension("GL_ARB_clip_control");
  const bool tells_resets = version >= 45 || epoxy_has_gl_extension("GL_KHR_robustness") ||
                            epoxy_has_gl_extension("GL_ARB_robustness");
  found.robust = tells_resets &&
                 integer_of(GL_RESET_NOTIFICATION_STRATEGY_ARB) == GL_LOSE_CONTEXT_ON_RESET_ARB;
  return found;
}

std::string compute_obstacle(const Capabilities& found) {
  if (10 * found.major + found.minor < 43) {
    return fmt::format("OpenGL 4.3 is needed for GPU ray tracing; {} offers {}",
                       found.device_name(), found.version);
  }
  // Storage buffers that the largest tracing program sees at once, and where they are bound.
  constexpr int kBlocks = 10;
  constexpr int kBindings = ENCORE_BINDING_PAUSED_COUNT + 1;
  if (found.compute_storage_blocks < kBlocks || found.storage_bindings < kBindings) {
    return fmt::format(
        "{} storage buffers at {} binding points are needed in a compute shader; {} (OpenGL {}) "
        "offers {} at {}",
        kBlocks, kBindings, found.device_name(), found.version, found.compute_storage_blocks,
        found.storage_bindings);
  }
  return {};
}

void require_compute(const Capabilities& found) {
  const std::string obstacle = compute_obstacle(found);
  if (obstacle.empty()) return;
  throw GlUnavailable(obstacle +
                      "; update the graphics driver, choose another device with --gl-device "
                      "(encore doctor lists them), or use --device cpu");
}

}  // namespace encore::renderer::gl
