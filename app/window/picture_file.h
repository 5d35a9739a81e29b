#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace encore::app {

/// Writes pixels (four bytes each, rows from the top, opaque) as PNG. Throws std::runtime_error
/// that names the file.
void write_rgba_png(const std::filesystem::path& file, int width, int height,
                    std::span<const std::uint8_t> rgba);
/// Likewise three bytes a pixel, of a rectangle of a larger picture of `stride` pixels a row.
void write_rgb_png(const std::filesystem::path& file, std::span<const std::uint8_t> rgb, int stride,
                   int x, int y, int width, int height);

/// A new name below the user's pictures ("encore-cpu-20260131-235959.png" in XDG_PICTURES_DIR's
/// encore folder, ~/Pictures/encore); makes the folder.
std::filesystem::path new_picture_file(std::string_view what);

}  // namespace encore::app
