#include "scene/scene_toml_camera.h"

#include "scene/rotation.h"

namespace encore::scene {

namespace {

constexpr NumberRange kFieldOfView{0.0, 180.0, true};
constexpr NumberRange kHeight{1e-37, 1e37};  // smaller ones would be 0 as a float, or nearly so

}  // namespace

Camera read_camera_keys(TomlTable& table, Camera camera) {
  camera.eye = table.vector("eye").value_or(camera.eye);
  camera.target = table.vector("target").value_or(camera.target);
  camera.up = table.vector("up").value_or(camera.up);
  const auto fov = table.number("fov", kFieldOfView);
  const auto height = table.number("orthographic_height", kHeight);
  if (fov && height) {
    table.fail("orthographic_height",
               "a camera has either 'fov' (perspective) or 'orthographic_height'; remove one");
  }
  if (fov) {
    camera.vertical_fov_degrees = *fov;
    camera.orthographic_height = 0.0F;
  }
  if (height) camera.orthographic_height = *height;
  if (camera.eye == camera.target) {
    table.fail("target", "'eye' and 'target' of the camera must differ");
  }
  return camera;
}

Camera read_camera(TomlTable& table, Warnings& warnings) {
  const Camera camera = read_camera_keys(table, Camera{});
  table.warn_about_unknown_keys(warnings);
  const glm::dvec3 view = unit_or_zero(camera.target - camera.eye);
  const glm::dvec3 up = unit_or_zero(camera.up);
  // Also where the difference is too small for a float.
  if (view == glm::dvec3(0.0)) {
    table.fail("target", "'eye' and 'target' of the camera must differ");
  }
  const double along = view.x * up.x + view.y * up.y + view.z * up.z;
  if (up == glm::dvec3(0.0) || along * along > 1.0 - 1e-12) {
    table.fail("up", "'up' of the camera must not be zero or along its view");
  }
  return camera;
}

}  // namespace encore::scene
