#pragma once

#include "renderer/gl/context.h"

#include <string>
#include <vector>

namespace encore::app {

/// What the doctor found out about OpenGL.
struct OpenGlReport {
  std::vector<renderer::gl::DeviceListing> devices;
  std::string problem;  ///< why there are no devices at all, with the way out

  [[nodiscard]] bool any_usable() const;
};

/// Starts a context on every device, which may wake a sleeping GPU. Never throws.
OpenGlReport examine_opengl();

/// For people: each device with what it offers or what is in its way, and the way out if none is
/// usable.
std::string opengl_text(const OpenGlReport& report);
/// An object.
std::string opengl_json(const OpenGlReport& report);

}  // namespace encore::app
