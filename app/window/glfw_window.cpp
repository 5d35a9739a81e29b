#include "app/window/glfw_window.h"

#include <epoxy/gl.h>
// After OpenGL's own declarations.
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace encore::app {

namespace {

std::string last_glfw_error;  // GLFW's error handler has no room for a pointer

void remember_error(int code, const char* text) {
  last_glfw_error = fmt::format("{} (GLFW error {:#x})", text, code);
}

GlfwWindow& window_of(GLFWwindow* window) {
  return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window));
}

/// GLFW names keys by their place on a US keyboard; shortcuts mean the letter that is printed on
/// them.
int key_by_letter(int key, int code) {
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_EQUAL) return key;
  const char* name = glfwGetKeyName(key, code);
  if (name == nullptr || name[0] == '\0' || name[1] != '\0') return key;
  const char letter = name[0];
  if (letter >= 'a' && letter <= 'z') return GLFW_KEY_A + (letter - 'a');
  if (letter >= 'A' && letter <= 'Z') return GLFW_KEY_A + (letter - 'A');
  if (letter >= '0' && letter <= '9') return GLFW_KEY_0 + (letter - '0');
  if (letter == '+') return GLFW_KEY_KP_ADD;
  if (letter == '-') return GLFW_KEY_MINUS;
  return key;
}

constexpr const char* kWayOut =
    "open it from a desktop session (or set DISPLAY), or use the commands that need none: encore "
    "profile, encore render, encore --help";

}  // namespace

/// GLFW calls plain functions.
struct GlfwCallbacks {
  static void drop(GLFWwindow* window, int count, const char** paths) {
    window_of(window).dropped_.insert(window_of(window).dropped_.end(), paths, paths + count);
    window_of(window).input_ = true;
  }
  static void any(GLFWwindow* window) { window_of(window).input_ = true; }
  static void key(GLFWwindow* window, int key, int code, int action, int modifiers) {
    any(window);
    window_of(window).pass_key({key_by_letter(key, code), code, action, modifiers});
  }
  static void install(GLFWwindow* window) {
    glfwSetDropCallback(window, drop);
    glfwSetKeyCallback(window, key);
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned letter) {
      any(w);
      ImGui_ImplGlfw_CharCallback(w, letter);
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int modifiers) {
      any(w);
      ImGui_ImplGlfw_MouseButtonCallback(w, button, action, modifiers);
      window_of(w).pass_button(button, action == GLFW_PRESS);
    });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
      any(w);
      ImGui_ImplGlfw_ScrollCallback(w, x, y);
    });
    glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
      any(w);
      ImGui_ImplGlfw_CursorEnterCallback(w, entered);
    });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
      any(w);
      ImGui_ImplGlfw_WindowFocusCallback(w, focused);
    });
    glfwSetMonitorCallback(ImGui_ImplGlfw_MonitorCallback);
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double, double) { any(w); });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { any(w); });
    glfwSetWindowRefreshCallback(window, any);
    glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { any(w); });
  }
  static void APIENTRY gl_message(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* text,
                                  const void* user) {
    if (type != GL_DEBUG_TYPE_ERROR) return;
    auto& window = *static_cast<GlfwWindow*>(const_cast<void*>(user));
    if (window.gl_errors_++ == 0) window.first_gl_error_ = text;
  }
};

GlfwWindow::GlfwWindow(const Setup& setup) {
  glfwSetErrorCallback(remember_error);
  if (glfwInit() != GLFW_TRUE) {
    throw WindowUnavailable(
        fmt::format("no window can be opened here: {}; {}", last_glfw_error, kWayOut));
  }
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, setup.debug ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_FALSE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "encore");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "encore");
  // No larger than the screen.
  int width = std::max(setup.width, 320);
  int height = std::max(setup.height, 240);
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
    int x = 0, y = 0, w = 0, h = 0;
    glfwGetMonitorWorkarea(monitor, &x, &y, &w, &h);
    if (w > 0 && h > 0) {
      width = std::min(width, w);
      height = std::min(height, h);
    }
  }
  window_ = glfwCreateWindow(width, height, "ENCORE", nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string why = last_glfw_error;
    glfwTerminate();
    throw WindowUnavailable(fmt::format(
        "the window needs OpenGL 4.3, which this display does not give: {}; update the graphics "
        "driver, or use the commands that need none (encore doctor tells what is there)",
        why));
  }
  glfwSetWindowUserPointer(window_, this);
  glfwSetWindowSizeLimits(window_, 320, 240, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  renderer_name_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  if (setup.debug) watch_gl_errors();
  GlfwCallbacks::install(window_);
  set_icon();

  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // what is kept lies in the program's own files
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  ImGui_ImplGlfw_InitForOpenGL(window_, false);
  ImGui_ImplOpenGL3_Init("#version 430 core");
}

GlfwWindow::~GlfwWindow() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void GlfwWindow::watch_gl_errors() {
  if (glDebugMessageCallback == nullptr) return;
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(GlfwCallbacks::gl_message, this);
}

