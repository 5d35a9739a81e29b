#include "scene/obj_reader_materials.h"

#include "scene/model_input.h"

#include <algorithm>

namespace encore::scene {

namespace {

// More than this is no list of files but garbage, which must not turn into a search of the disk.
constexpr std::size_t kMostFiles = 64;

// Splits at blanks; a backslash in front of a blank makes it part of the name.
std::vector<std::string> split_names(std::string_view names) {
  std::vector<std::string> parts(1);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == '\\' && i + 1 < names.size() && names[i + 1] == ' ') {
      parts.back() += names[++i];
    } else if (names[i] == ' ' || names[i] == '\t') {
      if (!parts.back().empty()) parts.emplace_back();
    } else {
      parts.back() += names[i];
    }
  }
  return parts;
}

}  // namespace

bool ObjMaterials::try_file(const std::filesystem::path& path) {
  const auto [entry, is_new] = files_.insert(path.string());
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  if (!is_new) return true;
  try {
    read_mtl(read_model_file(path), path.string(), known_, warnings_);
  } catch (const InputError& unreadable) {
    warnings_.add(unreadable.what());
  }
  return true;
}

// As stated, then with the slashes of Windows turned, then beside the OBJ file.
bool ObjMaterials::try_name(const std::string& name) {
  if (name.empty() || files_.size() >= kMostFiles) return false;
  std::string slashes = name;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  const std::filesystem::path bare = std::filesystem::path(slashes).filename();
  return try_file(folder_ / name) || (slashes != name && try_file(folder_ / slashes)) ||
         (!bare.empty() && bare != name && try_file(folder_ / bare));
}

void ObjMaterials::read_files(std::string_view names, const std::string& place) {
  if (folder_.empty() || try_name(std::string(names))) return;
  bool found = false;
  for (const std::string& name : split_names(names)) {
    found = try_name(name) || found;
    if (files_.size() >= kMostFiles) break;
  }
  if (found || missing_file_) return;
  missing_file_ = true;
  warnings_.add(place + ": material file \"" + printable(names) +
                "\" not found; grey materials are used");
}

std::uint32_t ObjMaterials::use(std::string_view name, const std::string& place) {
  const auto used = used_.find(name);
  if (used != used_.end()) return used->second;
  const auto number = static_cast<std::uint32_t>(materials_.size());
  used_.emplace(name, number);
  const auto known = known_.find(name);
  if (known != known_.end()) {
    materials_.push_back(known->second);
    return number;
  }
  MtlMaterial grey;
  grey.name = name;
  materials_.push_back(grey);
  if (!name.empty() && unknown_++ == 0) first_unknown_ = place + ": material \"" + printable(name);
  return number;
}

std::vector<Material> ObjMaterials::take(bool with_textures) {
  if (unknown_ > 0) {
    const std::string others =
        unknown_ > 1 ? " (and " + counted(unknown_ - 1, "other") + ")" : std::string();
    warnings_.add(first_unknown_ + "\"" + others +
                  " is in no material file that was found; grey is used");
  }
  std::vector<Material> taken;
  for (MtlMaterial& material : materials_) {
    if (with_textures && !material.texture.empty()) {
      const std::filesystem::path folder = std::filesystem::path(material.file).parent_path();
      material.diffuse_texture =
          textures_.load(material.texture, folder.empty() ? std::filesystem::path(".") : folder,
                         material.file, material.name, warnings_);
    }
    taken.push_back(std::move(material));
  }
  materials_.clear();
  return taken;
}

}  // namespace encore::scene
