#pragma once

#include "accel/auto_policy.h"
#include "app/workloads.h"
#include "renderer/renderer.h"

namespace encore::app {

/// What the tests have in common that need a renderer: it, and what its device did.
class FrameWorkload : public SceneWorkload {
 public:
  /// Throws std::logic_error if the tools make no tracer for a device that traces rays.
  FrameWorkload(WorkloadSpec spec, const WorkloadTools& tools);

  void operation(energy::PhaseLog& log) final;
  void begin_measuring() override { totals_ = {}; }

 protected:
  /// One operation.
  virtual void frame(energy::PhaseLog& log) = 0;

  [[nodiscard]] RayFigures ray_figures() const override;
  [[nodiscard]] DeviceFigures device_figures() const override;
  [[nodiscard]] accel::HitComparison compare(const accel::AccelerationStructure& truth,
                                             std::span<const scene::Ray> rays) const override;
  [[nodiscard]] std::string traced_name() const override;

  /// Makes the renderer ready for triangles and structure as they stand.
  void init_renderer();
  void render(energy::PhaseLog& log);
  /// Sends what changed to a device that works on copies, marked as transfer; the CPU only looks
  /// anew at what it draws from, unmarked.
  void send(energy::PhaseLog& log);
  void build_marked(energy::PhaseLog& log);
  void update_marked(energy::PhaseLog& log);

  /// Who fits the structure to triangles that moved, where the policy wants it fitted.
  enum class Fitting {
    none,    ///< nobody: it is built instead, or left alone
    host,    ///< the CPU, before it is sent; under Policy::automatic always, to see how it decays
    device,  ///< the device fits its own copy, after the triangles were sent; the host's stays
  };
  /// Of use after init_renderer().
  [[nodiscard]] Fitting fitting() const;
  /// Whether the device builds its own tree whenever the policy wants one built, after the
  /// triangles were sent; the host's structure stays as it was. Of use after init_renderer().
  [[nodiscard]] bool built_on_device() const override;
  /// Sends, and builds on the device where it builds; unmarked.
  void resend_unmarked();
  [[nodiscard]] bool transfers() const { return renderer_->transfers(); }
  /// Fits what is traced to the triangles, of which only the places may have changed; unmarked.
  void fit_unmarked();

 private:
  void count_rays();

  /// Work of the device, summed up over operations.
  struct Totals {
    double operations = 0.0;
    double uploaded_bytes = 0.0;
    double converted_bytes = 0.0;
    std::uint64_t transfers = 0;
    std::uint64_t draws = 0;
    double transfer_s = 0.0;
    double render_s = 0.0;
    std::array<double, scene::kRayKinds> rays{};
    std::array<double, scene::kRayKinds> ray_s{};
    bool transfers_timed = true;
    bool rays_known = true;  ///< of every draw, by kind
    bool rays_timed = true;
    bool draws_timed = true;
  };

  std::unique_ptr<renderer::Renderer> renderer_;
  renderer::Tracer* tracer_ = nullptr;  ///< the same, if it traces rays on a device of its own
  bool counting_ = false;               ///< an operation goes on
  Totals totals_;
};

/// A loop of updates of the device's own copy of the structure, or of its own builds, though
/// nothing changed.
class DeviceUpdateWorkload final : public FrameWorkload {
 public:
  using FrameWorkload::FrameWorkload;
  /// Throws std::runtime_error if the device can neither build nor fit this structure.
  void prepare() override;

 protected:
  void frame(energy::PhaseLog& log) override;
  [[nodiscard]] RayFigures ray_figures() const override { return {}; }
};

/// Builds once, then draws the same frame again and again. Nothing is sent meanwhile.
class StaticWorkload final : public FrameWorkload {
 public:
  using FrameWorkload::FrameWorkload;
  void prepare() override;

