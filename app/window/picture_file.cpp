#include "app/window/picture_file.h"

#include "app/profile_folder.h"
#include "renderer/image_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace encore::app {

namespace fs = std::filesystem;

namespace {

fs::path pictures_folder() {
  if (const char* xdg = std::getenv("XDG_PICTURES_DIR"); xdg != nullptr && xdg[0] == '/') {
    return fs::path(xdg) / "encore";
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && home[0] == '/') {
    return fs::path(home) / "Pictures" / "encore";
  }
  throw std::runtime_error("there is no home folder to keep pictures in; set HOME");
}

}  // namespace

void write_rgba_png(const fs::path& file, int width, int height,
                    std::span<const std::uint8_t> rgba) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(rgba.size() / 4 * 3);
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) {
    rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
  }
  renderer::write_png(rgb, width, height, file);
}

void write_rgb_png(const fs::path& file, std::span<const std::uint8_t> rgb, int stride, int x,
                   int y, int width, int height) {
  std::vector<std::uint8_t> part;
  part.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  for (int row = y; row < y + height; ++row) {
    const auto begin = (static_cast<std::size_t>(row) * static_cast<std::size_t>(stride) +
                        static_cast<std::size_t>(x)) *
                       3;
    const auto pixels = rgb.subspan(begin, static_cast<std::size_t>(width) * 3);
    part.insert(part.end(), pixels.begin(), pixels.end());
  }
  renderer::write_png(part, width, height, file);
}

fs::path new_picture_file(std::string_view what) {
  const fs::path folder = pictures_folder();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw std::runtime_error(
        fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
  }
  std::string stamp = utc_now();
  std::erase_if(stamp, [](char c) { return c == '-' || c == ':'; });
  for (int number = 1;; ++number) {
    const std::string suffix = number == 1 ? "" : fmt::format("-{}", number);
    fs::path file = folder / fmt::format("encore-{}-{}{}.png", what, stamp, suffix);
    if (!fs::exists(file, error)) return file;
  }
}

}  // namespace encore::app
