#pragma once

#include <epoxy/egl.h>

#include <memory>
#include <string>
#include <vector>

namespace encore::renderer::gl {

/// A place where an OpenGL context without a window may be had.
struct EglCandidate {
  enum class Kind { device, surfaceless, default_display };
  Kind kind;
  EGLDeviceEXT device = nullptr;  ///< of devices only
  bool software = false;          ///< the device says so
  std::string file;               ///< the device's, "/dev/dri/renderD128", where it is known
  std::string name;               ///< "EGL device 0 (/dev/dri/renderD128)"
};

/// All of this machine's: devices, hardware before software, then Mesa's surfaceless platform and
/// the default display. Throws GlUnavailable if there is no EGL library.
std::vector<EglCandidate> egl_candidates();

/// An initialised display, terminated with the last one that refers to it.
class EglDisplay {
 public:
  /// Throws GlUnavailable with EGL's reason.
  explicit EglDisplay(const EglCandidate& candidate);
  ~EglDisplay();
  EglDisplay(const EglDisplay&) = delete;
  EglDisplay& operator=(const EglDisplay&) = delete;

  [[nodiscard]] EGLDisplay get() const { return display_; }
  [[nodiscard]] bool at_least(int major, int minor) const;
  [[nodiscard]] bool has(const char* extension) const;

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLint major_ = 0;
  EGLint minor_ = 0;
};

/// Makes what is current in this thread now current again at its end, unless told to forget it.
class EglCurrentGuard {
 public:
  EglCurrentGuard();
  ~EglCurrentGuard();
  EglCurrentGuard(const EglCurrentGuard&) = delete;
  EglCurrentGuard& operator=(const EglCurrentGuard&) = delete;

  [[nodiscard]] EGLContext context() const { return context_; }
  void forget() { context_ = EGL_NO_CONTEXT; }

 private:
  EGLDisplay display_;
  EGLSurface draw_;
  EGLSurface read_;
  EGLContext context_;  ///< none: nothing to go back to
};

/// "EGL_BAD_MATCH", …
std::string egl_error_name(EGLint error);

}  // namespace encore::renderer::gl
