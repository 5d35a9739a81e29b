#include "renderer/camera_rays.h"

#include "renderer/paths/sample_pattern.h"
#include "scene/camera_basis.h"
#include "scene/triangle.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <type_traits>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace encore::renderer {

namespace {

void check(const scene::Camera& camera, int width, int height) {
  if (width <= 0 || height <= 0) {
    throw std::invalid_argument("an image needs at least one pixel each way");
  }
  if (!scene::is_finite(camera.eye) || !scene::is_finite(camera.target) ||
      !scene::is_finite(camera.up)) {
    throw std::invalid_argument("the camera has a coordinate that is not a finite number");
  }
  if (camera.eye == camera.target) {
    throw std::invalid_argument("the camera's eye and target are the same point; move one of them");
  }
  if (!(camera.orthographic_height >= 0.0F && std::isfinite(camera.orthographic_height))) {
    throw std::invalid_argument(
        "the camera's orthographic height must be a finite number above 0, or 0 for perspective");
  }
  if (camera.orthographic()) return;
  if (!(camera.vertical_fov_degrees > 0.0F && camera.vertical_fov_degrees < 180.0F)) {
    throw std::invalid_argument("the camera's field of view must be inside (0, 180) degrees");
  }
}

/// The picture's corners on the plane through the eye, which no ray starts beyond.
void check_starts(const CameraFrame& frame) {
  const glm::dvec3 reach = glm::abs(glm::dvec3(frame.origin)) +
                           frame.center_x * glm::abs(frame.right) +
                           frame.center_y * glm::abs(frame.up);
  if (std::max({reach.x, reach.y, reach.z}) > std::numeric_limits<float>::max()) {
    throw std::invalid_argument("the camera's orthographic height is too large for its eye");
  }
}

/// Where rays go through their pixels.
struct Centre {
  glm::dvec2 operator()(int /*x*/, int /*y*/) const { return {0.5, 0.5}; }
};
struct Sampled {
  CameraSample sample;
  glm::dvec2 operator()(int x, int y) const {
    return sample_offset(x, y, sample.sample, sample.samples, sample.seed);
  }
};

#if defined(__SSE2__)
/// perspective_rays() through the centres of two pixels of a row at once, operation for operation.
class TwoRays {
 public:
  TwoRays(const CameraFrame& frame, int y)
      : row_(Axes(frame.forward + (frame.center_y - (y + 0.5)) * frame.up)),
        right_(Axes(frame.right)),
        start_(_mm_setr_ps(frame.origin.x, frame.origin.y, frame.origin.z, 0.0F)),
        center_x_(_mm_set1_pd(frame.center_x)) {}

  /// Writes the rays of pixels x and x + 1.
  void write(int x, scene::Ray* rays) const {
    const __m128d column = _mm_sub_pd(_mm_setr_pd(x + 0.5, x + 1 + 0.5), center_x_);
    const __m128d ax = _mm_add_pd(row_.x, _mm_mul_pd(column, right_.x));
    const __m128d ay = _mm_add_pd(row_.y, _mm_mul_pd(column, right_.y));
    const __m128d az = _mm_add_pd(row_.z, _mm_mul_pd(column, right_.z));
    const __m128d squared =
        _mm_add_pd(_mm_add_pd(_mm_mul_pd(ax, ax), _mm_mul_pd(ay, ay)), _mm_mul_pd(az, az));
    const __m128d scale = _mm_div_pd(_mm_set1_pd(1.0), _mm_sqrt_pd(squared));
    const __m128 dx = _mm_cvtpd_ps(_mm_mul_pd(ax, scale));
    const __m128 dy = _mm_cvtpd_ps(_mm_mul_pd(ay, scale));
    const __m128 dz = _mm_cvtpd_ps(_mm_mul_pd(az, scale));
    const __m128 xy = _mm_unpacklo_ps(dx, dy);
    const __m128 z_end = _mm_unpacklo_ps(dz, _mm_set1_ps(std::numeric_limits<float>::infinity()));
    auto* const to = reinterpret_cast<float*>(rays);
    _mm_storeu_ps(to, start_);
    _mm_storeu_ps(to + 4, _mm_movelh_ps(xy, z_end));
    _mm_storeu_ps(to + 8, start_);
    _mm_storeu_ps(to + 12, _mm_movehl_ps(z_end, xy));
  }

