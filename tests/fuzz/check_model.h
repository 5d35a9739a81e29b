#pragma once

#include "scene/model.h"
#include "scene/triangle.h"

#include <pthread.h>
#include <sanitizer/common_interface_defs.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace encore::fuzz {

/// Ends the program unless the model keeps what Mesh and Model promise.
inline void check_model(const scene::Model& model) {
  const scene::Mesh& mesh = model.mesh;
  const std::size_t vertices = mesh.positions.size();
  const auto fits = [vertices](std::size_t size) { return size == 0 || size == vertices; };
  bool sound = fits(mesh.normals.size()) && fits(mesh.texcoords.size()) &&
               fits(mesh.colors.size()) && (mesh.triangles.empty() || !model.materials.empty()) &&
               (mesh.material_of.empty() || mesh.material_of.size() == mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) {
    sound = sound && t.x < vertices && t.y < vertices && t.z < vertices;
  }
  for (const glm::vec3& p : mesh.positions) sound = sound && scene::is_finite(p);
  for (const std::uint32_t m : mesh.material_of) sound = sound && m < model.materials.size();
  if (!sound) std::abort();
}

/// Keeps a crash in a child process of the guard from being filed as a finding: the sanitizer would
/// call libFuzzer's handler there too. Call once from LLVMFuzzerInitialize.
inline void expect_crashes_in_children() {
  pthread_atfork(nullptr, nullptr, [] { __sanitizer_set_death_callback(nullptr); });
}

/// Runs a reader; InputError with a message is the one way in which it may fail.
template <typename Reader>
void check_reader(const Reader& read) {
  try {
    check_model(read());
  } catch (const scene::InputError& error) {
    if (std::string(error.what()).empty()) std::abort();
  }
}

}  // namespace encore::fuzz
