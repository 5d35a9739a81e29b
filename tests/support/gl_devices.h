#pragma once

#include "renderer/gl/context.h"

#include <string>

namespace encore::test {

/// Why no listed OpenGL device can be used by whoever makes a context of their own; empty if one
/// can.
inline std::string why_no_gl_device() {
  std::string problem;
  for (const renderer::gl::DeviceListing& device : renderer::gl::list_devices(&problem)) {
    if (device.usable) return {};
    problem += " " + device.name + ": " + device.problem;
  }
  return "no OpenGL device to test with:" + problem;
}

}  // namespace encore::test
