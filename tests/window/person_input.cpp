// The person's hands: XTest gives the X server what a mouse and a keyboard would.
#include "eventually.h"
#include "person.h"

#include <X11/XKBlib.h>
#include <X11/Xlib.h>
#include <X11/extensions/XTest.h>
#include <X11/keysym.h>

#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace encore::test {

namespace {

struct Stroke {
  KeyCode code = 0;
  bool shift = false;
};

/// The key of the keyboard that gives a symbol, alone or with Shift.
Stroke stroke_for(Display* display, KeySym symbol) {
  const KeyCode code = XKeysymToKeycode(display, symbol);
  if (code == 0) throw std::runtime_error("this keyboard has no such key");
  const bool plain = XkbKeycodeToKeysym(display, code, 0, 0) == symbol;
  return {code, !plain && XkbKeycodeToKeysym(display, code, 0, 1) == symbol};
}

void press_key(Display* display, KeyCode code, bool down) {
  XTestFakeKeyEvent(display, code, down ? True : False, CurrentTime);
}

KeySym symbol_named(std::string_view name) {
  if (name == "Ctrl") return XK_Control_L;
  if (name == "Shift") return XK_Shift_L;
  if (name == "Alt") return XK_Alt_L;
  const KeySym symbol = XStringToKeysym(std::string(name).c_str());
  if (symbol == NoSymbol) throw std::runtime_error("no key is named " + std::string(name));
  return symbol;
}

std::vector<std::string_view> parts_of(std::string_view keys) {
  std::vector<std::string_view> parts;
  for (std::size_t plus = keys.find('+'); plus != std::string_view::npos; plus = keys.find('+')) {
    parts.push_back(keys.substr(0, plus));
    keys.remove_prefix(plus + 1);
  }
  parts.push_back(keys);
  return parts;
}

}  // namespace

void Person::move(int x, int y) {
  int root_x = 0;
  int root_y = 0;
  ::Window child = 0;
  XTranslateCoordinates(display_, window_, DefaultRootWindow(display_), x, y, &root_x, &root_y,
                        &child);
  XTestFakeMotionEvent(display_, DefaultScreen(display_), root_x, root_y, CurrentTime);
  XSync(display_, False);
  wait_frames(2);
}

void Person::button(unsigned number, bool down) {
  XTestFakeButtonEvent(display_, number, down ? True : False, CurrentTime);
  XSync(display_, False);
}

void Person::click(int x, int y, Button which) {
  move(x, y);
  button(which, true);
  wait_frames(2);
  button(which, false);
  wait_frames(2);
}

void Person::double_click(int x, int y) {
  move(x, y);
  // As quick as can be: the time between the clicks is not to depend on how fast frames come.
  for (const bool down : {true, false, true, false}) button(left, down);
  wait_frames(6);
}

void Person::drag(int from_x, int from_y, int to_x, int to_y, Button which, int steps) {
  move(from_x, from_y);
  button(which, true);
  wait_frames(2);
  for (int step = 1; step <= steps; ++step) {
    move(from_x + (to_x - from_x) * step / steps, from_y + (to_y - from_y) * step / steps);
  }
  button(which, false);
  wait_frames(2);
}

void Person::wheel(int x, int y, int notches) {
  move(x, y);
  for (int i = 0; i < std::abs(notches); ++i) {
    const unsigned number = notches > 0 ? 4 : 5;
    button(number, true);
    button(number, false);
  }
  wait_frames(3);
}

void Person::click(std::string_view name, Button which) {
  const Widget widget = see(name);
  click(widget.center_x(), widget.center_y(), which);
}

void Person::double_click(std::string_view name) {
  const Widget widget = see(name);
  double_click(widget.center_x(), widget.center_y());
}

void Person::stroke(std::string_view keys, bool wait) {
  std::vector<KeyCode> held;
  for (const std::string_view part : parts_of(keys)) {
    const Stroke stroke = stroke_for(display_, symbol_named(part));
    if (stroke.shift) held.push_back(XKeysymToKeycode(display_, XK_Shift_L));
    held.push_back(stroke.code);
  }
  // Down no longer than a moment, however slow the frames are: a key that is held repeats.
  for (const KeyCode code : held) press_key(display_, code, true);
  for (auto code = held.rbegin(); code != held.rend(); ++code) press_key(display_, *code, false);
  XSync(display_, False);
  if (wait) wait_frames(2);
}

void Person::key(std::string_view keys) {
  stroke(keys, true);
}

void Person::last_key(std::string_view keys) {
  stroke(keys, false);
}

void Person::type(std::string_view text) {
  const KeyCode shift = XKeysymToKeycode(display_, XK_Shift_L);
  for (const char letter : text) {
    // Latin letters' symbols are their codes.
    const Stroke stroke = stroke_for(display_, static_cast<unsigned char>(letter));
    if (stroke.shift) press_key(display_, shift, true);
    press_key(display_, stroke.code, true);
    press_key(display_, stroke.code, false);
    if (stroke.shift) press_key(display_, shift, false);
    XSync(display_, False);
    // The toolkit looks at keys once a frame.
    wait_frames(1);
  }
  wait_frames(2);
}

}  // namespace encore::test
