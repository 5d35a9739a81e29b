#pragma once

#include "scene/mesh_reader.h"
#include "scene/model.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
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

/// The folder of real models beside the project; empty if it is not there.
inline std::filesystem::path real_models() {
  const char* folder = std::getenv("ENCORE_MODELS");
  const std::filesystem::path path =
      folder != nullptr ? std::filesystem::path(folder)
                        : std::filesystem::path(ENCORE_SOURCE_DIR) / "../shared/models";
  return std::filesystem::exists(path / "INDEX.tsv") ? path : std::filesystem::path();
}

/// A file that exists as long as this object.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, std::string_view content) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("encore-") + test->test_suite_name() + "-" + test->name());
    std::filesystem::create_directories(folder_);
    path = folder_ / name;
    std::ofstream(path, std::ios::binary)
        .write(content.data(), static_cast<std::streamsize>(content.size()));
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::filesystem::path path;

 private:
  std::filesystem::path folder_;
};

/// The message of the InputError that `action` throws; fails the test if it throws none.
template <typename Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError";
  return {};
}

inline bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

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
