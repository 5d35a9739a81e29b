#pragma once

#include "scene/model.h"
#include "scene/transform.h"

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace encore::scene {

/// One pose of a rigid part at a time; between keys translation and scale are interpolated linearly
/// and rotation spherically. Before the first and after the last key the pose is held.
struct Keyframe {
  float time_s = 0.0F;
  Transform pose;
};

/// A rigid part that follows keyframes (its pose is applied after the instance's own transform).
struct RigidMotion {
  std::vector<Keyframe> keys;  ///< sorted by time, at least one
};

/// A surface deformed by a formula; topology stays. All act on model-space positions after the
/// instance's transform; `amplitude` is in world units, `frequency_hz` in cycles a second.
/// Formulas: scene/deform.h.
struct Deformer {
  enum class Kind {
    wave,     ///< displacement along `axis` by a travelling sine of wavelength `wavelength`
    twist,    ///< rotation around `axis` by an angle that grows along it (amplitude in radians)
    explode,  ///< every triangle's vertices move away from the centre, growing with time
  };
  Kind kind = Kind::wave;
  glm::vec3 axis{0.0F, 1.0F, 0.0F};
  float amplitude = 1.0F;
  float wavelength = 10.0F;
  float frequency_hz = 0.5F;
};

/// A sequence of meshes shown one after the other; their triangle counts may differ.
struct FrameSequence {
  std::vector<std::shared_ptr<const Model>> frames;  ///< at least one
  float frames_per_second = 10.0F;
};

using Motion = std::variant<std::monostate, RigidMotion, Deformer, FrameSequence>;

}  // namespace encore::scene
