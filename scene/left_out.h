#pragma once

#include "scene/needs.h"
#include "scene/run_needs.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace encore::scene {

/// Something that a scene does without under these settings.
struct LeftOut {
  std::string feature;  ///< "shading normals"
  std::string reason;   ///< "no mesh has any", "there is no light"
  /// What a device's copy of the scene would be larger by. Nothing where what is left out is code
  /// and no data, or no device has a copy.
  std::optional<std::uint64_t> bytes{};
  /// What the host's triangle list would be larger by: 0 where the list holds it though nothing
  /// asks for it. Nothing where what is left out is no part of the list.
  std::optional<std::uint64_t> host_bytes{};
};

/// The rays of `needs_of` that tell what a scene could use at all: everything on.
RaySettings every_ray();

/// What needs_of(scene, triangles, rays) leaves out, in the order of Needs: shading normals and
/// vertex colours at 36 bytes a triangle, texture coordinates at 24, textures at 4 a texel and
/// their tables, what materials mirror and let through, and the kernels of further rays. Empty
/// where everything is needed.
std::vector<LeftOut> left_out(const Scene& scene, const TriangleList& triangles,
                              const RaySettings& rays);

/// The same of a whole run: also phases of frames, devices and counting. Where no device has a copy
/// of the scene that copy is what is left out, and of its parts only those of the host are told.
std::vector<LeftOut> left_out(const Scene& scene, const TriangleList& triangles,
                              const RaySettings& rays, const RunParts& parts);

/// What the scene's different textures hold together.
std::uint64_t texture_bytes(const Scene& scene);

/// What a device is sent of a scene besides a structure: triangles, what their shading needs,
/// materials, lights and textures.
std::uint64_t device_bytes(const Scene& scene, const TriangleList& triangles, const Needs& needs);

}  // namespace encore::scene
