#pragma once

#include "renderer/gl/context.h"
#include "renderer/image.h"
#include "renderer/overlay/flat_texture.h"

#include <cstdint>
#include <memory>
#include <span>

namespace encore::renderer {

/// Writes a picture as four bytes a pixel: red, green, blue in sRGB, exactly the codes that
/// write_png() writes (to_srgb8), and 255. Throws std::invalid_argument unless rgba.size() is four
/// times the number of pixels.
void picture_to_rgba8(const Image& picture, std::span<std::uint8_t> rgba);

/// The linear value in the middle of an sRGB code; to_srgb8() gives the code back.
float srgb8_to_linear(std::uint8_t code);

/// A picture from the processor's memory as a texture for the window, reused while its size stays.
/// Its content is copied by the driver at once: the memory may be reused when upload() returns. The
/// context's state is left as it was found.
class ScreenTexture {
 public:
  explicit ScreenTexture(std::shared_ptr<gl::Context> context);
  ~ScreenTexture();
  ScreenTexture(const ScreenTexture&) = delete;
  ScreenTexture& operator=(const ScreenTexture&) = delete;

  /// Four bytes a pixel, rows from the top. Throws std::invalid_argument if there is no pixel or
  /// `rgba` is not 4 * width * height long, GlError if the device cannot hold it.
  void upload(std::span<const std::uint8_t> rgba, int width, int height);

  /// 0 before the first upload; another one after the size changed.
  [[nodiscard]] std::uint32_t texture() const { return texture_.id(); }
  [[nodiscard]] int width() const { return texture_.width(); }
  [[nodiscard]] int height() const { return texture_.height(); }

 private:
  std::shared_ptr<gl::Context> context_;
  FlatTexture texture_{PixelKind::rgba8};
};

}  // namespace encore::renderer
