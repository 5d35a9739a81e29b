#include "scene/texture_reader.h"

#include "scene/load_watch.h"
#include "scene/model_child_process.h"
#include "scene/model_input.h"

#include <stb_image.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <system_error>
#include <utility>

namespace encore::scene {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kMebibyte = 1U << 20U;
// Nothing that fits the limits on texels needs more, however badly it is packed.
constexpr std::uint64_t kMaxFileBytes = 2 * kMaxTextureBytes;

[[noreturn]] void fail(const std::string& name, const std::string& what) {
  throw InputError(name + ": " + what);
}

/// Before anything is decoded, so that nothing large is asked for in vain.
void check_size(int width, int height, const std::string& name) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height) + " texels";
  if (width < 1 || height < 1) fail(name, "has no texels; export the picture anew");
  const auto bytes = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * 4U;
  if (width > kMaxTextureSide || height > kMaxTextureSide || bytes > kMaxTextureBytes) {
    fail(name, "has " + size + "; the limits are " + std::to_string(kMaxTextureSide) +
                   " a side and " + std::to_string(kMaxTextureBytes / kMebibyte) +
                   " MiB; scale it down");
  }
}

std::string pack(const Texture& texture) {
  std::string bytes(8 + texture.bytes(), '\0');
  std::memcpy(bytes.data(), &texture.width, 4);
  std::memcpy(bytes.data() + 4, &texture.height, 4);
  std::memcpy(bytes.data() + 8, texture.texels.data(), texture.bytes());
  return bytes;
}

/// A decoder that was led astray could have returned anything.
bool unpack(std::string_view bytes, Texture& texture) {
  if (bytes.size() < 8) return false;
  std::memcpy(&texture.width, bytes.data(), 4);
  std::memcpy(&texture.height, bytes.data() + 4, 4);
  if (texture.width < 1 || texture.height < 1 || texture.width > kMaxTextureSide ||
      texture.height > kMaxTextureSide) {
    return false;
  }
  const auto count =
      static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
  if (bytes.size() != 8 + 4 * count) return false;
  texture.texels.resize(count);
  std::memcpy(texture.texels.data(), bytes.data() + 8, 4 * count);
  return true;
}

}  // namespace

Texture decode_texture(std::string_view bytes, const std::string& name) {
  if (bytes.empty()) fail(name, "the file is empty (0 bytes); get a whole copy of it");
  if (bytes.size() > kMaxFileBytes) {
    fail(name, "is larger than " + std::to_string(kMaxFileBytes / kMebibyte) +
                   " MiB; scale the picture down");
  }
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0;
  int height = 0;
  int channels = 0;
  if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) {
    fail(name, std::string("is no picture that can be read (") + stbi_failure_reason() +
                   "); save it as PNG or JPEG");
  }
  check_size(width, height, name);
  const std::unique_ptr<stbi_uc, void (*)(void*)> texels(
      stbi_load_from_memory(data, size, &width, &height, &channels, 4), &stbi_image_free);
  if (texels == nullptr) {
    fail(name, std::string("is damaged (") + stbi_failure_reason() + "); save the picture anew");
  }
  check_size(width, height, name);

  Texture texture;
  texture.name = name;
  texture.width = width;
  texture.height = height;
  texture.texels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const stbi_uc* from = texels.get();
  for (std::uint32_t& texel : texture.texels) {
    texel = 0xFF000000U | (std::uint32_t{from[2]} << 16U) | (std::uint32_t{from[1]} << 8U) |
            std::uint32_t{from[0]};
    from += 4;
  }
  return texture;
}

Texture read_texture(const fs::path& path) {
  const std::string name = path.string();
  const std::string bytes = read_model_file(path);
  // The reply says by its first byte whether it is a texture or a message.
  const auto work = [&bytes, &name] {
    try {
      return "T" + pack(decode_texture(bytes, name));
    } catch (const InputError& error) {
      return "E" + std::string(error.what());
    }
  };
  ChildLimits limits;
  // The picture as read, as decoded (twice as deep at most), as texels and as the reply.
  limits.memory_bytes = 64 * kMebibyte + 2 * bytes.size() + 6 * kMaxTextureBytes;
  limits.cpu_seconds = 60;
  limits.wall_seconds = 300;
  using Outcome = ChildResult::Outcome;
  try {
    const ChildResult result = run_in_child(work, limits);
    if (result.outcome == Outcome::cancelled) throw LoadCancelled();
    if (result.outcome == Outcome::out_of_memory || result.outcome == Outcome::not_started) {
      fail(name, "there is not enough memory to read the picture; scale it down");
    }
    if (result.outcome == Outcome::finished && result.bytes.starts_with('E')) {
      throw InputError(result.bytes.substr(1));
    }
    Texture texture;
    if (result.outcome != Outcome::finished || !result.bytes.starts_with('T') ||
        !unpack(std::string_view(result.bytes).substr(1), texture)) {
      fail(name, "is damaged: reading it failed; save the picture anew");
    }
    texture.name = name;
    return texture;
  } catch (const std::bad_alloc&) {
    fail(name, "the picture does not fit into memory; scale it down");
  }
}

std::vector<fs::path> TextureSet::candidates(const std::string& stated,
                                             const fs::path& folder) const {
  std::string slashes = stated;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  const fs::path wanted(slashes);
  const fs::path bare = wanted.filename();
  std::vector<fs::path> paths{folder / stated};
  const auto add = [&paths](const fs::path& path) {
    if (std::find(paths.begin(), paths.end(), path) == paths.end()) paths.push_back(path);
  };
  add(folder / wanted);
  if (!bare.empty()) add(folder / bare);
  for (const fs::path& entry : search_path_) {
    if (!wanted.is_absolute()) add(entry / wanted);
    if (!bare.empty()) add(entry / bare);
  }
  return paths;
}

std::shared_ptr<const Texture> TextureSet::read(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  const fs::path& key = error ? path : canonical;
  if (const auto known = read_.find(key); known != read_.end()) return known->second;
  note_load(path.filename().string());
  Texture texture = read_texture(path);
  if (texture.bytes() > kMaxSceneTextureBytes - bytes_) {
    fail(path.string(), "the textures take more than " +
                            std::to_string(kMaxSceneTextureBytes / kMebibyte) +
                            " MiB together; scale them down");
  }
  bytes_ += texture.bytes();
  return read_.emplace(key, std::make_shared<const Texture>(std::move(texture))).first->second;
}

std::shared_ptr<const Texture> TextureSet::load(const std::string& stated, const fs::path& folder,
                                                const std::string& place,
                                                const std::string& material, Warnings& warnings) {
  const std::vector<fs::path> paths = candidates(stated, folder);
  const auto found = std::find_if(paths.begin(), paths.end(), [](const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
  });
  const fs::path& file = found == paths.end() ? paths.front() : *found;
  if (warned_.contains(file)) return nullptr;
  std::string wrong = "the texture \"" + printable(stated, 200) + "\" was not found";
  try {
    if (found != paths.end()) return read(file);
  } catch (const InputError& error) {
    wrong = error.what();
  }
  warned_.insert(file);
  warnings.add(place + ": material \"" + printable(material) + "\": " + wrong +
               "; drawn without a texture");
  return nullptr;
}

}  // namespace encore::scene
