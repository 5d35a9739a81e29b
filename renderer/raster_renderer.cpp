#include "renderer/raster_renderer.h"

#include "renderer/camera_rays.h"
#include "renderer/gl/error.h"
#include "renderer/raster_state.h"
#include "renderer/raster_view.h"
#include "renderer/trace_defines.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/gpu_types.h"

#include <epoxy/gl.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace encore::renderer {

namespace {

constexpr GLuint kCorner = 0;         ///< the vertex attribute
constexpr GLsizei kCornerBytes = 16;  ///< from one corner of gpu::Triangle to the next

// Large scenes go to the device in several calls, so that none keeps it busy for long; few enough
// that the calls cost nothing.
constexpr std::uint32_t kTrianglesPerDraw = 1U << 18U;

/// Where shaders/raster.vert and raster.frag have their uniforms.
enum Uniform : GLint {
  eye,
  scale,
  clip_x,
  clip_y,
  forward,
  near_plane,
  right,
  up,
  center,
  orthographic
};

void set_uniform(Uniform place, const glm::vec3& value) {
  glUniform3fv(place, 1, glm::value_ptr(value));
}

std::shared_ptr<gl::Context> with_clip_control(std::shared_ptr<gl::Context> context) {
  const gl::Capabilities& found = context->capabilities();
  if (!found.clip_control) {
    throw gl::GlError("drawing without rays needs OpenGL 4.5 or GL_ARB_clip_control; " +
                      found.device_name() + " has OpenGL " + found.version +
                      " without it; use --device cpu or gpu");
  }
  return context;
}

}  // namespace

RasterRenderer::RasterRenderer(std::shared_ptr<gl::Context> context)
    : context_(with_clip_control(gl::made_current(std::move(context)))),
      scene_(context_, /*with_structure=*/false),
      timer_(context_->capabilities().timestamp_bits) {}

RasterRenderer::~RasterRenderer() {
  try {
    context_->make_current();  // the members' memory is this context's
  } catch (const gl::GlError&) {
    return;  // it went with the context
  }
  if (vertex_array_ != 0) glDeleteVertexArrays(1, &vertex_array_);
}

void RasterRenderer::init(const RenderInput& input) {
  program_.reset();
  ready_ = false;
  transfer_ = scene_.upload_all({input.scene, input.triangles, nullptr});
  prepare();
}

void RasterRenderer::refresh() {
  if (!program_) throw std::logic_error("the rasteriser was not given a scene");
  ready_ = false;
  transfer_ = scene_.upload_changes();
  prepare();
}

void RasterRenderer::draw(const scene::Camera& camera, int width, int height) {
  static const std::string doing = "drawing the picture";  // allocated once
  check_ready();
  const CameraFrame frame = make_camera_frame(camera, width, height);
  context_->make_current();
  target_.resize(width, height, context_->capabilities().texture_size);
  timer_.begin();
  {
    const RasterState state(width, height);
    target_.bind();
    RasterTarget::clear(scene_.input().scene->background);
    program_->use();
    send_camera(frame, width, height);
    scene_.bind();
    draw_triangles();
  }
  timer_.end();
  gl::finish(doing);
  complete_ = !cancelled();
  draw_s_ = timer_.seconds();
  context_->check(doing);
}

void RasterRenderer::read(Image& image) {
  if (texture() == 0) throw std::logic_error("nothing has been drawn yet");
  context_->make_current();
  target_.picture().read(image);
}

std::string RasterRenderer::device_name() const {
  return context_->capabilities().device_name();
}

bool RasterRenderer::cancelled() const {
  return cancel_ != nullptr && cancel_->load(std::memory_order_relaxed);
}

void RasterRenderer::check_ready() const {
  if (!program_) throw std::logic_error("the rasteriser was not given a scene");
  if (!ready_) throw std::logic_error("the last refresh of the rasteriser failed");
}

void RasterRenderer::prepare() {
  const scene::TriangleList& list = *scene_.input().triangles;
  if (!program_ || bounds_version_ != list.version) {
    bounds_ = list.bounds();
    bounds_version_ = list.version;
  }
  std::vector<std::string> defines;
  add_shading_defines(scene_.shading(), scene_.light_count() > 0, defines);
  program_ = context_->programs().graphics("raster.vert", "raster.frag", std::move(defines));
  ready_ = true;
}

void RasterRenderer::send_camera(const CameraFrame& frame, int width, int height) {
  // What shading asks of the tracers' camera; rays in double precision are not made here.
  gpu::CameraParameters parameters{};
  parameters.light_count = scene_.light_count();
  parameters.material_count = scene_.material_count();
  camera_.reserve(sizeof parameters, sizeof parameters);
  camera_.write(std::as_bytes(std::span(&parameters, 1)));
  camera_.bind_uniform(ENCORE_BINDING_CAMERA);

  const RasterView view = make_raster_view(frame, width, height, bounds_);
  set_uniform(eye, view.eye);
  glUniform1f(scale, view.scale);
  set_uniform(clip_x, view.clip_x);
  set_uniform(clip_y, view.clip_y);
  set_uniform(forward, view.forward);
  glUniform1f(near_plane, view.near_plane);
  glUniform1i(orthographic, view.orthographic ? 1 : 0);
  // Where the rays run, from pixel to pixel; orthographic ones all run along the view.
  const double turning = view.orthographic ? 0.0 : 1.0;
  set_uniform(right, glm::vec3(turning * frame.right));
  set_uniform(up, glm::vec3(turning * frame.up));
  glUniform2f(center, static_cast<float>(frame.center_x), static_cast<float>(frame.center_y));
}

void RasterRenderer::draw_triangles() {
  if (scene_.triangle_count() == 0) return;
  if (vertex_array_ == 0) glGenVertexArrays(1, &vertex_array_);
  glBindVertexArray(vertex_array_);
  glEnableVertexAttribArray(kCorner);
  glVertexAttribFormat(kCorner, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexAttribBinding(kCorner, 0);
  // The buffer is another one after it had to grow.
  glBindVertexBuffer(0, scene_.triangles().id(), 0, kCornerBytes);
  const std::uint32_t all = scene_.triangle_count();
  for (std::uint32_t first = 0; first < all && !cancelled(); first += kTrianglesPerDraw) {
    if (first > 0) glFlush();
    const std::uint32_t count = std::min(kTrianglesPerDraw, all - first);
    glDrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * first), static_cast<GLsizei>(3 * count));
  }
}

}  // namespace encore::renderer
