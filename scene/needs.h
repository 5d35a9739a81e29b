#pragma once

#include "scene/ray_settings.h"
#include "scene/scene.h"
#include "scene/triangles.h"

namespace encore::scene {

/// What drawing a scene takes, derived from what the scene has and what was asked for: the one
/// answer to "is there any use for this?" that kernels, buffers, phases and widgets go by. What is
/// not needed is not there: no branch, no byte, no widget.
struct Needs {
  bool lights = false;       ///< there is light besides the ambient one
  bool normals = false;      ///< lit, and a mesh has shading normals
  bool colors = false;       ///< lit, and a mesh has vertex colours
  bool textures = false;     ///< lit, wanted, and a surface with texture coordinates wears one
  bool highlights = false;   ///< lit, and a material has a specular colour
  bool shadows = false;      ///< wanted, and lit
  bool reflections = false;  ///< wanted, the depth allows one, and a material mirrors or is glass
  bool refractions = false;  ///< wanted, the depth allows one, and a material is see-through
  bool samples = false;      ///< more than one ray a pixel

  /// Whether a picture takes rays beyond one a pixel, or several of those.
  [[nodiscard]] bool paths() const { return shadows || reflections || refractions || samples; }

  friend bool operator==(const Needs&, const Needs&) = default;
};

/// `triangles`: the scene's list as it is now.
Needs needs_of(const Scene& scene, const TriangleList& triangles, const RaySettings& rays);

}  // namespace encore::scene
