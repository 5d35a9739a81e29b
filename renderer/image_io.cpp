#include "renderer/image_io.h"

#include "renderer/portable_power.h"

#include <fmt/format.h>
#include <stb_image_write.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace encore::renderer {

namespace {

namespace fs = std::filesystem;

/// The linear values at which the 8-bit code goes from k to k + 1.
std::array<float, 255> make_thresholds() {
  std::array<float, 255> thresholds{};
  for (int k = 0; k < 255; ++k) {
    const double encoded = (k + 0.5) / 255.0;
    thresholds[static_cast<std::size_t>(k)] = static_cast<float>(
        encoded <= 0.04045 ? encoded / 12.92 : portable_power((encoded + 0.055) / 1.055, 2.4));
  }
  return thresholds;
}

std::vector<unsigned char> encode_png(std::span<const std::uint8_t> codes, int width, int height) {
  std::vector<unsigned char> png;
  const auto append = [](void* context, void* data, int size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    auto* target = static_cast<std::vector<unsigned char>*>(context);
    target->insert(target->end(), bytes, bytes + size);
  };
  if (stbi_write_png_to_func(append, &png, width, height, 3, codes.data(), width * 3) == 0) {
    throw std::runtime_error("not enough memory to compress the picture");
  }
  return png;
}

[[noreturn]] void fail(const fs::path& path, const char* what, int error) {
  const std::string why =
      error != 0 ? std::generic_category().message(error) : std::string("unknown reason");
  throw std::runtime_error(fmt::format("{}: {}: {}", path.string(), what, why));
}

/// Writes all bytes and makes sure that they arrived; `named` is the file that messages speak of.
void write_bytes(const std::vector<unsigned char>& bytes, const fs::path& path,
                 const fs::path& named) {
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  if (!file) fail(named, "cannot create the picture", errno);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) fail(named, "cannot write the picture", errno);
}

}  // namespace

std::uint8_t to_srgb8(float linear) {
  static const std::array<float, 255> kThresholds = make_thresholds();
  if (!(linear > 0.0F)) return 0;
  const auto above = std::upper_bound(kThresholds.begin(), kThresholds.end(), linear);
  return static_cast<std::uint8_t>(above - kThresholds.begin());
}

void write_png(const Image& image, const fs::path& path) {
  std::vector<std::uint8_t> codes;
  codes.reserve(image.pixels.size() * 3);
  for (const glm::vec3& pixel : image.pixels) {
    for (int channel = 0; channel < 3; ++channel) codes.push_back(to_srgb8(pixel[channel]));
  }
  write_png(codes, image.width, image.height, path);
}

void write_png(std::span<const std::uint8_t> codes, int width, int height, const fs::path& path) {
  if (width <= 0 || height <= 0) {
    throw std::invalid_argument("a picture needs at least one pixel each way");
  }
  if (codes.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3) {
    throw std::invalid_argument("a picture has three bytes a pixel");
  }
  const std::vector<unsigned char> png = encode_png(codes, width, height);

  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) fail(path, "cannot create the picture", EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    write_bytes(png, path, path);
    return;
  }
  // Behind a symbolic link the file that it leads to is replaced, not the link.
  fs::path place = path;
  if (fs::exists(status)) {
    place = fs::canonical(path, error);
    if (error) place = path;
  }
  fs::path beside = place;
  beside += fmt::format(".{}.part", getpid());
  try {
    write_bytes(png, beside, path);
    fs::rename(beside, place, error);
    if (error) fail(path, "cannot put the finished picture in its place", error.value());
  } catch (...) {
    fs::remove(beside, error);
    throw;
  }
}

}  // namespace encore::renderer
