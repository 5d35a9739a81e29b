#include "app/window/mouse_clicks.h"

#include <algorithm>
#include <cmath>

namespace encore::app {

void MouseClicks::change(std::size_t button, bool down, const Time& time, const Place& place) {
  if (button >= kButtons) return;
  Button& it = buttons_[button];
  Change change{down, false};
  if (down) {
    const bool soon = time.earliest - it.last_press < kDoubleClickSeconds;
    const bool near =
        std::hypot(place.x - it.last_place.x, place.y - it.last_place.y) < kDoubleClickPixels;
    change.double_click = it.pressed_before && soon && near;
    // The third press of three quick ones begins anew.
    it.pressed_before = !change.double_click;
    it.last_press = time.latest;
    it.last_place = place;
  }
  it.waiting.push_back(change);
}

MouseClicks::Buttons MouseClicks::next_frame() {
  Buttons told;
  for (std::size_t i = 0; i < kButtons; ++i) {
    Button& it = buttons_[i];
    if (!it.waiting.empty()) {
      it.down = it.waiting.front().down;
      told.double_click = told.double_click || it.waiting.front().double_click;
      it.waiting.pop_front();
    }
    told.down[i] = it.down;
  }
  return told;
}

bool MouseClicks::more() const {
  return std::any_of(buttons_.begin(), buttons_.end(),
                     [](const Button& it) { return !it.waiting.empty(); });
}

}  // namespace encore::app
