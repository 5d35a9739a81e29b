#pragma once

#include "scene/camera.h"
#include "scene/ray.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace encore::renderer {

/// Pixels x0 <= x < x1, y0 <= y < y1, counted from the top left of the image.
struct PixelRect {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;

  [[nodiscard]] int width() const { return x1 - x0; }
  [[nodiscard]] int height() const { return y1 - y0; }
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }
};

/// A camera made ready for images of one size, once a frame. In perspective the ray through the
/// centre of pixel (x, y) runs along forward + (x + 0.5 - center_x) * right + (center_y - y - 0.5)
/// * up. In orthographic views it runs along forward and starts at origin + (x + 0.5 - center_x) *
/// right + (center_y - y - 0.5) * up, on the plane through the eye; starts are rounded to single
/// precision once, so they tell pixels apart only as far as floats do at the eye's coordinates. In
/// double precision, so that eyes 1e18 units away or 1e-18 apart from their target still work.
struct CameraFrame {
  glm::vec3 origin{0.0F};
  glm::dvec3 forward{0.0, 0.0, -1.0};  ///< unit length
  /// One pixel to the right on the plane at distance 1; orthographic: on every plane.
  glm::dvec3 right{0.0};
  glm::dvec3 up{0.0};     ///< one pixel up on that plane; as long as `right`
  double center_x = 0.0;  ///< in pixels from the left and from the top
  double center_y = 0.0;
  bool orthographic = false;
};

/// Prepares a camera for images of width x height pixels. Pixels are square: the camera's field of
/// view (or orthographic height) is the vertical one, the horizontal one follows from the image's
/// shape. If `up` is zero or parallel to the view (to within 1e-6 rad), the coordinate axis that is
/// most nearly at right angles to the view takes its place; of equal ones y before z before x.
/// Throws std::invalid_argument if the size is not positive, a number is not finite, eye and target
/// coincide, the field of view is not inside (0, 180) degrees, or the orthographic height is below
/// 0 or so large that the rays' starts are no floats.
CameraFrame make_camera_frame(const scene::Camera& camera, int width, int height);

/// Writes the rays through the pixel centres of `rect`, row by row; rays.size() == rect.count().
/// Directions have unit length, t runs over (0, inf). A ray depends on its pixel alone, not on the
/// rectangle it was asked for in.
void camera_rays(const CameraFrame& frame, const PixelRect& rect, std::span<scene::Ray> rays);

/// One of several rays a pixel (paths/sample_pattern.h).
struct CameraSample {
  std::uint32_t sample = 0;
  std::uint32_t samples = 1;  ///< of the whole picture
  std::uint32_t seed = 1;
};

/// The same rays, but through sample_offset() in each pixel instead of its centre. Where the
/// picture has one sample a pixel these are the rays above, bit for bit.
void camera_rays(const CameraFrame& frame, const PixelRect& rect, const CameraSample& sample,
                 std::span<scene::Ray> rays);

}  // namespace encore::renderer
