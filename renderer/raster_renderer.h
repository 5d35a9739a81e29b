#pragma once

#include "renderer/camera_rays.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/fence.h"
#include "renderer/gl/program.h"
#include "renderer/gpu_scene.h"
#include "renderer/raster_target.h"
#include "renderer/renderer.h"
#include "scene/bounds.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace encore::renderer {

/// Plain OpenGL rasterisation, without rays and without a structure: the preview, and the baseline
/// that the energy of ray casting is held against. Camera, pixel grid and shading are the tracers';
/// every triangle is drawn, from both sides, and a depth buffer keeps the nearest.
///
/// Pictures are the tracers' but for what a rasteriser decides otherwise: a pixel on an edge may go
/// to the neighbour, because points are rounded to single precision and to the device's subpixel
/// grid; of triangles at the same depth any may win, not the lower index; what lies closer to the
/// eye than 2^-64 of the distance to the farthest corner of the scene's bounds is cut off, and in
/// orthographic views depths and the plane through the eye are resolved to 2^-23 of that distance.
/// Colours
/// come from weights that the device interpolates, a few units of 2^-24 off; on a triangle that
/// passes the eye within 1e-7 of its size they are coarse.
///
/// The context's state is left as it was found, except for the buffers bound to the points of
/// shaders/shared/bindings.h and the texture bound to GL_TEXTURE_2D.
class RasterRenderer final : public Renderer {
 public:
  /// Throws GlError if the context has neither OpenGL 4.5 nor GL_ARB_clip_control.
  explicit RasterRenderer(std::shared_ptr<gl::Context> context);
  ~RasterRenderer() override;

  /// Sends the scene and compiles; `input.structure` is not looked at and may be null. Throws
  /// std::invalid_argument if scene or triangles are missing, GlError if something does not fit.
  void init(const RenderInput& input) override;
  /// Only whether there are textures.
  void set_rays(const scene::RaySettings& rays) override {
    scene_.set_rays({.textures = rays.textures});
  }
  /// Throws std::logic_error before init(), GlError if something does not fit; then nothing can be
  /// drawn until another refresh() or init() succeeds.
  void refresh() override;
  /// Throws std::logic_error before init() or after a refresh() that failed, std::invalid_argument
  /// for a camera or a size that make_camera_frame() rejects, GlError if the picture is too large
  /// or the device fails.
  void draw(const scene::Camera& camera, int width, int height) override;
  /// Throws std::logic_error before draw().
  void read(Image& image) override;

  [[nodiscard]] bool transfers() const override { return true; }
  [[nodiscard]] Transfer last_transfer() const override { return transfer_; }
  [[nodiscard]] std::optional<double> last_draw_s() const override { return draw_s_; }
  [[nodiscard]] std::string device_name() const override;

  /// Triangles that have not been sent are not drawn.
  void set_cancel_flag(const std::atomic<bool>* flag) override { cancel_ = flag; }
  [[nodiscard]] bool complete() const override { return complete_; }

  /// The picture as a texture of the context (rgba32f, linear, row 0 at the top); 0 before draw().
  [[nodiscard]] std::uint32_t texture() const { return target_.picture().texture(); }

 private:
  void check_ready() const;
  void prepare();
  void send_camera(const CameraFrame& frame, int width, int height);
  void draw_triangles();
  [[nodiscard]] bool cancelled() const;

  std::shared_ptr<gl::Context> context_;
  GpuScene scene_;
  RasterTarget target_;
  gl::Buffer camera_{"the camera"};
  std::shared_ptr<gl::Program> program_;  ///< null before init()
  bool ready_ = false;                    ///< false while the device's copies are of no use
  std::uint32_t vertex_array_ = 0;
  scene::Bounds bounds_;  ///< of the triangles as last sent
  std::uint64_t bounds_version_ = 0;
  const std::atomic<bool>* cancel_ = nullptr;
  bool complete_ = true;
  gl::Timer timer_;
  Transfer transfer_;
  std::optional<double> draw_s_;
};

}  // namespace encore::renderer
