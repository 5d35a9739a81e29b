#pragma once

#include "scene/camera.h"
#include "scene/camera_motion.h"
#include "ui/layout.h"
#include "ui/ui_state.h"

#include <cstddef>
#include <optional>
#include <utility>

namespace encore::ui {

/// A picture that a camera is moved in.
struct NavigationInput {
  std::size_t place = 0;    ///< of the picture; see kPictureCount
  Rect room;                ///< where the mouse is listened to
  Rect picture;             ///< the picture inside it
  double scene_size = 0.0;  ///< the scene's diagonal; 0: not known
};

struct NavigationOutput {
  bool hovered = false;  ///< the mouse is over the room, and drags nothing
  bool moving = false;   ///< a drag, a flight or the wheel goes on
  /// Clicked without dragging: position in the window.
  std::optional<std::pair<float, float>> clicked;
};

/// Moves `camera` as the mouse says, by scene/camera_motion.h: left drag orbits, middle or Shift
/// and left drag pans, the wheel zooms at the cursor, right drag looks around and W A S D Q E fly
/// while it holds on (Shift: faster, wheel: another speed). Puts an invisible item over the room.
NavigationOutput navigate(const NavigationInput& input, const Preferences& preferences,
                          NavigationState& state, scene::Camera& camera);

scene::Axis up_axis_of(const Preferences& preferences);

/// The pixel of a width x height picture, shown in `picture`, at a place of the window; nothing
/// outside.
std::optional<std::pair<int, int>> pixel_at(const Rect& picture, int width, int height, float x,
                                            float y);

}  // namespace encore::ui
