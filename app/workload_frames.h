#pragma once

#include "app/workloads.h"
#include "renderer/image.h"

namespace encore::app {

/// What the two tests that render have in common: a picture and who draws it.
class FrameWorkload : public SceneWorkload {
 public:
  FrameWorkload(WorkloadSpec spec, const WorkloadTools& tools);

 protected:
  [[nodiscard]] RayFigures ray_figures() const override;
  /// Makes the renderer ready for the structure as it stands.
  void init_renderer();
  void render(energy::PhaseLog& log);

  std::unique_ptr<renderer::Renderer> renderer_;
};

/// Builds once, then draws the same frame again and again.
class StaticWorkload final : public FrameWorkload {
 public:
  using FrameWorkload::FrameWorkload;
  void prepare() override;
  void operation(energy::PhaseLog& log) override { render(log); }
};

/// Plays the animation frame by frame at a fixed step, so that every run, however fast the machine,
/// sees the same frames: 1/30 s, or the frame rate of a scene that only shows frame sequences. The
/// structure is built, updated or left alone as the policy says, and left alone whatever the policy
/// when no triangle changed.
class DynamicWorkload final : public FrameWorkload {
 public:
  DynamicWorkload(WorkloadSpec spec, const WorkloadTools& tools);
  void prepare() override;
  /// Throws std::runtime_error if the triangle count changes under Policy::fixed.
  void operation(energy::PhaseLog& log) override;
  [[nodiscard]] std::vector<energy::Phase> separable() const override;
  /// `animate` is followed by what the policy makes of it, so that the structure stays true.
  void run_alone(energy::Phase phase, energy::PhaseLog& log) override;

 private:
  /// Brings the scene to the next frame and the structure after it.
  void advance(energy::PhaseLog& log);
  void build_marked(energy::PhaseLog& log);
  void update_marked(energy::PhaseLog& log);
  [[nodiscard]] double time_of(std::uint64_t frame) const;
  /// What the policy makes of a change, without doing it.
  enum class Reaction { nothing, build, update };
  [[nodiscard]] Reaction reaction(scene::TriangleChange change) const;
  void start();

  double step_s_;
  std::uint64_t frame_ = 0;
  std::size_t built_over_ = 0;  ///< triangles that the structure was last built over
};

/// Nothing moves, but the structure is built or updated every frame all the same: the thesis'
/// dynamic test (section 5.3), which keeps the cost of moving triangles out.
class ForcedWorkload final : public FrameWorkload {
 public:
  using FrameWorkload::FrameWorkload;
  void prepare() override;
  void operation(energy::PhaseLog& log) override;
  [[nodiscard]] std::vector<energy::Phase> separable() const override;
  void run_alone(energy::Phase phase, energy::PhaseLog& log) override;

 private:
  [[nodiscard]] bool updates() const;
  void follow(energy::PhaseLog& log);
};

/// Seconds from one frame of the dynamic test to the next.
double frame_step_s(const scene::Scene& scene);

/// Whether the scene has a frame sequence whose frames differ in their number of triangles.
bool changes_triangle_count(const scene::Scene& scene);

}  // namespace encore::app
