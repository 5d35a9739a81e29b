#pragma once

#include "renderer/image.h"

#include <cstdint>

namespace encore::renderer {

/// A picture on the device: a texture of four floats a pixel (rgba32f), linear RGB, row 0 at the
/// top. Kept from frame to frame while the size stays.
class Picture {
 public:
  Picture() = default;
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  /// Throws GlError for a size beyond `most` (Capabilities::texture_size).
  void resize(int width, int height, int most);
  /// Makes it the image that compute shaders write (ENCORE_BINDING_PICTURE).
  void bind() const;
  /// Fetches it; resizes `image`. Waits until the device has drawn it.
  void read(Image& image) const;

  [[nodiscard]] std::uint32_t texture() const { return texture_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  std::uint32_t texture_ = 0;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace encore::renderer
