#include "scene/run_needs.h"

#include "scene/motion.h"

#include <algorithm>
#include <variant>

namespace encore::scene {

namespace {

MotionKind motion_of(const Motion& motion) {
  if (std::holds_alternative<RigidMotion>(motion)) return MotionKind::rigid;
  if (std::holds_alternative<Deformer>(motion)) return MotionKind::deforms;
  return MotionKind::frames;
}

}  // namespace

MotionKind motion_of(const Scene& scene) {
  MotionKind kind = MotionKind::none;
  for (const Instance& instance : scene.instances) {
    if (motion_duration_s(instance.motion) > 0.0) kind = std::max(kind, motion_of(instance.motion));
  }
  return kind;
}

RunNeeds run_needs(const Scene& scene, const TriangleList& triangles, const RaySettings& rays,
                   const RunParts& parts) {
  RunNeeds needs;
  needs.picture = needs_of(scene, triangles, rays);
  if (parts.moves) needs.motion = motion_of(scene);
  needs.structures = parts.cpu || parts.gpu;
  needs.device = parts.gpu || parts.raster;
  needs.counting = parts.counting;
  return needs;
}

}  // namespace encore::scene
