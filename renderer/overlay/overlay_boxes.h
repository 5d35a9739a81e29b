#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/overlay/overlay_items.h"
#include "scene/bounds.h"

#include <cstdint>
#include <optional>
#include <span>

namespace encore::renderer {

/// The device's copy of all boxes of a structure: texture buffers, which any vertex shader of
/// OpenGL 4.3 can read at random (storage buffers in vertex shaders are optional there).
class OverlayBoxes {
 public:
  OverlayBoxes() = default;
  ~OverlayBoxes();
  OverlayBoxes(const OverlayBoxes&) = delete;
  OverlayBoxes& operator=(const OverlayBoxes&) = delete;

  /// Sends them, with their colours, unless `version` was the last one sent. Returns the bytes
  /// sent. Throws GlError if the device cannot hold so many.
  std::uint64_t set(std::span<const OverlayBox> boxes, std::uint64_t version);
  /// Replaces the colours alone, likewise. Throws std::invalid_argument unless there is one a box.
  std::uint64_t set_colors(std::span<const std::uint32_t> rgba, std::uint64_t version);
  /// Binds them to the texture units that the shaders read.
  void bind() const;

  [[nodiscard]] std::size_t count() const { return count_; }
  /// Of all boxes that can be drawn.
  [[nodiscard]] const scene::Bounds& bounds() const { return bounds_; }
  /// Whether any of them is flagged as filled.
  [[nodiscard]] bool any_filled() const { return any_filled_; }

 private:
  gl::Buffer data_{"the overlay's boxes"};
  gl::Buffer colors_{"the colours of the overlay's boxes"};
  std::uint32_t data_texture_ = 0;
  std::uint32_t color_texture_ = 0;
  std::size_t count_ = 0;
  scene::Bounds bounds_;
  bool any_filled_ = false;
  std::optional<std::uint64_t> version_;
  std::optional<std::uint64_t> color_version_;
};

}  // namespace encore::renderer
