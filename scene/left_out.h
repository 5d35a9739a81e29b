#pragma once

#include "scene/needs.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace encore::scene {

/// Something that a scene does without under these settings.
struct LeftOut {
  std::string feature;  ///< "shading normals"
  std::string reason;   ///< "no mesh has any", "there is no light"
  /// What a copy of the scene's triangles (the list's, a device's) would be larger by. Nothing
  /// where what is left out is code and no data.
  std::optional<std::uint64_t> bytes{};
};

/// The rays of `needs_of` that tell what a scene could use at all: everything on.
RaySettings every_ray();

/// What needs_of(scene, triangles, rays) leaves out, in the order of Needs: shading normals and
/// vertex colours at 36 bytes a triangle, texture coordinates at 24, pictures of textures at 4 a
/// texel, and the kernels of further rays. Empty where everything is needed.
std::vector<LeftOut> left_out(const Scene& scene, const TriangleList& triangles,
                              const RaySettings& rays);

/// What the scene's different textures hold together.
std::uint64_t texture_bytes(const Scene& scene);

}  // namespace encore::scene
