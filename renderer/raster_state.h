#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace encore::renderer {

/// Sets everything of a context's state that decides how triangles become pixels, and puts it all
/// back at the end of its life: the context may be a window's, in which others draw too. Kept are
/// also the program, the vertex array, the framebuffers and the viewport. Buffers stay bound where
/// shaders look for them.
class RasterState {
 public:
  /// Both sides of triangles, the greatest depth, depths from 0 to 1, nothing blended or cut away,
  /// all of a width x height picture. Needs Capabilities::clip_control.
  RasterState(int width, int height);
  ~RasterState();
  RasterState(const RasterState&) = delete;
  RasterState& operator=(const RasterState&) = delete;

 private:
  static constexpr std::size_t kSwitches = 9;

  std::array<std::uint8_t, kSwitches> switches_{};
  int program_ = 0;
  int vertex_array_ = 0;
  int draw_framebuffer_ = 0;
  int read_framebuffer_ = 0;
  std::array<int, 4> viewport_{};
  std::array<int, 2> polygon_mode_{};  ///< old drivers answer twice
  int depth_function_ = 0;
  int clip_origin_ = 0;
  int clip_depth_ = 0;
  std::array<double, 2> depth_range_{};
  std::uint8_t depth_mask_ = 0;
  std::array<std::uint8_t, 4> color_mask_{};
};

}  // namespace encore::renderer
