#pragma once

#include "scene/bounds.h"
#include "scene/camera.h"

namespace encore::scene {

// How a camera is moved by hand: a camera in, the moved one out, nothing kept in between.
//
// All of them take cameras that a picture can be made of (renderer/camera_rays.h) and give such
// ones: finite, eye and target apart. Angles are in radians, lengths in world units, and positions
// in the picture in fractions of it, (0, 0) at its top left, (1, 1) at its bottom right; `aspect`
// is its width over its height. Amounts that are not finite count as none.
//
// Since cameras hold floats, eye and target are never closer than 2^-14 of the larger one's largest
// coordinate: nearer, roundings would turn the view by more than the eye overlooks. Targets stay
// within 1e36, distances between 1e-30 and 4e36.

enum class Axis { x, y, z };

/// Which way a camera looks: minus_z is from a place with greater z towards smaller z.
enum class ViewAxis { plus_x, minus_x, plus_y, minus_y, plus_z, minus_z };

/// Carries the eye around the target at the same distance: by `dx` around the up axis
/// (counter-clockwise as seen from the axis' tip, so the scene seems to turn to the left), by `dy`
/// towards the axis' tip. It stops 0.004 rad before the poles, so the view never flips over.
/// `camera.up` becomes the axis; a view from a pole begins with the picture's own up.
Camera orbit(const Camera& camera, double dx, double dy, Axis up_axis);

/// Moves eye and target in the view's plane so that what lies at the target's depth follows a
/// pointer that moves by (dx, dy) of the picture.
Camera pan(const Camera& camera, double dx, double dy, double aspect);

/// What lies at the target's depth and position (x, y) of the picture stays there, and everything
/// at that depth is seen 1 / factor times as large: factors below 1 go nearer. In perspective the
/// distance changes, in orthographic views the height. Factors that are not above 0 count as 1.
Camera zoom_at(const Camera& camera, double factor, double x, double y, double aspect);

/// zoom_at() the picture's middle.
Camera dolly(const Camera& camera, double factor);

/// Moves eye and target along the view, to its right and to its up.
Camera fly(const Camera& camera, double forward, double right, double up);

/// Turns the view around the eye: by `dx` to the left around the up axis, by `dy` towards the axis'
/// tip, stopping as orbit() does. The target stays as far away as it is.
Camera look(const Camera& camera, double dx, double dy, Axis up_axis);

/// Looks at the middle of the box, from the same direction, so that all of it is in the picture
/// with a margin of about 5 %. Points keep distance and height. In orthographic views the eye is
/// put before the box. An empty box changes nothing; one that is not finite neither.
Camera focus(const Camera& camera, const Bounds& box, double aspect);

/// Looks at the same target from the same distance along a coordinate axis. Up is the up axis, or
/// along it what orbit() shows there, coming from the front: with y or x up the front view looks
/// along -z, with z up along +y.
Camera view_along_axis(const Camera& camera, ViewAxis axis, Axis up_axis);

/// From perspective to an orthographic view and back; things at the target's depth keep their size.
/// On the way back the eye moves to where the field of view asks for.
Camera toggle_projection(const Camera& camera);

/// Makes an axis the camera's up; the view stays.
Camera with_up_axis(const Camera& camera, Axis up_axis);

}  // namespace encore::scene
