#pragma once

#include "scene/needs.h"
#include "scene/ray_settings.h"
#include "scene/scene.h"
#include "scene/triangles.h"

#include <cstdint>

namespace encore::scene {

/// Who takes part in a run, and what it is made of, as far as that is not the scene's.
struct RunParts {
  bool cpu = true;        ///< rays are traced on the CPU
  bool gpu = false;       ///< rays are traced on the graphics device
  bool raster = false;    ///< the graphics device draws without rays
  bool moves = true;      ///< time passes: a scene that can move does
  bool counting = false;  ///< what rays cost is counted: heat maps
};

/// How a scene moves, by what has to be done about it.
enum class MotionKind : std::uint8_t {
  none,     ///< nothing moves
  rigid,    ///< parts follow keyframes: vertices and normals are turned
  deforms,  ///< some surface is deformed by a formula; the triangles stay the same ones
  frames,   ///< some part shows one mesh after the other: triangles may come and go
};
MotionKind motion_of(const Scene& scene);

/// What a whole run takes: the picture's needs, and which phases and devices there are.
struct RunNeeds {
  Needs picture;
  MotionKind motion = MotionKind::none;  ///< of what is let move
  bool structures = true;                ///< somebody traces rays
  bool device = false;                   ///< OpenGL: a context, buffers, shaders, transfers
  bool counting = false;

  /// Phases of a frame besides drawing: animate, build or update, and with a device transfer.
  [[nodiscard]] bool animates() const { return motion != MotionKind::none; }

  friend bool operator==(const RunNeeds&, const RunNeeds&) = default;
};

/// `triangles`: the scene's list as it is now.
RunNeeds run_needs(const Scene& scene, const TriangleList& triangles, const RaySettings& rays,
                   const RunParts& parts);

}  // namespace encore::scene
