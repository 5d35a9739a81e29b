#pragma once

#include "scene/animation.h"
#include "scene/camera.h"
#include "scene/diagnostics.h"
#include "scene/light.h"
#include "scene/material.h"
#include "scene/model.h"
#include "scene/transform.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace encore::scene {

/// A model placed in the world. Its triangles' materials are `first_material + mesh.material_of`
/// (indices into Scene::materials).
struct Instance {
  std::string name;
  std::shared_ptr<const Model> model;
  glm::mat4 transform{1.0F};
  std::uint32_t first_material = 0;
  Motion motion;
  /// Applied last, after the motion: places an instance that moves by itself (a generated scene's
  /// part) somewhere else.
  glm::mat4 placement{1.0F};
};

/// A setting that the scene file states for this scene; the program checks name and value where
/// they are used, and `place` (file:line:column) leads the message if they are wrong.
struct Preference {
  std::string
      key;  ///< dotted: "structure", "policy", "device", "threads", "rays", "grid.cells_per_axis" …
  std::string value;
  std::string place;
};

/// A whole scene: owned content, nothing derived. Whoever edits it calls mark_changed().
class Scene {
 public:
  std::string name;
  std::string source;  ///< file it came from, or "procedural"
  std::vector<Instance> instances;
  std::vector<Material> materials;
  std::vector<Light> lights;
  Camera camera;
  glm::vec3 background{0.0F};
  std::vector<Preference> preferences;
  Warnings warnings;

  /// Grows by one with every edit; whoever derived something from the scene compares it to see
  /// whether there is anything to do. Nothing rebuilds when nothing changed.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  void mark_changed() { ++version_; }

  [[nodiscard]] bool animated() const;
  /// Length of one loop of the animation in seconds; 0 for a static scene.
  [[nodiscard]] double duration_s() const;

 private:
  std::uint64_t version_ = 1;
};

}  // namespace encore::scene
