#pragma once

#include <array>
#include <cstddef>
#include <deque>

namespace encore::app {

/// Mouse buttons as they are told to Dear ImGui, which looks at them once a frame and measures the
/// time between clicks by frames: on a slow device a click or the second half of a double click
/// would fall between two frames. Here every change of a button gets a frame of its own, and
/// whether a press is the second of a double click is told by when the events came.
class MouseClicks {
 public:
  static constexpr std::size_t kButtons = 5;
  /// The longest time between the two presses of a double click.
  static constexpr double kDoubleClickSeconds = 0.3;
  /// How far apart they may be, in pixels.
  static constexpr double kDoubleClickPixels = 6.0;

  struct Place {
    double x = 0.0;
    double y = 0.0;
  };
  /// What is known of the time of an event (seconds of any steady clock): events wait while a frame
  /// is drawn.
  struct Time {
    double earliest = 0.0;
    double latest = 0.0;
  };

  struct Buttons {
    std::array<bool, kButtons> down{};
    bool double_click = false;  ///< a button went down that is the second press of a double click
  };

  /// A button went down or up. Buttons past kButtons are passed over.
  void change(std::size_t button, bool down, const Time& time, const Place& place);
  /// What the next frame is told.
  Buttons next_frame();
  /// Whether a later frame has more to be told.
  [[nodiscard]] bool more() const;

 private:
  struct Change {
    bool down = false;
    bool double_click = false;
  };
  struct Button {
    bool down = false;  ///< as was told last
    std::deque<Change> waiting;
    bool pressed_before = false;
    double last_press = 0.0;  ///< the latest that it can have been
    Place last_place;
  };
  std::array<Button, kButtons> buttons_;
};

}  // namespace encore::app
