#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace encore::renderer {

/// Sets what of a context's state decides how an overlay becomes pixels, and puts it all back at
/// the end of its life, so that a window's other drawing is not disturbed. Kept are switches,
/// blending, viewport, masks, the program, the vertex array, the framebuffers, and what is bound to
/// the texture units that the overlay's shaders look at (0 to 3), with their samplers. Buffers stay
/// bound where shaders look for them.
class OverlayState {
 public:
  /// No depth, everything blended over what is there, all of a width x height picture.
  OverlayState(int width, int height, bool clip_control);
  ~OverlayState();
  OverlayState(const OverlayState&) = delete;
  OverlayState& operator=(const OverlayState&) = delete;

 private:
  static constexpr std::size_t kSwitches = 18;
  static constexpr std::size_t kUnits = 4;

  void save_units();
  void restore_units() const;

  bool clip_control_ = false;
  std::array<std::uint8_t, kSwitches> switches_{};
  int program_ = 0;
  int vertex_array_ = 0;
  int draw_framebuffer_ = 0;
  int read_framebuffer_ = 0;
  std::array<int, 4> viewport_{};
  std::array<int, 2> polygon_mode_{};  ///< old drivers answer twice
  std::array<int, 6> blend_{};         ///< two equations, four factors
  int clip_origin_ = 0;
  int clip_depth_ = 0;
  std::array<std::uint8_t, 4> color_mask_{};
  int active_unit_ = 0;
  std::array<int, kUnits> textures_{};
  std::array<int, kUnits> buffer_textures_{};
  std::array<int, kUnits> samplers_{};
};

/// Sets how pixels travel between memory and textures (rows without gaps, no buffer between), and
/// what texture is bound to GL_TEXTURE_2D of the active unit; puts both back.
class PixelTransferState {
 public:
  explicit PixelTransferState(std::uint32_t texture);
  ~PixelTransferState();
  PixelTransferState(const PixelTransferState&) = delete;
  PixelTransferState& operator=(const PixelTransferState&) = delete;

 private:
  static constexpr std::size_t kSettings = 8;

  std::array<int, kSettings> settings_{};
  int pack_buffer_ = 0;
  int unpack_buffer_ = 0;
  int texture_ = 0;
};

}  // namespace encore::renderer
