#pragma once

#include "accel/acceleration_structure.h"
#include "renderer/image.h"
#include "scene/camera.h"
#include "scene/scene.h"
#include "scene/triangles.h"

namespace encore::renderer {

/// What a renderer draws from. All referenced objects stay the caller's and must outlive the
/// renderer's use of them; the structure must be built over `triangles`.
struct RenderInput {
  const scene::Scene* scene = nullptr;
  const scene::TriangleList* triangles = nullptr;
  const accel::AccelerationStructure* structure = nullptr;
};

/// The interface of every renderer (thesis, appendix B): init once a scene and structure, refresh
/// whenever the triangles or the structure changed, render as often as wanted.
class Renderer {
 public:
  virtual ~Renderer() = default;

  virtual void init(const RenderInput& input) = 0;
  /// Brings device copies up to date after the triangles or structure changed. CPU: nothing to do.
  virtual void refresh() = 0;
  /// Draws into `image` at its size. No allocation after the first frame of a size.
  virtual void render(const scene::Camera& camera, Image& image) = 0;
};

}  // namespace encore::renderer
