#pragma once

#include "scene/diagnostics.h"
#include "scene/texture.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace encore::scene {

/// A larger texture is refused: neither side may be longer, nor the texels take more bytes.
inline constexpr int kMaxTextureSide = 16384;
inline constexpr std::uint64_t kMaxTextureBytes = 256U << 20U;
/// All textures of a scene together; those beyond are left out with a warning.
inline constexpr std::uint64_t kMaxSceneTextureBytes = 2ULL << 30U;

/// Decodes PNG, JPEG, TGA, BMP, PNM, GIF (its first picture), PSD and PIC; transparency is left
/// out, grey becomes colour. Throws InputError ("name: ...") for anything else, broken pictures and
/// those beyond the limits. In this process: decode what comes from outside with read_texture.
Texture decode_texture(std::string_view bytes, const std::string& name);

/// Reads a picture file, in a child process with limits on memory and time, because pictures are as
/// little to be trusted as models. Throws InputError, led by the path.
Texture read_texture(const std::filesystem::path& path);

/// The textures of one scene: each file is read once, and all materials that name it share it.
class TextureSet {
 public:
  TextureSet() = default;
  /// Further folders: each is tried with the path as stated, then with the bare file name.
  explicit TextureSet(std::vector<std::filesystem::path> search_path)
      : search_path_(std::move(search_path)) {}

  /// Reads the file, unless it was read before. Throws InputError as read_texture does, and at
  /// kMaxSceneTextureBytes.
  std::shared_ptr<const Texture> read(const std::filesystem::path& path);

  /// The texture that a file in `folder` names, as models do: also with the slashes of Windows or
  /// a path of another machine, of which only the file name is of use. Null if it cannot be had;
  /// why is then a warning "place: material "...": ..." (once for each file).
  std::shared_ptr<const Texture> load(const std::string& stated,
                                      const std::filesystem::path& folder, const std::string& place,
                                      const std::string& material, Warnings& warnings);

 private:
  [[nodiscard]] std::vector<std::filesystem::path> candidates(
      const std::string& stated, const std::filesystem::path& folder) const;

  std::vector<std::filesystem::path> search_path_;
  std::map<std::filesystem::path, std::shared_ptr<const Texture>> read_;
  std::set<std::filesystem::path> warned_;
  std::uint64_t bytes_ = 0;
};

}  // namespace encore::scene
