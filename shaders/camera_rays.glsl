// The ray through a pixel's centre (twin of renderer/camera_rays.cpp), in double precision and as
// it is written, so that GPU and CPU trace the very same rays.
#include "numbers.glsl"
#include "shaders/shared/bindings.h"

layout(std140, binding = ENCORE_BINDING_CAMERA) uniform CameraBlock {
  CameraParameters camera;
};

#ifdef ENCORE_SAMPLES
// Through a place in the pixel: (0, 0) is its upper left corner.
Ray camera_ray(ivec2 pixel, dvec2 place) {
#else
Ray camera_ray(ivec2 pixel) {
  const dvec2 place = dvec2(0.5lf, 0.5lf);
#endif
  precise double down = camera.center_y - (double(pixel.y) + place.y);
  precise double aside = (double(pixel.x) + place.x) - camera.center_x;
  if (camera.orthographic != 0u) {
    precise dvec3 start_row = dvec3(camera.origin) + down * camera.up;
    precise dvec3 start = start_row + aside * camera.right;
    return Ray(vec3(start), 0.0, vec3(camera.forward), kInfinity);
  }
  precise dvec3 row = camera.forward + down * camera.up;
  precise dvec3 along = row + aside * camera.right;
  precise double squared = along.x * along.x + along.y * along.y + along.z * along.z;
  precise double scale = 1.0lf / sqrt(squared);
  precise dvec3 direction = along * scale;
  return Ray(camera.origin, 0.0, vec3(direction), kInfinity);
}