 protected:
  void frame(energy::PhaseLog& log) override { render(log); }
};

/// Plays the animation frame by frame at a fixed step, so that every run, however fast the machine,
/// sees the same frames: 1/30 s, or the frame rate of a scene that only shows frame sequences. The
/// structure is built, updated or left alone as the policy says (accel::decide), and left alone
/// whatever the policy when no triangle changed. Policy::automatic learns from the times of the
/// phases of each frame; sending counts as part of the build or update that made it necessary. To a
/// device with copies, what changed is sent after a build or an update on the host; where the
/// device updates its own copy, the triangles are sent before.
class DynamicWorkload final : public FrameWorkload {
 public:
  DynamicWorkload(WorkloadSpec spec, const WorkloadTools& tools);
  void prepare() override;
  [[nodiscard]] std::vector<energy::Phase> separable() const override;
  /// On the CPU `animate` is followed by what the policy makes of it, so that the structure stays
  /// true. A device draws from copies, which stay true to an earlier time; there it is `transfer`
  /// that comes with everything before and after it, so that it really has something to send.
  void run_alone(energy::Phase phase, energy::PhaseLog& log) override;
  void begin_measuring() override;

  /// What a second of each phase costs Policy::automatic from now on: watts, above idle, where they
  /// are known, so that it weighs joules; all 1 (the start) weighs seconds. What was learned in
  /// another unit is forgotten; prepare() measures the build anew.
  void set_phase_weights(const energy::PerPhase<double>& weights);
  /// Of the measured operations; nothing under other policies.
  [[nodiscard]] std::optional<accel::AutoFigures> auto_figures() const;

 protected:
  /// Throws std::runtime_error if the triangle count changes under Policy::fixed.
  void frame(energy::PhaseLog& log) override;
  [[nodiscard]] bool host_structure_is_stale() const override {
    return fitting() == Fitting::device;
  }
  /// What the rebuilds of the measured operations were worth when they were decided on (median), or
  /// where there was none, what one now would be.
  [[nodiscard]] std::optional<double> break_even_frames() const override;

 private:
  void animate(energy::PhaseLog& log);
  /// Does what the changes since the last time call for.
  void follow(energy::PhaseLog& log);
  void build_noted(energy::PhaseLog& log);
  [[nodiscard]] double time_of(std::uint64_t frame) const;
  /// What the policy makes of a change, without doing it.
  [[nodiscard]] accel::UpdateAction reaction(scene::TriangleChange change) const;
  /// Back to the first frame; returns the seconds that the build took.
  double start();
  /// The same, sends it, and tells the policy what the build and sending it cost.
  void start_timed();
  /// Tells the policy what the phases cost that ended since the log held `before`.
  void learn(const energy::PhaseLog& log, std::size_t before);
  void check_later_frame();

  double step_s_;
  accel::AutoPolicy auto_;
  energy::PerPhase<double> weights_{};
  std::uint64_t frame_ = 0;
  std::size_t built_over_ = 0;  ///< triangles that the structure was last built over
  /// What changed since the structure last followed.
  scene::TriangleChange pending_ = scene::TriangleChange::none;
};

/// Nothing moves, but the structure is built or updated every frame all the same: the thesis'
/// dynamic test (section 5.3), which keeps the cost of moving triangles out. To a device with
/// copies only what changed is sent: the structure that was built, and nothing where the device
/// updates its own.
class ForcedWorkload final : public FrameWorkload {
 public:
  using FrameWorkload::FrameWorkload;
  void prepare() override;
  [[nodiscard]] std::vector<energy::Phase> separable() const override;
  void run_alone(energy::Phase phase, energy::PhaseLog& log) override;

 protected:
  void frame(energy::PhaseLog& log) override;

 private:
  void follow(energy::PhaseLog& log);
};

/// Seconds from one frame of the dynamic test to the next.
double frame_step_s(const scene::Scene& scene);

/// Whether the scene has a frame sequence whose frames differ in their number of triangles.
bool changes_triangle_count(const scene::Scene& scene);

}  // namespace encore::app
