#pragma once

#include "scene/scene_file.h"
#include "scene/triangles.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

namespace encore::scene::test {

namespace fs = std::filesystem;

/// A folder of its own for each test, removed at the end.
class TempFolder {
 public:
  TempFolder() {
    std::string pattern = (fs::temp_directory_path() / "encore-scenes-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~TempFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }
  fs::path write(const fs::path& name, std::string_view text) const {
    const fs::path full = path_ / name;
    fs::create_directories(full.parent_path());
    std::ofstream(full, std::ios::binary) << text;
    return full;
  }

 private:
  fs::path path_;
};

/// One triangle with corners (0,0,0), (2,0,0), (0,1,0).
inline constexpr std::string_view kTriangleObj = "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n";
/// A square of two triangles.
inline constexpr std::string_view kSquareObj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

/// The folder of real models, or an empty path.
inline fs::path models_folder() {
  const char* given = std::getenv("ENCORE_MODELS");
  const fs::path folder =
      given != nullptr ? fs::path(given) : fs::path(ENCORE_SOURCE_DIR) / ".." / "shared" / "models";
  return fs::is_directory(folder) ? folder : fs::path();
}

/// The message of the InputError that `action` throws; a failure if it throws none.
template <class Action>
std::string error_of(Action&& action) {
  try {
    std::forward<Action>(action)();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError was thrown";
  return {};
}

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

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
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
