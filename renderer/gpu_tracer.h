#pragma once

#include "accel/settings.h"
#include "renderer/gl/context.h"
#include "renderer/gl/fence.h"
#include "renderer/gpu_build.h"
#include "renderer/gpu_paths.h"
#include "renderer/gpu_refit.h"
#include "renderer/gpu_scene.h"
#include "renderer/gpu_wide_refit.h"
#include "renderer/paced_dispatch.h"
#include "renderer/picture.h"
#include "renderer/renderer.h"
#include "renderer/trace_launch.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace encore::renderer {

/// Ray casting in OpenGL compute shaders (4.3 or later), hit for hit like the CPU: the shaders walk
/// the very nodes that the CPU walks, decide hits by the same double-precision formula
/// (shaders/triangle_hit.glsl), and have no limit on steps or depth.
///
/// What a scene or run does not use is left out of the shader by defines: other structures,
/// counters, interpolated normals, colours, textures, highlights, lights, rays from a buffer; what
/// takes more than one ray a pixel is drawn by GpuPaths, and is not there for others. Long frames
/// go to the device in pieces that each stay far below a driver's patience (see PacedDispatch).
///
/// Between the fences at the end of a refresh and of a frame the host never waits for the device,
/// but for software ones (see PausedRays).
class GpuTracer final : public Tracer {
 public:
  explicit GpuTracer(std::shared_ptr<gl::Context> context);
  ~GpuTracer() override;

  /// Sends the scene and compiles. Throws std::invalid_argument if a part of the input is missing
  /// or the structure has no GPU traversal (brute), GlError if something does not fit.
  void init(const RenderInput& input) override;
  void set_rays(const scene::RaySettings& rays) override { scene_.set_rays(rays); }
  void refresh() override;
  void draw(const scene::Camera& camera, int width, int height) override;
  void draw_samples(const scene::Camera& camera, int width, int height, std::uint32_t first,
                    std::uint32_t count) override;
  void read(Image& image) override;

  [[nodiscard]] bool transfers() const override { return true; }
  [[nodiscard]] Transfer last_transfer() const override { return transfer_; }
  [[nodiscard]] std::optional<double> last_draw_s() const override { return draw_s_; }
  /// Seconds are the device's, of one kind of ray after the other.
  [[nodiscard]] std::optional<RayFigures> last_rays() const override { return rays_drawn_; }
  [[nodiscard]] std::string device_name() const override;

  /// Bounding volume hierarchies only.
  [[nodiscard]] bool can_refit() const override;
  /// Also throws std::logic_error if the host's structure is not the one that was sent last, or has
  /// another number of triangles than the list: refresh() first, rebuild before that.
  void refit() override;

  /// The preset `fast` of bvh-sah (see GpuBuild).
  [[nodiscard]] bool can_build() const override;
  /// Also throws GlError if the tree does not fit on the device.
  void build() override;
  /// Whether rays go through what build() has built.
  [[nodiscard]] bool built() const { return built_for_.has_value(); }

  void trace_hits(const scene::Camera& camera, int width, int height,
                  std::vector<scene::Hit>& hits) override;
  void trace_counters(const scene::Camera& camera, int width, int height,
                      std::vector<accel::TraceCounters>& counters) override;
  void trace_rays(std::span<const scene::Ray> rays, std::span<scene::Hit> hits) override;

  /// The picture as a texture of the context (rgba32f, linear, row 0 at the top); 0 before draw().
  [[nodiscard]] std::uint32_t texture() const { return picture_.texture(); }
  /// Pieces that have not been sent are not drawn.
  void set_cancel_flag(const std::atomic<bool>* flag) override;
  [[nodiscard]] bool complete() const override;

 private:
  /// What a device's own tree holds for: the host's structure and the order of the triangles.
  struct BuiltFor {
    std::optional<std::uint64_t> structure_version;
    std::uint64_t topology_version = 0;
    friend bool operator==(const BuiltFor&, const BuiltFor&) = default;
  };
  [[nodiscard]] BuiltFor sent() const;

  [[nodiscard]] const accel::Bvh* hierarchy() const;
  [[nodiscard]] const accel::WideBvh* wide_hierarchy() const;
  [[nodiscard]] std::uint64_t pace_key(int height) const;
  void check_ready() const;
  void prepare_to_draw();
  void bind_scene() const;
  void fit_host_nodes();
  void send_camera(const scene::Camera& camera, int width, int height);
  void draw_plain(int width, int height);
  void trace_bands(TraceOutput output, int width, int height, std::span<std::byte> results);

  std::shared_ptr<gl::Context> context_;
  GpuScene scene_;
  TraceLaunch launch_;
  GpuPaths paths_;
  std::optional<accel::StructureKind> kind_;
  bool ready_ = false;                            ///< whether the device has what the input says
  std::uint32_t scenes_ = 0;                      ///< how many init() has seen
  std::string doing_;                             ///< for messages
  std::shared_ptr<gl::Program> picture_program_;  ///< null: paths_ draws pictures
  std::unique_ptr<GpuRefit> refit_;               ///< made when first asked for
  std::unique_ptr<GpuWideRefit> wide_refit_;      ///< made when first asked for
  std::unique_ptr<GpuBuild> build_;               ///< made when first asked for
  std::optional<BuiltFor> built_for_;             ///< empty: rays go through the host's structure
  PacedDispatch frames_;                          ///< of pictures
  PacedDispatch batches_;                         ///< of everything else
  bool complete_ = true;
  Picture picture_;
  gl::Buffer camera_{"the camera"};
  gl::Buffer rays_{"the rays"};
  gl::Buffer results_{"the results of rays"};
  gl::Timer timer_;
  Transfer transfer_;
  std::optional<double> draw_s_;
  std::optional<RayFigures> rays_drawn_;
};

}  // namespace encore::renderer
