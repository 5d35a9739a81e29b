#pragma once

#include "scene/scene_file.h"
#include "scene/triangles.h"
#include "tests/support/files.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>

namespace encore::scene::test {

namespace fs = std::filesystem;

using encore::test::contains;
using encore::test::error_of;
using encore::test::real_models;
using encore::test::TemporaryFolder;

/// One triangle with corners (0,0,0), (2,0,0), (0,1,0).
inline constexpr std::string_view kTriangleObj = "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n";
/// A square of two triangles.
inline constexpr std::string_view kSquareObj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

inline Scene parse(std::string_view text, const fs::path& folder = {}) {
  return parse_scene_toml(text, "scene.toml", folder);
}

inline std::string error_in(std::string_view text, const fs::path& folder = {}) {
  return error_of([&] { parse(text, folder); });
}

inline TriangleList triangles_at(const Scene& scene, double time_s = 0.0) {
  TriangleList list;
  update_triangles(scene, time_s, list);
  return list;
}

inline std::string joined(const Warnings& warnings) {
  std::string all;
  for (const std::string& message : warnings.messages) all += message + "\n";
  return all;
}

inline ::testing::AssertionResult near(const glm::vec3& a, const glm::vec3& b,
                                       float limit = 1e-5F) {
  const glm::vec3 d = a - b;
  if (std::abs(d.x) <= limit && std::abs(d.y) <= limit && std::abs(d.z) <= limit) {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << "(" << a.x << ", " << a.y << ", " << a.z << ") against ("
                                       << b.x << ", " << b.y << ", " << b.z << ")";
}

}  // namespace encore::scene::test
