#pragma once

#include "scene/mesh_reader.h"
#include "scene/model.h"
#include "tests/support/files.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>

// Sanitizers change what memory a process takes and how it fails; tests of that are left out there.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ENCORE_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ENCORE_SANITIZED 1
#endif
#endif
#ifndef ENCORE_SANITIZED
#define ENCORE_SANITIZED 0
#endif

namespace encore::scene {

inline std::filesystem::path fixture(const std::string& name) {
  return std::filesystem::path(ENCORE_FIXTURES) / "models" / name;
}

using test::contains;
using test::contents_of;
using test::error_of;
using test::real_models;
using test::TemporaryFolder;

inline bool warns(const Model& model, std::string_view part) {
  for (const std::string& message : model.warnings.messages) {
    if (contains(message, part)) return true;
  }
  return false;
}

/// Twice the area of the triangle, along z for polygons in the xy plane.
inline double doubled_area(const Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.positions[t.x]);
  const glm::dvec3 b(mesh.positions[t.y]);
  const glm::dvec3 c(mesh.positions[t.z]);
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace encore::scene
