#pragma once

#include "encore_process.h"
#include "screenshot.h"

#include <string>
#include <string_view>

struct _XDisplay;

namespace encore::test {

/// Someone before the screen: moves the mouse, presses keys, looks. What cannot be done (no such
/// widget, the program ended) throws std::runtime_error that says so.
class Person {
 public:
  enum Button : unsigned { left = 1, middle = 2, right = 3 };

  /// Waits for the program's window and its first frame.
  Person(_XDisplay* display, EncoreProcess& program);

  [[nodiscard]] unsigned long window() const { return window_; }
  [[nodiscard]] WidgetMap map() const { return program_.map(); }

  // Waiting.
  /// For so many whole frames.
  void wait_frames(int count);
  /// Until nothing is being built, traced, read.
  void wait_idle();
  /// Until this holds of the map; throws with `what` if it never does.
  template <class Condition>
  WidgetMap wait_until(const Condition& condition, std::string_view what);
  /// Until a widget is there and stays in its place.
  Widget see(std::string_view name);
  Widget see_state(std::string_view name, std::string_view state);

  // Mouse, in pixels of the window.
  void move(int x, int y);
  void click(int x, int y, Button button = left);
  void double_click(int x, int y);
  void drag(int from_x, int from_y, int to_x, int to_y, Button button = left, int steps = 8);
  void wheel(int x, int y, int notches);  ///< up is positive
  void click(std::string_view name, Button button = left);
  void double_click(std::string_view name);
  /// Turns the wheel over a widget's area until a widget is in sight there; false if it never is.
  bool scroll_to(std::string_view name, int x, int y);
  /// Opens menus one after the other: "menu.file", "menu.file.samples", "menu.file.sample.mug".
  void choose(std::initializer_list<std::string_view> names);

  // Keyboard.
  /// "a", "F1", "Escape", "Ctrl+Shift+z", "question".
  void key(std::string_view keys);
  /// The same where the program ends by it.
  void last_key(std::string_view keys);
  void type(std::string_view text);

  // Window manager's part.
  void resize(int width, int height);
  void close_window();

  [[nodiscard]] Screenshot look() const;
  /// Looks once it is idle, with the mouse out of the way.
  Screenshot look_calmly(std::string_view name = {});

 private:
  void button(unsigned number, bool down);
  void stroke(std::string_view keys, bool wait);
  void find_window();
  [[noreturn]] void give_up(const std::string& why) const;

  _XDisplay* display_;
  EncoreProcess& program_;
  unsigned long window_ = 0;
};

/// Of a map until something holds of it, or patience ends.
bool wait_for_map(EncoreProcess& program, bool (*holds)(const WidgetMap&, const void*),
                  const void* data, WidgetMap& map);

template <class Condition>
WidgetMap Person::wait_until(const Condition& condition, std::string_view what) {
  WidgetMap map;
  const auto holds = [](const WidgetMap& now, const void* data) {
    return bool((*static_cast<const Condition*>(data))(now));
  };
  if (!wait_for_map(program_, holds, &condition, map)) {
    give_up("waited in vain: " + std::string(what));
  }
  return map;
}

/// The place of a widget on a picture of the screen.
inline Area area_of(const Widget& widget) {
  return {widget.x, widget.y, widget.width, widget.height};
}

}  // namespace encore::test
