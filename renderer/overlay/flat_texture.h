#pragma once

#include <cstdint>
#include <span>

namespace encore::renderer {

/// What a pixel of a FlatTexture is.
enum class PixelKind {
  rgba8,     ///< four bytes
  distance,  ///< one float
};

/// A two-dimensional texture without smaller versions of itself, kept while its size stays. The
/// context's state is left as it was found.
class FlatTexture {
 public:
  explicit FlatTexture(PixelKind kind) : kind_(kind) {}
  ~FlatTexture();
  FlatTexture(const FlatTexture&) = delete;
  FlatTexture& operator=(const FlatTexture&) = delete;

  /// Makes it that large; what it held is lost if it was not. Throws std::invalid_argument unless
  /// there is a pixel each way, GlError for a size beyond `most` (Capabilities::texture_size) or if
  /// the device has no room.
  void resize(int width, int height, int most);
  /// Replaces all pixels, rows from the top; must be as many as there are.
  void write(std::span<const std::uint8_t> rgba);
  void write(std::span<const float> distances);
  /// Fetches all pixels of four bytes; waits until the device has drawn them.
  void read(std::span<std::uint8_t> rgba) const;
  void release();

  [[nodiscard]] std::uint32_t id() const { return id_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] std::size_t pixels() const {
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  }

 private:
  PixelKind kind_;
  std::uint32_t id_ = 0;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace encore::renderer
