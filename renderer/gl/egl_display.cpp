#include "renderer/gl/egl_display.h"

#include "renderer/gl/error.h"
#include "renderer/gl/gl_libraries.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <map>
#include <mutex>
#include <string_view>

namespace encore::renderer::gl {

namespace {

/// Asked of EGL itself: libepoxy ends the process for a function that it thinks is not there.
template <class Function>
Function function(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

/// The extensions that need no display; none on EGL before 1.5 without EGL_EXT_client_extensions.
std::string client_extensions() {
  const char* text = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (text == nullptr) eglGetError();
  return text != nullptr ? text : "";
}

bool listed(const std::string& extensions, const char* name) {
  return epoxy_extension_in_string(extensions.c_str(), name);
}

// EGL_DRM_RENDER_NODE_FILE_EXT, which older headers lack.
constexpr EGLint kDrmRenderNodeFile = 0x3377;

std::string device_string(EGLDeviceEXT device, EGLint name) {
  const auto query = function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  const char* text = query != nullptr ? query(device, name) : nullptr;
  return text != nullptr ? text : "";
}

EglCandidate describe_device(EGLDeviceEXT device, int index) {
  const std::string extensions = device_string(device, EGL_EXTENSIONS);
  EglCandidate found{EglCandidate::Kind::device, device, false, {}, {}};
  found.software = listed(extensions, "EGL_MESA_device_software");
  // Drawing needs the render node alone; drivers before it existed use the other file.
  if (listed(extensions, "EGL_EXT_device_drm_render_node")) {
    found.file = device_string(device, kDrmRenderNodeFile);
  }
  if (found.file.empty() && listed(extensions, "EGL_EXT_device_drm")) {
    found.file = device_string(device, EGL_DRM_DEVICE_FILE_EXT);
  }
  const std::string what = found.software ? "software" : found.file;
  found.name = fmt::format("EGL device {}{}", index, what.empty() ? "" : " (" + what + ")");
  return found;
}

/// Why a device's file cannot be used, with the way out; empty if that is not the reason.
std::string file_obstacle(const std::string& file) {
  if (file.empty() || access(file.c_str(), R_OK | W_OK) == 0) return {};
  if (errno == EACCES) {
    return fmt::format(": no permission for {}; add yourself to its group (render or video)", file);
  }
  return fmt::format(": {} is not there; a container must be given it", file);
}

std::vector<EglCandidate> device_candidates(const std::string& extensions) {
  std::vector<EglCandidate> found;
  const bool usable = listed(extensions, "EGL_EXT_platform_device") &&
                      (listed(extensions, "EGL_EXT_device_enumeration") ||
                       listed(extensions, "EGL_EXT_device_base"));
  const auto query = function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  EGLint count = 0;
  if (!usable || query == nullptr || query(0, nullptr, &count) != EGL_TRUE || count <= 0) return {};
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (query(count, devices.data(), &count) != EGL_TRUE) return {};
  devices.resize(static_cast<std::size_t>(std::max(count, 0)));
  found.reserve(devices.size());
  for (EGLDeviceEXT device : devices) {
    found.push_back(describe_device(device, static_cast<int>(found.size())));
  }
  std::stable_partition(found.begin(), found.end(),
                        [](const EglCandidate& candidate) { return !candidate.software; });
  return found;
}

EGLDisplay display_of(const EglCandidate& candidate) {
  const auto platform = function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  switch (candidate.kind) {
    case EglCandidate::Kind::device:
      return platform ? platform(EGL_PLATFORM_DEVICE_EXT, candidate.device, nullptr) : nullptr;
    case EglCandidate::Kind::surfaceless:
      return platform ? platform(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)
                      : nullptr;
    case EglCandidate::Kind::default_display:
      return eglGetDisplay(EGL_DEFAULT_DISPLAY);
  }
  return EGL_NO_DISPLAY;
}

// EGL does not count who uses a display: whoever terminates it takes it from all.
std::mutex display_mutex;
std::map<EGLDisplay, int> display_users;

}  // namespace

std::vector<EglCandidate> egl_candidates() {
  // Reasons for failure are told by us; Mesa's warnings on the way there only confuse.
  static const bool quiet = setenv("EGL_LOG_LEVEL", "fatal", 0) == 0;
  (void)quiet;
  require_gl_libraries(true);
  const std::string extensions = client_extensions();
  std::vector<EglCandidate> found = device_candidates(extensions);
  if (listed(extensions, "EGL_MESA_platform_surfaceless")) {
    found.push_back({EglCandidate::Kind::surfaceless, nullptr, false, {}, "EGL without a surface"});
  }
  found.push_back(
      {EglCandidate::Kind::default_display, nullptr, false, {}, "EGL's default display"});
  return found;
}

EglDisplay::EglDisplay(const EglCandidate& candidate) {
  const std::lock_guard lock(display_mutex);
  display_ = display_of(candidate);
  if (display_ == EGL_NO_DISPLAY) {
    throw GlUnavailable(fmt::format("no display ({})", egl_error_name(eglGetError())));
  }
  if (eglInitialize(display_, &major_, &minor_) != EGL_TRUE) {
    throw GlUnavailable(fmt::format("the display does not start ({}){}",
                                    egl_error_name(eglGetError()), file_obstacle(candidate.file)));
  }
  ++display_users[display_];
}

EglDisplay::~EglDisplay() {
  const std::lock_guard lock(display_mutex);
  if (--display_users[display_] > 0) return;
  display_users.erase(display_);
#if !defined(__SANITIZE_ADDRESS__)
  // Unloads the driver, too: the sanitizer could not tell its leaks (tests/lsan.supp) from ours.
  eglTerminate(display_);
#endif
}

bool EglDisplay::at_least(int major, int minor) const {
  return major_ > major || (major_ == major && minor_ >= minor);
}

bool EglDisplay::has(const char* extension) const {
  const char* text = eglQueryString(display_, EGL_EXTENSIONS);
  return text != nullptr && epoxy_extension_in_string(text, extension);
}

EglCurrentGuard::EglCurrentGuard()
    : display_(eglGetCurrentDisplay()),
      draw_(eglGetCurrentSurface(EGL_DRAW)),
      read_(eglGetCurrentSurface(EGL_READ)),
      context_(eglGetCurrentContext()) {}

EglCurrentGuard::~EglCurrentGuard() {
  if (context_ != EGL_NO_CONTEXT) eglMakeCurrent(display_, draw_, read_, context_);
}

std::string egl_error_name(EGLint error) {
  switch (error) {
    case EGL_SUCCESS:
      return "no reason given";
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
      return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
      return "EGL_BAD_CONFIG";
    case EGL_BAD_CONTEXT:
      return "EGL_BAD_CONTEXT";
    case EGL_BAD_DISPLAY:
      return "EGL_BAD_DISPLAY";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
      return "EGL_BAD_PARAMETER";
    case EGL_BAD_SURFACE:
      return "EGL_BAD_SURFACE";
    case EGL_CONTEXT_LOST:
      return "EGL_CONTEXT_LOST";
    default:
      return fmt::format("EGL error 0x{:04x}", error);
  }
}

}  // namespace encore::renderer::gl
