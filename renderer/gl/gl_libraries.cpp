#include "renderer/gl/gl_libraries.h"

#include "renderer/gl/error.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string>

namespace encore::renderer::gl {

namespace {

/// Loads a library for good: drivers do not survive being unloaded.
void require_library(const char* name, const char* package) {
  if (dlopen(name, RTLD_NOW | RTLD_GLOBAL) != nullptr) return;
  const char* reason = dlerror();
  throw GlUnavailable(
      fmt::format("there is no OpenGL on this machine: {}; install the GPU's driver, or {} and "
                  "libgl1-mesa-dri (Debian, Ubuntu), or use --device cpu",
                  reason != nullptr ? reason : name, package));
}

}  // namespace

void require_gl_libraries(bool with_egl) {
  if (with_egl) require_library("libEGL.so.1", "libegl1, libgl1");
  require_library("libGL.so.1", "libgl1");
}

}  // namespace encore::renderer::gl
