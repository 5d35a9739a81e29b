#pragma once

#include "scene/bounds.h"
#include "scene/scene.h"
#include "scene/texture_reader.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace encore::scene {

/// A scene of more triangles than this is refused: it would not fit the memory, and a few lines of
/// a scene file could ask for it.
inline constexpr std::uint64_t kMaxSceneTriangles = 200'000'000;
inline constexpr std::size_t kMaxInstances = 100'000;
inline constexpr std::size_t kMaxMaterials = 1'000'000;
inline constexpr std::size_t kMaxFrames = 100'000;
/// Scene files are text for people; a larger one is a mistake (often a model with a wrong name).
inline constexpr std::uintmax_t kMaxSceneFileBytes = 16U << 20U;

/// Finds and loads what a scene file names, each thing once however often it is named.
class Assets {
 public:
  /// Files are looked for at their path in `folder`, then, entry by entry, at their path and at
  /// their bare file name in the search path. An empty folder means that no file is looked up.
  Assets(std::filesystem::path folder, std::vector<std::filesystem::path> search_path);

  /// A model file. Throws InputError, led by `place` (file:line[:column]), which names the paths
  /// tried. The model's own warnings are passed on to `warnings` at its first use.
  std::shared_ptr<const Model> model(const std::string& file, const std::string& place,
                                     Warnings& warnings);

  /// A picture file for a material. Throws InputError as model() does.
  std::shared_ptr<const Texture> texture(const std::string& file, const std::string& place);

  /// A sample scene or a basic shape (a scene of one instance) by name. Throws InputError with the
  /// nearest name.
  std::shared_ptr<const Scene> generated(const std::string& name, const std::string& place);

  /// The model files of a folder in natural order (frame2 before frame10). Throws InputError if it
  /// cannot be found or holds none.
  std::vector<std::string> frames_of_folder(const std::string& folder, const std::string& place);

  /// Adds an instance with either its model's own materials or, if `material` is given, that one
  /// for all its triangles. Textures stay only where a mesh has texture coordinates; one that was
  /// given for nothing is a warning. Throws InputError, led by `place`, at the limits above; what
  /// counts of a sequence is its largest frame.
  void add(Scene& scene, Instance instance, const Material* material, const std::string& place);

 private:
  [[nodiscard]] std::filesystem::path find(const std::string& file, bool want_folder,
                                           const std::string& what, const std::string& place) const;

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> search_path_;
  std::map<std::filesystem::path, std::shared_ptr<const Model>> models_;
  std::map<std::string, std::shared_ptr<const Scene>> generated_;
  TextureSet textures_;
  std::uint64_t triangles_ = 0;  ///< added so far
};

/// Bounds of a whole scene at time 0.
Bounds bounds_at_start(const Scene& scene);

/// A whole text file. Throws InputError if it cannot be read or is over kMaxSceneFileBytes.
std::string read_scene_text(const std::filesystem::path& path);

/// A white light at the camera, if the scene has none.
void add_default_light(Scene& scene);

}  // namespace encore::scene
