#pragma once

#include "scene/obj_reader_mtl.h"
#include "scene/texture_reader.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace encore::scene {

/// The materials that an OBJ file names: looks up its material files and numbers the materials that
/// are used in the order of their first use.
class ObjMaterials {
 public:
  /// An empty `folder` means that no material files are looked up.
  ObjMaterials(std::filesystem::path folder, TextureSet& textures, Warnings& warnings)
      : folder_(std::move(folder)), textures_(textures), warnings_(warnings) {}

  /// `mtllib`: one file name with blanks in it, as most programs write it, or several names, blanks
  /// in them escaped by a backslash. `place` as in messages ("file:line").
  void read_files(std::string_view names, const std::string& place);

  /// `usemtl`: the number of the material. One that no file defines is grey, and warned about.
  std::uint32_t use(std::string_view name, const std::string& place);

  /// All materials used so far; adds the warning about unknown ones. Their textures are read only
  /// if there is use for them.
  std::vector<Material> take(bool with_textures);

 private:
  bool try_name(const std::string& name);
  bool try_file(const std::filesystem::path& path);

  std::filesystem::path folder_;
  TextureSet& textures_;
  Warnings& warnings_;
  std::set<std::string> files_;  // looked up so far, found or not
  MaterialsByName known_;
  std::map<std::string, std::uint32_t, std::less<>> used_;
  std::vector<MtlMaterial> materials_;
  std::uint64_t unknown_ = 0;
  std::string first_unknown_;
  bool missing_file_ = false;
};

}  // namespace encore::scene
