#pragma once

#include "app/window/mouse_clicks.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

struct GLFWwindow;

namespace encore::app {

/// There is no display, or none that a window can be opened on. what() says why and the way out.
class WindowUnavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The one window of the program with its OpenGL context (4.3 core or later), current in the thread
/// that made it, and Dear ImGui bound to both.
class GlfwWindow {
 public:
  struct Setup {
    int width = 1600;
    int height = 960;
    bool debug = false;  ///< ask for a debug context, and count what it reports
  };
  /// Throws WindowUnavailable.
  explicit GlfwWindow(const Setup& setup);
  ~GlfwWindow();
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  [[nodiscard]] bool should_close() const;
  void close();
  /// Handles what came in; waits for it up to so long if nothing did.
  void wait_events(double seconds);
  /// Ends a wait_events() from another thread.
  static void wake();
  void begin_frame();
  /// Draws what was said since begin_frame() and shows it. `pixels` (if not null) gets the window
  /// as it is shown: 8-bit RGB, row 0 at the top.
  void end_frame(std::vector<unsigned char>* pixels = nullptr);
  /// The fonts were made anew.
  static void fonts_changed();

  [[nodiscard]] int width() const;  ///< in pixels
  [[nodiscard]] int height() const;
  [[nodiscard]] bool visible() const;  ///< neither minimised nor hidden
  [[nodiscard]] float content_scale() const;
  void set_title(const std::string& title);
  void toggle_full_screen();
  void copy_text(const std::string& text);
  /// Files that were dropped onto the window since the last call.
  std::vector<std::string> take_dropped();
  /// Whether anything came in since the last call: mouse, keys, size.
  bool take_input();
  /// Errors of the debug context so far, and the first one's text.
  [[nodiscard]] unsigned gl_errors() const { return gl_errors_; }
  [[nodiscard]] const std::string& first_gl_error() const { return first_gl_error_; }
  /// What draws the window.
  [[nodiscard]] const std::string& renderer_name() const { return renderer_name_; }

 private:
  friend struct GlfwCallbacks;
  struct KeyEvent {
    int key = 0;
    int code = 0;
    int action = 0;
    int modifiers = 0;
  };
  void pass_key(const KeyEvent& event);
  void pass_button(int button, bool down);
  void tell_buttons();
  void set_icon();
  void watch_gl_errors();
  [[nodiscard]] std::vector<unsigned char> read_pixels() const;

  GLFWwindow* window_ = nullptr;
  std::vector<std::string> dropped_;
  bool input_ = false;
  bool pressed_ = false;            ///< a key went down since the last frame
  std::vector<KeyEvent> releases_;  ///< of those, to be told after the next frame
  MouseClicks clicks_;
  double events_since_ = 0.0;  ///< an event that waited came after this time
  double wait_began_ = 0.0;
  unsigned gl_errors_ = 0;
  std::string first_gl_error_;
  std::string renderer_name_;
  int windowed_[4] = {0, 0, 0, 0};  ///< place and size before full screen
};

}  // namespace encore::app
