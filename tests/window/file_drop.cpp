#include "file_drop.h"

#include "eventually.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <string>

namespace encore::test {

namespace {

constexpr long kVersion = 5;

/// The side that a file is dragged from.
class DragSource {
 public:
  DragSource(Display* display, ::Window target, std::string uri)
      : display_(display),
        target_(target),
        uri_(std::move(uri)),
        own_(XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0)),
        list_(atom("text/uri-list")) {
    XSetSelectionOwner(display_, atom("XdndSelection"), own_, CurrentTime);
  }
  ~DragSource() {
    XDestroyWindow(display_, own_);
    XSync(display_, False);
  }
  DragSource(const DragSource&) = delete;
  DragSource& operator=(const DragSource&) = delete;

  bool drop_at(int root_x, int root_y) {
    tell("XdndEnter", kVersion << 24, long(list_), 0, 0);
    tell("XdndPosition", 0, (long(root_x) << 16) | long(root_y), CurrentTime,
         long(atom("XdndActionCopy")));
    if (!eventually([this] { return look() && accepted_; })) return false;
    tell("XdndDrop", 0, CurrentTime, 0, 0);
    return eventually([this] { return look() && finished_; });
  }

 private:
  Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

  void tell(const char* what, long a, long b, long c, long d) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target_;
    event.xclient.message_type = atom(what);
    event.xclient.format = 32;
    event.xclient.data.l[0] = long(own_);
    event.xclient.data.l[1] = a;
    event.xclient.data.l[2] = b;
    event.xclient.data.l[3] = c;
    event.xclient.data.l[4] = d;
    XSendEvent(display_, target_, False, NoEventMask, &event);
    XSync(display_, False);
  }

  /// The target asks for what is dragged.
  void answer(const XSelectionRequestEvent& request) {
    XChangeProperty(display_, request.requestor, request.property, request.target, 8,
                    PropModeReplace, reinterpret_cast<const unsigned char*>(uri_.data()),
                    int(uri_.size()));
    XEvent event{};
    event.xselection.type = SelectionNotify;
    event.xselection.requestor = request.requestor;
    event.xselection.selection = request.selection;
    event.xselection.target = request.target;
    event.xselection.property = request.property;
    event.xselection.time = request.time;
    XSendEvent(display_, request.requestor, False, NoEventMask, &event);
    XSync(display_, False);
  }

  /// Takes in what has come; always true.
  bool look() {
    while (XPending(display_) > 0) {
      XEvent event{};
      XNextEvent(display_, &event);
      if (event.type == SelectionRequest) answer(event.xselectionrequest);
      if (event.type != ClientMessage) continue;
      if (event.xclient.message_type == atom("XdndStatus")) {
        accepted_ = (event.xclient.data.l[1] & 1) != 0;
      }
      if (event.xclient.message_type == atom("XdndFinished")) finished_ = true;
    }
    return true;
  }

  Display* display_;
  ::Window target_;
  std::string uri_;
  ::Window own_;
  Atom list_;
  bool accepted_ = false;
  bool finished_ = false;
};

}  // namespace

bool drop_file(_XDisplay* display, unsigned long window, const std::filesystem::path& file, int x,
               int y) {
  int root_x = 0;
  int root_y = 0;
  ::Window child = 0;
  XTranslateCoordinates(display, window, DefaultRootWindow(display), x, y, &root_x, &root_y,
                        &child);
  DragSource source(display, window, "file://" + file.string() + "\r\n");
  return source.drop_at(root_x, root_y);
}

}  // namespace encore::test
