#include "app/window/pane_request.h"

#include "renderer/camera_rays.h"

#include <array>

namespace encore::app {

bool PaneRequest::same_frame(const PaneRequest& o) const {
  return scene == o.scene && device == o.device && structure == o.structure && policy == o.policy &&
         build_on == o.build_on && threads == o.threads && rays == o.rays && width == o.width &&
         height == o.height && rebuild == o.rebuild && cancelled == o.cancelled &&
         camera == o.camera;
}

scene::Ray ray_of(const scene::Camera& camera, const Probe& pixel, int width, int height) {
  const auto frame = renderer::make_camera_frame(camera, width, height);
  std::array<scene::Ray, 1> ray;
  renderer::camera_rays(frame, {pixel.x, pixel.y, pixel.x + 1, pixel.y + 1}, ray);
  return ray[0];
}

}  // namespace encore::app
