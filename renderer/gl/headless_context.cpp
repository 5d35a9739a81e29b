#include "renderer/gl/headless_context.h"

#include "renderer/gl/error.h"

#include <fmt/format.h>

#include <vector>

namespace encore::renderer::gl {

namespace {

/// Where a context can be had without a config, none is needed.
EGLConfig choose_config(const EglDisplay& display, bool pbuffer) {
  if (!pbuffer && display.has("EGL_KHR_no_config_context")) return EGL_NO_CONFIG_KHR;
  const EGLint wanted[] = {EGL_SURFACE_TYPE, pbuffer ? EGL_PBUFFER_BIT : 0,  //
                           EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display.get(), wanted, &config, 1, &count) != EGL_TRUE || count < 1) {
    throw GlUnavailable("it has no configuration for OpenGL, perhaps for OpenGL ES alone");
  }
  return config;
}

EGLContext create_context(const EglDisplay& display, EGLConfig config, int minor, bool robust) {
  const bool egl15 = display.at_least(1, 5);
  std::vector<EGLint> attributes{
      EGL_CONTEXT_MAJOR_VERSION,       4,
      EGL_CONTEXT_MINOR_VERSION,       minor,
      EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
  const auto add = [&](EGLint name, EGLint value) {
    attributes.insert(attributes.end(), {name, value});
  };
  if (robust) {
    add(EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET);
    if (egl15) {
      add(EGL_CONTEXT_OPENGL_ROBUST_ACCESS, EGL_TRUE);
    } else {
      add(EGL_CONTEXT_FLAGS_KHR, EGL_CONTEXT_OPENGL_ROBUST_ACCESS_BIT_KHR);
    }
  }
  attributes.push_back(EGL_NONE);
  return eglCreateContext(display.get(), config, EGL_NO_CONTEXT, attributes.data());
}

/// The highest version that there is; robust if the driver offers it.
EGLContext create_newest_context(const EglDisplay& display, EGLConfig config) {
  if (!display.at_least(1, 5) && !display.has("EGL_KHR_create_context")) {
    throw GlUnavailable("its EGL cannot be asked for a version of OpenGL (EGL_KHR_create_context)");
  }
  EGLint error = EGL_SUCCESS;
  for (const int minor : {6, 5, 3}) {
    for (const bool robust : {true, false}) {
      const EGLContext context = create_context(display, config, minor, robust);
      if (context != EGL_NO_CONTEXT) return context;
      error = eglGetError();
    }
  }
  // Too old is no reason to say nothing: whoever asked reads the version and the name.
  const EGLint any[] = {EGL_NONE};
  const EGLContext context = eglCreateContext(display.get(), config, EGL_NO_CONTEXT, any);
  if (context != EGL_NO_CONTEXT) return context;
  throw GlUnavailable(
      fmt::format("it gives no context of OpenGL 4.3 or any other ({})", egl_error_name(error)));
}

class HeadlessContext final : public Context {
 public:
  explicit HeadlessContext(const EglCandidate& candidate) : display_(candidate) {
    // Per thread, and OpenGL ES if never set.
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) {
      throw GlUnavailable("its EGL offers OpenGL ES alone, not OpenGL");
    }
    EglCurrentGuard before;
    try {
      start();
    } catch (...) {
      stop();
      throw;
    }
    before.forget();
  }
  ~HeadlessContext() override {
    // Programs can only be deleted in their context.
    EglCurrentGuard before;
    if (before.context() == context_) before.forget();
    if (eglMakeCurrent(display_.get(), surface_, surface_, context_) == EGL_TRUE) programs_ = {};
    stop();
  }

  void make_current() override {
    if (eglGetCurrentContext() == context_) return;
    eglBindAPI(EGL_OPENGL_API);
    if (eglMakeCurrent(display_.get(), surface_, surface_, context_) != EGL_TRUE) {
      throw GlError(fmt::format("the OpenGL context of {} cannot be made current ({})",
                                capabilities_.renderer, egl_error_name(eglGetError())));
    }
  }

 private:
  void start() {
    const bool pbuffer = !display_.has("EGL_KHR_surfaceless_context");
    const EGLConfig config = choose_config(display_, pbuffer);
    context_ = create_newest_context(display_, config);
    if (pbuffer) {
      const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
      surface_ = eglCreatePbufferSurface(display_.get(), config, size);
    }
    if (eglMakeCurrent(display_.get(), surface_, surface_, context_) != EGL_TRUE) {
      throw GlUnavailable(
          fmt::format("its context cannot be made current ({})", egl_error_name(eglGetError())));
    }
    capabilities_ = read_capabilities();
  }

  void stop() {
    if (context_ != EGL_NO_CONTEXT && eglGetCurrentContext() == context_) {
      eglMakeCurrent(display_.get(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_.get(), surface_);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_.get(), context_);
  }

  EglDisplay display_;
  EGLSurface surface_ = EGL_NO_SURFACE;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::shared_ptr<Context> start_headless_context(const EglCandidate& candidate) {
  return std::make_shared<HeadlessContext>(candidate);
}

}  // namespace encore::renderer::gl
