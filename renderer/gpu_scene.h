#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/fence.h"
#include "renderer/renderer.h"
#include "renderer/shading.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace encore::renderer {

/// The device's copies of a scene: triangles, what shading needs of them, and a structure; and how
/// they are kept up to date. Only what a scene has is there, only what changed is sent: a refit
/// that the device does itself needs the triangles alone, a camera that moves nothing at all.
class GpuScene {
 public:
  /// `with_structure`: whether anything traces rays in it.
  GpuScene(std::shared_ptr<gl::Context> context, bool with_structure);

  /// Sends everything, and returns when the device has it. Throws std::invalid_argument if a part
  /// of the input is missing, GlError if something does not fit on the device.
  Transfer upload_all(const RenderInput& input);
  /// Sends what changed since: ranges of triangles with their normals, colours and texture
  /// coordinates, the structure if it was built or updated, materials and lights if the scene was
  /// edited, textures if others are worn. Sizes are those of what
  /// lies in storage buffers; parameters of a few bytes are not counted. Throws std::logic_error
  /// before upload_all().
  Transfer upload_changes();

  /// Which rays are going to be traced: what they need is sent from the next upload on.
  void set_rays(const scene::RaySettings& rays) { wanted_rays_ = rays; }

  /// Binds every buffer where the shaders look for it.
  void bind() const;
  /// What materials mirror and let through, which shares its place with others.
  void bind_bounces() const;

  [[nodiscard]] const RenderInput& input() const { return input_; }
  /// What the last upload was for: the rays, what the scene needs for them, and which features of
  /// shading its shaders must have.
  [[nodiscard]] const scene::RaySettings& rays() const { return rays_; }
  [[nodiscard]] const scene::Needs& needs() const { return needs_; }
  [[nodiscard]] const ShadingNeeds& shading() const { return shading_; }
  [[nodiscard]] std::uint32_t triangle_count() const { return triangle_count_; }
  [[nodiscard]] std::uint32_t light_count() const { return light_count_; }
  /// One more than the scene's: the last is that of triangles whose material does not exist.
  [[nodiscard]] std::uint32_t material_count() const { return material_count_; }
  [[nodiscard]] const gpu::StructureParameters& structure() const { return structure_; }
  /// For drawing without rays: one vertex every 16 bytes, three a triangle, as in gpu::Triangle.
  [[nodiscard]] const gl::Buffer& triangles() const { return triangles_; }
  /// The nodes of a tree, and which triangles its leaves refer to; null where there are none.
  [[nodiscard]] gl::Buffer* nodes();
  [[nodiscard]] gl::Buffer* references();
  /// Which version of the structure the device has; empty where there is none.
  [[nodiscard]] std::optional<std::uint64_t> structure_version() const {
    return structure_version_;
  }

 private:
  struct StructureBuffer {
    int binding;
    gl::Buffer buffer;
  };
  [[nodiscard]] bool changed() const;
  [[nodiscard]] gl::Buffer* structure_buffer(int binding);
  Transfer upload();
  void send(gl::Buffer& buffer, std::span<const std::byte> bytes, Transfer& sum);
  void send_triangles(Transfer& sum);
  void send_ranges(Transfer& sum);
  void send_structure(Transfer& sum);
  void send_materials(Transfer& sum);
  void send_textures(Transfer& sum);

  std::shared_ptr<gl::Context> context_;
  bool with_structure_;
  RenderInput input_;
  scene::RaySettings wanted_rays_;
  scene::RaySettings rays_;
  scene::Needs needs_;
  ShadingNeeds shading_;
  gpu::StructureParameters structure_{};
  std::uint32_t triangle_count_ = 0;
  std::uint32_t light_count_ = 0;
  std::uint32_t material_count_ = 0;

  gl::Buffer triangles_{"the triangles"};
  gl::Buffer normals_{"the shading normals"};
  gl::Buffer colors_{"the vertex colours"};
  gl::Buffer texcoords_{"the texture coordinates"};
  gl::Buffer materials_{"the materials"};
  gl::Buffer bounces_{"what materials mirror and let through"};
  gl::Buffer texels_{"the textures"};
  gl::Buffer lights_{"the lights"};
  gl::Buffer structure_block_{"the structure's parameters"};
  std::vector<StructureBuffer> structure_buffers_;
  gl::Timer timer_;

  // What the copies were made of; empty: there are none.
  std::vector<std::shared_ptr<const scene::Texture>> textures_;
  std::optional<std::uint64_t> scene_version_;
  std::optional<std::uint64_t> triangle_version_;
  std::optional<std::uint64_t> topology_version_;
  std::optional<std::uint64_t> structure_version_;
};

}  // namespace encore::renderer
