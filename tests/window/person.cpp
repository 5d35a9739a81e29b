#include "person.h"

#include "eventually.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <stdexcept>

namespace encore::test {

namespace {

bool is_encore(Display* display, ::Window window) {
  XClassHint hint{};
  if (XGetClassHint(display, window, &hint) == 0) return false;
  const bool found = hint.res_class != nullptr && std::string_view(hint.res_class) == "encore";
  XFree(hint.res_name);
  XFree(hint.res_class);
  return found;
}

::Window shown_window(Display* display) {
  ::Window root = 0;
  ::Window parent = 0;
  ::Window* children = nullptr;
  unsigned count = 0;
  ::Window found = 0;
  if (XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count) == 0) {
    return 0;
  }
  for (unsigned i = 0; i < count; ++i) {
    XWindowAttributes attributes{};
    if (XGetWindowAttributes(display, children[i], &attributes) == 0) continue;
    if (attributes.map_state == IsViewable && is_encore(display, children[i])) found = children[i];
  }
  XFree(children);
  return found;
}

}  // namespace

bool wait_for_map(EncoreProcess& program, bool (*holds)(const WidgetMap&, const void*),
                  const void* data, WidgetMap& map) {
  bool alive = true;
  bool found = false;
  eventually([&] {
    alive = program.running();
    map = program.map();
    found = map.frame > 0 && holds(map, data);
    return found || !alive;
  });
  return found;
}

Person::Person(_XDisplay* display, EncoreProcess& program) : display_(display), program_(program) {
  wait_until([](const WidgetMap& map) { return map.frame > 0; }, "the first frame");
  find_window();
}

void Person::find_window() {
  eventually([this] {
    window_ = shown_window(display_);
    return window_ != 0 || !program_.running();
  });
  if (window_ == 0) give_up("there is no window on the screen");
  // What a window manager does for a new window.
  XSetInputFocus(display_, window_, RevertToPointerRoot, CurrentTime);
  XSync(display_, False);
  wait_frames(2);
}

void Person::give_up(const std::string& why) const {
  std::string text = why;
  if (!program_.running()) {
    const auto code = program_.wait(std::chrono::milliseconds(0));
    text += "\nthe program has ended with code " + std::to_string(code.value_or(-1));
  }
  const WidgetMap map = program_.map();
  text += "\nframe " + std::to_string(map.frame) + (map.busy ? ", busy" : ", idle") +
          "; widgets in sight:\n";
  for (const Widget& widget : map.widgets) {
    text += "  " + widget.name + (widget.state.empty() ? "" : " = " + widget.state) + "\n";
  }
  text += "what it wrote: " + program_.err();
  look().keep("given-up");
  throw std::runtime_error(text);
}

void Person::wait_frames(int count) {
  const std::uint64_t from = program_.map().frame;
  wait_until(
      [&](const WidgetMap& map) { return map.frame >= from + static_cast<std::uint64_t>(count); },
      "the next frames");
}

void Person::wait_idle() {
  // Work that was just asked for begins a frame or two later.
  wait_frames(2);
  std::uint64_t idle_since = 0;
  wait_until(
      [&](const WidgetMap& map) {
        if (map.busy) {
          idle_since = 0;
        } else if (idle_since == 0) {
          idle_since = map.frame;
        }
        return idle_since != 0 && map.frame >= idle_since + 2;
      },
      "the program to be idle");
}

Widget Person::see(std::string_view name) {
  Widget last;
  std::uint64_t frame = 0;
  wait_until(
      [&](const WidgetMap& map) {
        const Widget* found = map.find(name);
        if (found == nullptr || map.frame == frame) return false;
        const bool still = frame != 0 && found->x == last.x && found->y == last.y;
        last = *found;
        frame = map.frame;
        return still;
      },
      "to see " + std::string(name));
  return last;
}

Widget Person::see_state(std::string_view name, std::string_view state) {
  const WidgetMap map =
      wait_until([&](const WidgetMap& now) { return now.has(name) && now.state(name) == state; },
                 std::string(name) + " = " + std::string(state));
  return *map.find(name);
}

bool Person::scroll_to(std::string_view name, int x, int y) {
  if (map().has(name)) return true;
  for (const int direction : {-3, 3}) {
    std::string before;
    for (int turn = 0; turn < 40; ++turn) {
      wheel(x, y, direction);
      const WidgetMap now = map();
      if (now.has(name)) {
        wheel(x, y, direction / 3);  // a little further, so that all of it is in sight
        if (map().has(name)) return true;
        wheel(x, y, -direction / 3);
        return map().has(name);
      }
      std::string places;
      for (const Widget& widget : now.widgets) {
        places += widget.name + std::to_string(widget.y) + " ";
      }
      if (places == before) break;  // the end
      before = places;
    }
  }
  return false;
}

void Person::choose(std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) click(name);
}

void Person::resize(int width, int height) {
  XResizeWindow(display_, window_, unsigned(width), unsigned(height));
  XSync(display_, False);
  wait_frames(3);
}

void Person::close_window() {
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = window_;
  event.xclient.message_type = XInternAtom(display_, "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = long(XInternAtom(display_, "WM_DELETE_WINDOW", False));
  event.xclient.data.l[1] = CurrentTime;
  XSendEvent(display_, window_, False, NoEventMask, &event);
  XSync(display_, False);
}

Screenshot Person::look() const {
  return window_ == 0 ? Screenshot() : Screenshot::take(display_, window_);
}

Screenshot Person::look_calmly(std::string_view name) {
  const WidgetMap now = map();
  const Widget* corner = now.find("menu.frames");
  // In the menu bar's empty part nothing is hovered.
  if (corner != nullptr) move(corner->x - 4, 2);
  wait_idle();
  Screenshot shot = look();
  if (!name.empty()) shot.keep(std::string(name));
  return shot;
}

}  // namespace encore::test
