#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/program.h"
#include "renderer/image.h"
#include "renderer/overlay/flat_texture.h"
#include "renderer/overlay/overlay_boxes.h"
#include "renderer/overlay/overlay_geometry.h"
#include "renderer/overlay/overlay_items.h"
#include "renderer/overlay/overlay_view.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace encore::renderer {

/// What the last picture of an overlay came to.
struct OverlayReport {
  bool depth_missing = false;        ///< hidden parts were wanted, but drawn as in x_ray: the
                                     ///< surface's distance is not known
  std::uint32_t boxes = 0;           ///< drawn, or left out by the device for being empty
  std::uint64_t uploaded_bytes = 0;  ///< since the picture before: indices, and what changed
};

/// Draws an acceleration structure over a traced picture: boxes, planes, rays, points, triangles.
///
/// Lines are antialiased quadrilaterals in the picture's plane, of any thickness in pixels (core
/// profiles need not have wide lines). They, like all else, fall on the pixels at which the tracers
/// show the same points. What lies behind the eye is cut off; of an edge also what is closer to the
/// eye than 2^-14 of its own reach, where single precision no longer tells its direction.
///
/// Nothing here hides another part of the overlay: hidden is what lies behind the traced surface,
/// whose distance set_depth() gives, to within OverlayView::depth_bias.
///
/// The context's state is left as it was found, except for uniform buffer binding 2. It needs
/// OpenGL 4.3 core, no more.
class OverlayRenderer {
 public:
  /// Compiles. Throws std::invalid_argument without a context, GlError if the driver refuses.
  explicit OverlayRenderer(std::shared_ptr<gl::Context> context);
  ~OverlayRenderer();
  OverlayRenderer(const OverlayRenderer&) = delete;
  OverlayRenderer& operator=(const OverlayRenderer&) = delete;

  /// Keeps all boxes on the device, to be drawn by index; sends nothing if `version` is that of the
  /// last call. Throws GlError if they do not fit.
  void set_boxes(std::span<const OverlayBox> boxes, std::uint64_t version);
  /// Other colours for the same boxes (those in the boxes count until then), likewise with a
  /// version of their own. Throws std::invalid_argument unless there is one a box.
  void set_box_colors(std::span<const std::uint32_t> rgba, std::uint64_t version);

  /// How far along each pixel's ray (of unit length) the surface is, infinite where there is none:
  /// the `t` of Tracer::trace_hits() for the camera that will be drawn. Any size of the same shape;
  /// a pixel takes what is at its place. Throws as FlatTexture does.
  void set_depth(std::span<const float> distances, int width, int height);
  void set_depth(std::span<const scene::Hit> hits, int width, int height);
  /// Forgets it: the camera moved and no new one is there yet.
  void clear_depth();
  [[nodiscard]] bool has_depth() const { return depth_.id() != 0; }

  /// Draws and returns the picture: an opaque RGBA8 texture of the view's size, row 0 at the top.
  /// It stays this object's and is drawn over by the next call. Throws what make_overlay_block()
  /// does, std::invalid_argument for an index beyond the boxes, GlError if the device fails.
  std::uint32_t draw(const OverlayView& view, const OverlayItems& items);

  /// Fetches the last picture, four bytes a pixel, rows from the top. Throws std::logic_error
  /// before draw().
  void read(std::vector<std::uint8_t>& rgba);
  /// Likewise in linear values, for write_png(), which gives the very same codes.
  void read(Image& image);

  [[nodiscard]] std::uint32_t texture() const { return target_.id(); }
  [[nodiscard]] const OverlayReport& last() const { return report_; }

 private:
  void check_indices(std::span<const std::uint32_t> boxes) const;
  void attach_target(const OverlayView& view);
  void send(const OverlayView& view, const OverlayItems& items);
  void draw_backdrop(const OverlayView& view);
  void draw_faces(std::size_t boxes);
  void draw_edges(std::size_t boxes);
  void draw_boxes(std::size_t count, int vertices);

  std::shared_ptr<gl::Context> context_;
  std::shared_ptr<gl::Program> backdrop_;
  std::shared_ptr<gl::Program> box_faces_;
  std::shared_ptr<gl::Program> box_edges_;
  std::shared_ptr<gl::Program> faces_;
  std::shared_ptr<gl::Program> edges_;
  OverlayBoxes boxes_;
  OverlayGeometry geometry_;
  gl::Buffer block_{"the overlay's view"};
  gl::Buffer index_buffer_{"which boxes are drawn"};
  gl::Buffer face_buffer_{"the overlay's faces"};
  gl::Buffer line_buffer_{"the overlay's lines"};
  FlatTexture target_{PixelKind::rgba8};
  FlatTexture depth_{PixelKind::distance};
  std::vector<float> distances_;
  std::uint32_t framebuffer_ = 0;
  std::uint32_t framebuffer_texture_ = 0;  ///< what is attached to it; 0: nothing yet
  std::uint32_t box_array_ = 0;
  std::uint32_t face_array_ = 0;
  std::uint32_t line_array_ = 0;
  std::uint64_t unreported_bytes_ = 0;
  OverlayReport report_;
};

}  // namespace encore::renderer
