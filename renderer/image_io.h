#pragma once

#include "renderer/image.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace encore::renderer {

/// A linear value in [0, 1] (clamped; NaN counts as 0) as an 8-bit sRGB one, rounded to nearest
/// (IEC 61966-2-1). The same on every machine.
std::uint8_t to_srgb8(float linear);

/// Writes an image as an 8-bit sRGB PNG. The file appears complete or not at all: it is written
/// beside its place under another name and then renamed. A place that is no regular file
/// (/dev/stdout, a pipe) is written to directly. Any path that the system knows is fine, whatever
/// its letters. Throws std::runtime_error ("path: what failed: why") if the folder is missing or
/// cannot be written to, or the disk is full; std::invalid_argument for an image without pixels.
void write_png(const Image& image, const std::filesystem::path& path);
/// Likewise of sRGB codes, three bytes a pixel, rows from the top.
void write_png(std::span<const std::uint8_t> codes, int width, int height,
               const std::filesystem::path& path);

}  // namespace encore::renderer
