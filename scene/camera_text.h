#pragma once

#include "scene/camera.h"

#include <string>
#include <string_view>

namespace encore::scene {

/// A camera as one line that a person can read and edit, and that may stand in a scene file:
///   camera = { eye = [0, 0, 25], target = [0, 0, 0], up = [0, 1, 0], fov = 90 }
/// with `orthographic_height` in the place of `fov` in orthographic views. Reading it gives the
/// same numbers bit for bit, except that of `fov` and height only the one in use is written.
std::string camera_text(const Camera& camera);

/// Reads what camera_text() writes, that without `camera =` or without braces too, and the [camera]
/// lines of a scene file, with or without that heading (with it other tables may follow). What the
/// text does not name stays as in `base`: give the camera in use to change parts of it, the default
/// one to read as scene files are. Throws InputError naming the key that is wrong or not known, or
/// that no key of a camera is there.
Camera parse_camera_text(std::string_view text, const Camera& base = {});

}  // namespace encore::scene
