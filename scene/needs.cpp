#include "scene/needs.h"

#include <algorithm>

namespace encore::scene {

Needs needs_of(const Scene& scene, const TriangleList& triangles, const RaySettings& rays) {
  const auto some = [&scene](auto has) {
    return std::any_of(scene.materials.begin(), scene.materials.end(), has);
  };
  Needs needs;
  needs.lights = !scene.lights.empty();
  needs.normals = needs.lights && !triangles.normals.empty();
  needs.colors = needs.lights && !triangles.colors.empty();
  needs.textures = needs.lights && rays.textures && !triangles.texcoords.empty() &&
                   some([](const Material& m) { return m.diffuse_texture != nullptr; });
  needs.highlights =
      needs.lights && some([](const Material& m) { return m.specular != glm::vec3(0.0F); });
  needs.shadows = needs.lights && rays.shadows;
  const bool bounces = rays.depth > 0;
  const bool glass = some([](const Material& m) { return m.opacity < 1.0F; });
  const bool mirrors = some([](const Material& m) { return m.reflectivity > 0.0F; });
  needs.reflections = bounces && rays.reflections && (mirrors || glass);
  needs.refractions = bounces && rays.refractions && glass;
  needs.samples = rays.samples > 1;
  // Directions of bounces follow the shading normals also where no light asks for them.
  if ((needs.reflections || needs.refractions) && !triangles.normals.empty()) needs.normals = true;
  return needs;
}

}  // namespace encore::scene