void GlfwWindow::set_icon() {
  // A box of boxes with a trace of power across it, drawn here so that no file is needed.
  constexpr int kSide = 48;
  std::vector<unsigned char> pixels(static_cast<std::size_t>(kSide) * kSide * 4);
  const auto put = [&pixels](int x, int y, unsigned char r, unsigned char g, unsigned char b) {
    const std::size_t at = (static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)) * 4;
    pixels[at] = r;
    pixels[at + 1] = g;
    pixels[at + 2] = b;
    pixels[at + 3] = 255;
  };
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) put(x, y, 27, 32, 43);
  }
  const auto box = [&put](int x0, int y0, int x1, int y1, unsigned char r, unsigned char g,
                          unsigned char b) {
    for (int x = x0; x <= x1; ++x) {
      for (const int y : {y0, y0 + 1, y1 - 1, y1}) put(x, y, r, g, b);
    }
    for (int y = y0; y <= y1; ++y) {
      for (const int x : {x0, x0 + 1, x1 - 1, x1}) put(x, y, r, g, b);
    }
  };
  box(4, 4, 43, 43, 120, 170, 255);
  box(9, 9, 24, 38, 110, 220, 190);
  box(28, 18, 38, 38, 110, 220, 190);
  constexpr int kTrace[] = {30, 29, 30, 28, 14, 13, 14, 15, 30, 29, 30, 20, 21, 20, 29, 30};
  for (int i = 0; i + 1 < 16; ++i) {
    for (int step = 0; step < 3; ++step) {
      const int x = i * 3 + step;
      const int y = kTrace[i] + (kTrace[i + 1] - kTrace[i]) * step / 3;
      for (int thick = 0; thick < 3; ++thick) put(x, y + thick, 255, 176, 60);
    }
  }
  const GLFWimage image{kSide, kSide, pixels.data()};
  glfwSetWindowIcon(window_, 1, &image);
}

bool GlfwWindow::should_close() const {
  return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void GlfwWindow::close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void GlfwWindow::wait_events(double seconds) {
  wait_began_ = glfwGetTime();
  if (seconds > 0.0) {
    glfwWaitEventsTimeout(seconds);
  } else {
    glfwPollEvents();
  }
  events_since_ = glfwGetTime();
}

void GlfwWindow::wake() {
  glfwPostEmptyEvent();
}

void GlfwWindow::pass_key(const KeyEvent& event) {
  // Dear ImGui looks at keys once a frame: a key that is pressed and let go between two frames
  // would never have been down, or without the Ctrl that was let go after it. What is let go after
  // a key went down is let go a frame later.
  pressed_ = pressed_ || event.action == GLFW_PRESS;
  if (event.action == GLFW_RELEASE && pressed_) {
    releases_.push_back(event);
    return;
  }
  ImGui_ImplGlfw_KeyCallback(window_, event.key, event.code, event.action, event.modifiers);
}

void GlfwWindow::pass_button(int button, bool down) {
  // Events that were there when the wait began are told at once; later ones as they come.
  constexpr double kAtOnce = 0.002;
  const double now = glfwGetTime();
  const bool waited = now - wait_began_ < kAtOnce;
  MouseClicks::Place place;
  glfwGetCursorPos(window_, &place.x, &place.y);
  clicks_.change(static_cast<std::size_t>(button), down, {waited ? events_since_ : now, now},
                 place);
}

void GlfwWindow::tell_buttons() {
  const MouseClicks::Buttons buttons = clicks_.next_frame();
  ImGuiIO& io = ImGui::GetIO();
  std::copy(buttons.down.begin(), buttons.down.end(), io.MouseDown);
  io.MouseDoubleClickTime = buttons.double_click ? std::numeric_limits<float>::max() : 0.0F;
  input_ = input_ || clicks_.more();
}

void GlfwWindow::begin_frame() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  tell_buttons();
  ImGui::NewFrame();
}

void GlfwWindow::fonts_changed() {
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void GlfwWindow::end_frame(std::vector<unsigned char>* pixels) {
  ImGui::Render();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width(), height());
  const ImVec4 color = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
  glClearColor(color.x, color.y, color.z, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  pressed_ = false;
  for (const KeyEvent& event : std::exchange(releases_, {})) {
    ImGui_ImplGlfw_KeyCallback(window_, event.key, event.code, event.action, event.modifiers);
    input_ = true;
  }
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  if (pixels != nullptr) *pixels = read_pixels();
  glfwSwapBuffers(window_);
}

int GlfwWindow::width() const {
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return width;
}

int GlfwWindow::height() const {
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return height;
}

bool GlfwWindow::visible() const {
  return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_FALSE && width() > 0 && height() > 0;
}

float GlfwWindow::content_scale() const {
  float x = 1.0F;
  float y = 1.0F;
  glfwGetWindowContentScale(window_, &x, &y);
  return std::max(x, y);
}

void GlfwWindow::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

void GlfwWindow::toggle_full_screen() {
  if (glfwGetWindowMonitor(window_) != nullptr) {
    glfwSetWindowMonitor(window_, nullptr, windowed_[0], windowed_[1], windowed_[2], windowed_[3],
                         GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (monitor == nullptr) return;
  glfwGetWindowPos(window_, &windowed_[0], &windowed_[1]);
  glfwGetWindowSize(window_, &windowed_[2], &windowed_[3]);
  const GLFWvidmode* mode = glfwGetVideoMode(monitor);
  if (mode == nullptr) return;
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void GlfwWindow::copy_text(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

std::vector<std::string> GlfwWindow::take_dropped() {
  return std::exchange(dropped_, {});
}

bool GlfwWindow::take_input() {
  return std::exchange(input_, false);
}

std::vector<unsigned char> GlfwWindow::read_pixels() const {
  const int w = width();
  const int h = height();
  const std::size_t row = static_cast<std::size_t>(w) * 3;
  std::vector<unsigned char> pixels(row * static_cast<std::size_t>(h));
  glReadBuffer(GL_BACK);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, w, h, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  for (int y = 0; y < h / 2; ++y) {
    std::swap_ranges(pixels.begin() + static_cast<std::ptrdiff_t>(row) * y,
                     pixels.begin() + static_cast<std::ptrdiff_t>(row) * (y + 1),
                     pixels.end() - static_cast<std::ptrdiff_t>(row) * (y + 1));
  }
  return pixels;
}

}  // namespace encore::app
