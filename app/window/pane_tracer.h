#pragma once

#include "accel/acceleration_structure.h"
#include "accel/auto_policy.h"
#include "accel/build_watch.h"
#include "app/gpu_device.h"
#include "app/window/pane_request.h"
#include "app/workloads.h"
#include "energy/phase_log.h"
#include "renderer/renderer.h"
#include "scene/triangles.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// Some of a picture's samples a pixel.
struct SampleRange {
  std::uint32_t first = 0;
  std::uint32_t count = 1;
};

/// One pane's triangles, structure and renderer, brought from what they are to what is asked for by
/// the least work. Used by one thread; OpenGL is touched only by panes that draw with it.
class PaneTracer {
 public:
  /// `gl_device`: as --gl-device has it.
  explicit PaneTracer(std::optional<int> gl_device) : gpu_(gl_device) {}

  /// Animates, builds or updates, and sends, as far as `request` differs from what there is; each
  /// step is marked in `log`, whose earlier spans stay. Throws what structures and renderers throw,
  /// accel::BuildCancelled; then the part that failed is made anew the next time.
  void prepare(const PaneRequest& request, energy::PhaseLog& log, accel::BuildWatch* watch);
  /// Whether prepare() would have to build, and so may take long.
  [[nodiscard]] bool must_build(const PaneRequest& request) const;
  /// Builds or updates though nothing moved (the thesis' forced frames), and sends.
  void follow_forced(const PaneRequest& request, energy::PhaseLog& log);
  /// Draws a frame with all its samples, or only `samples` of them; marked as `render`. False if it
  /// was cancelled.
  bool draw(const scene::Camera& camera, int width, int height, energy::PhaseLog& log,
            const std::atomic<bool>* cancel, std::optional<SampleRange> samples = std::nullopt);
  /// What drawing a whole frame took; for policy automatic.
  void learn_frame(double render_s);
  /// Policy automatic: frames in which a build now would pay for itself; nothing where that is not
  /// known, or never.
  [[nodiscard]] std::optional<double> break_even_frames() const;
  /// Forgets everything; for panes that were switched off.
  void clear();

  [[nodiscard]] renderer::Renderer* renderer() { return renderer_.get(); }
  /// Null where no rays are traced.
  [[nodiscard]] renderer::Tracer* tracer() { return tracer_; }
  /// Null where there is none, or where it has not been built.
  [[nodiscard]] const accel::AccelerationStructure* structure() const;
  [[nodiscard]] const scene::TriangleList& triangles() const { return *triangles_; }
  /// As the renderer has been told.
  [[nodiscard]] const scene::RaySettings& rays() const { return rays_; }
  /// Camera rays a pixel that a whole frame has; 1 where no rays are traced.
  [[nodiscard]] int samples() const;
  /// Whether a frame is of one camera ray a pixel and no others.
  [[nodiscard]] bool plain() const;
  [[nodiscard]] const std::shared_ptr<const scene::Scene>& scene() const { return scene_; }
  /// Whether the device fitted its copy of the structure, or built one, by itself, so that the
  /// host's is of an earlier time.
  [[nodiscard]] bool fitted_on_device() const { return fitted_on_device_; }
  /// Whether the device built what is traced: the host's structure is another one.
  [[nodiscard]] bool built_on_device() const { return built_on_device_; }
  /// Grows with every build and every update of the host's structure, and every change of scene.
  [[nodiscard]] std::uint64_t structure_serial() const { return structure_serial_; }
  /// Grows with every build from scratch.
  [[nodiscard]] std::uint64_t build_serial() const { return build_serial_; }
  /// Grows whenever a picture would look different for the same camera.
  [[nodiscard]] std::uint64_t content_serial() const { return content_serial_; }
  [[nodiscard]] std::uint64_t uploaded_bytes() const { return uploaded_bytes_; }
  /// "CPU, 2 threads", or what the graphics device says of itself.
  [[nodiscard]] std::string device_text() const;
  [[nodiscard]] bool device_is_software() const { return software_; }
  [[nodiscard]] std::uint64_t memory_bytes() const;

 private:
  void use_scene(const PaneRequest& request);
  void use_structure(const PaneRequest& request);
  void use_renderer(const PaneRequest& request);
  void follow(scene::TriangleChange change, const PaneRequest& request, energy::PhaseLog& log,
              accel::BuildWatch* watch);
  void build(const PaneRequest& request, energy::PhaseLog& log, accel::BuildWatch* watch);
  void update(const PaneRequest& request, energy::PhaseLog& log);
  void send(energy::PhaseLog& log);
  void weigh(const PaneRequest& request);
  void learn(const energy::PhaseLog& log, std::size_t before);
  void build_on_host(const PaneRequest& request, energy::PhaseLog& log, accel::BuildWatch* watch);
  [[nodiscard]] bool fits_on_device(const PaneRequest& request) const;
  [[nodiscard]] bool builds_on_device(const PaneRequest& request) const;

  GpuContext gpu_;
  std::shared_ptr<const scene::Scene> scene_;
  std::unique_ptr<scene::TriangleList> triangles_ = std::make_unique<scene::TriangleList>();
  double time_s_ = 0.0;
  std::optional<accel::StructureSpec> spec_;  ///< of structure_
  std::unique_ptr<accel::AccelerationStructure> structure_;
  bool built_ = false;
  accel::AutoPolicy costs_;                        ///< of structure_: seconds times weights_
  energy::PerPhase<double> weights_{};             ///< all 1, or watts
  accel::Policy policy_ = accel::Policy::rebuild;  ///< of the last prepare()
  std::uint64_t rebuild_ = 0;                      ///< the request's, when it was built
  std::size_t built_over_ = 0;
  bool fitted_on_device_ = false;
  bool built_on_device_ = false;   ///< what is traced; then fitted_on_device_, too
  bool update_on_device_ = false;  ///< is due, once the triangles are sent
  bool build_on_device_ = false;   ///< likewise
  std::optional<Device> device_;
  int threads_ = 0;
  scene::RaySettings rays_;  ///< of renderer_
  std::unique_ptr<renderer::Renderer> renderer_;
  renderer::Tracer* tracer_ = nullptr;
  bool ready_ = false;  ///< the renderer was initialised with all of this
  bool stale_ = false;  ///< it has not been sent what changed since
  bool software_ = false;
  std::uint64_t structure_serial_ = 0;
  std::uint64_t build_serial_ = 0;
  std::uint64_t content_serial_ = 0;
  std::uint64_t uploaded_bytes_ = 0;
};

}  // namespace encore::app
