#pragma once

#include "scene/diagnostics.h"
#include "scene/material.h"
#include "scene/mesh.h"

#include <string>
#include <vector>

namespace encore::scene {

/// What a model file holds: one merged mesh and the materials its triangles name.
/// `materials` is never empty when the mesh has triangles.
struct Model {
  std::string name;
  Mesh mesh;
  std::vector<Material> materials;
  Warnings warnings;
};

}  // namespace encore::scene
