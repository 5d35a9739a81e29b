#pragma once

#include "scene/camera.h"
#include "scene/diagnostics.h"
#include "scene/toml_reading.h"

namespace encore::scene {

/// Reads the keys of a camera; those that are absent stay as they are in `camera`, and whichever of
/// 'fov' and 'orthographic_height' is there decides the projection. Errors, "file:line:column:
/// ...", are values out of range, both of these keys, and an eye that is the target.
Camera read_camera_keys(TomlTable& table, Camera camera);

/// [camera] of a scene file: the same over the default camera; in addition unknown keys are warned
/// of, and 'up' must not be zero or along the view.
Camera read_camera(TomlTable& table, Warnings& warnings);

}  // namespace encore::scene
