#pragma once

#include "renderer/picture.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace encore::renderer {

/// What rasterisation draws into: a picture and a depth of one float a pixel. Kept from frame to
/// frame while the size stays.
class RasterTarget {
 public:
  RasterTarget() = default;
  ~RasterTarget();
  RasterTarget(const RasterTarget&) = delete;
  RasterTarget& operator=(const RasterTarget&) = delete;

  /// Throws GlError for a size beyond `most` (Capabilities::texture_size), or if the driver cannot
  /// draw into such pictures.
  void resize(int width, int height, int most);
  /// Makes it the framebuffer that is drawn into.
  void bind() const;
  /// Fills the bound target: the picture with `background`, the depth with 0, infinitely far.
  static void clear(const glm::vec3& background);

  [[nodiscard]] const Picture& picture() const { return picture_; }

 private:
  Picture picture_;
  std::uint32_t depth_ = 0;
  std::uint32_t framebuffer_ = 0;
};

}  // namespace encore::renderer