 private:
  struct Axes {
    __m128d x, y, z;
    explicit Axes(const glm::dvec3& v)
        : x(_mm_set1_pd(v.x)), y(_mm_set1_pd(v.y)), z(_mm_set1_pd(v.z)) {}
  };
  static_assert(sizeof(scene::Ray) == 32 && offsetof(scene::Ray, t_min) == 12 &&
                offsetof(scene::Ray, direction) == 16 && offsetof(scene::Ray, t_max) == 28);

  Axes row_, right_;
  __m128 start_;
  __m128d center_x_;
};
#endif

template <class Place>
void perspective_rays(const CameraFrame& frame, const PixelRect& rect, const Place& place,
                      std::span<scene::Ray> rays) {
  std::size_t i = 0;
  for (int y = rect.y0; y < rect.y1; ++y) {
    int x = rect.x0;
#if defined(__SSE2__)
    if constexpr (std::is_same_v<Place, Centre>) {
      const TwoRays two(frame, y);
      for (; x + 2 <= rect.x1; x += 2, i += 2) two.write(x, &rays[i]);
    }
#endif
    for (; x < rect.x1; ++x, ++i) {
      const glm::dvec2 offset = place(x, y);
      const glm::dvec3 row = frame.forward + (frame.center_y - (y + offset.y)) * frame.up;
      const glm::dvec3 along = row + ((x + offset.x) - frame.center_x) * frame.right;
      const double scale = 1.0 / std::sqrt(glm::dot(along, along));
      rays[i] = scene::Ray{.origin = frame.origin, .direction = glm::vec3(along * scale)};
    }
  }
}

template <class Place>
void orthographic_rays(const CameraFrame& frame, const PixelRect& rect, const Place& place,
                       std::span<scene::Ray> rays) {
  const auto direction = glm::vec3(frame.forward);
  std::size_t i = 0;
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x, ++i) {
      const glm::dvec2 offset = place(x, y);
      const glm::dvec3 row =
          glm::dvec3(frame.origin) + (frame.center_y - (y + offset.y)) * frame.up;
      const glm::dvec3 start = row + ((x + offset.x) - frame.center_x) * frame.right;
      rays[i] = scene::Ray{.origin = glm::vec3(start), .direction = direction};
    }
  }
}

template <class Place>
void make_rays(const CameraFrame& frame, const PixelRect& rect, const Place& place,
               std::span<scene::Ray> rays) {
  if (frame.orthographic) return orthographic_rays(frame, rect, place, rays);
  perspective_rays(frame, rect, place, rays);
}

}  // namespace

CameraFrame make_camera_frame(const scene::Camera& camera, int width, int height) {
  check(camera, width, height);
  CameraFrame frame;
  frame.origin = camera.eye;

  const scene::CameraBasis basis = scene::camera_basis(camera);
  frame.forward = basis.forward;
  frame.orthographic = camera.orthographic();

  // The image spans 2 tan(fov / 2) in height at distance 1; a pixel is as wide as it is high.
  const double pixel = frame.orthographic ? static_cast<double>(camera.orthographic_height) / height
                                          : 2.0 * scene::half_height_at_one(camera) / height;
  frame.right = basis.right * pixel;
  frame.up = basis.up * pixel;
  frame.center_x = 0.5 * width;
  frame.center_y = 0.5 * height;
  if (frame.orthographic) check_starts(frame);
  return frame;
}

void camera_rays(const CameraFrame& frame, const PixelRect& rect, std::span<scene::Ray> rays) {
  make_rays(frame, rect, Centre{}, rays);
}

void camera_rays(const CameraFrame& frame, const PixelRect& rect, const CameraSample& sample,
                 std::span<scene::Ray> rays) {
  if (sample.samples <= 1) return make_rays(frame, rect, Centre{}, rays);
  make_rays(frame, rect, Sampled{sample}, rays);
}

}  // namespace encore::renderer
