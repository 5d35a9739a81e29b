#pragma once

#include "accel/acceleration_structure.h"
#include "accel/settings.h"
#include "app/common_options.h"
#include "energy/workload.h"
#include "renderer/renderer.h"
#include "scene/scene.h"
#include "scene/triangles.h"

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace encore::app {

/// What is looped over. The thesis' three tests (section 5.1) are build, static and forced.
enum class TestKind {
  build,     ///< a loop of builds, or of updates with Policy::refit, forced though nothing changed
  fixed,     ///< "static": build once, then a loop of frames
  animated,  ///< "dynamic": animate, build or update by the policy, render, frame by frame
  forced,    ///< build or update, render, frame by frame, though nothing moves
};
std::string_view to_string(TestKind test);

/// How workloads make what they measure; tests put their own in.
struct WorkloadTools {
  std::function<std::unique_ptr<accel::AccelerationStructure>(const accel::StructureSpec&)>
      make_structure;
  std::function<std::unique_ptr<renderer::Renderer>(int threads)> make_renderer;
};
/// The program's own structures and its CPU renderer.
WorkloadTools standard_tools();

/// One configuration to measure.
struct WorkloadSpec {
  std::shared_ptr<const scene::Scene> scene;
  accel::StructureSpec structure;
  accel::Policy policy = accel::Policy::rebuild;
  TestKind test = TestKind::build;
  ImageSize size;            ///< of the tests that render
  std::string group;         ///< of the study it belongs to; empty outside studies
  std::uint32_t repeat = 1;  ///< which repeat of the same configuration this is, from 1
  int threads = 0;           ///< for rendering; 0: all
};

/// For people: "toys, bvh-median, dynamic (refit), 256x256".
std::string workload_name(const WorkloadSpec& spec);

/// What identifies a configuration, in the order of configuration_columns().
std::vector<energy::KeyValue> configuration_of(const WorkloadSpec& spec, std::size_t triangles);

/// A structure that does not return the hits of brute force. what() names scene, structure, the
/// ray and both answers.
class MismatchError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The columns of a session of these workloads, in order.
std::vector<std::string> configuration_columns();
std::vector<std::string> counter_columns();

/// What the tests have in common: a scene at a time, and a structure over its triangles.
///
/// prepare() holds the structure to brute force over a sample of rays, also after an update where
/// the test does updates, and throws MismatchError: a wrong structure is never timed.
class SceneWorkload : public energy::Workload {
 public:
  SceneWorkload(WorkloadSpec spec, const WorkloadTools& tools);

  [[nodiscard]] std::string name() const override;
  [[nodiscard]] std::vector<energy::KeyValue> configuration() const override;
  [[nodiscard]] std::vector<energy::Counter> counters(
      const energy::PerPhase<energy::Seconds>& mean) const override;

 protected:
  /// What a test that renders adds to the figures.
  struct RayFigures {
    std::optional<double> rays;  ///< camera rays an operation
    std::optional<double> hits;  ///< of the last frame
  };
  [[nodiscard]] virtual RayFigures ray_figures() const { return {}; }

  /// Brings the triangles to a time of the animation; nothing else.
  scene::TriangleChange go_to(double time_s) {
    return scene::update_triangles(*spec_.scene, time_s, triangles_);
  }
  void build() { structure_->build(triangles_.triangles); }
  void update() { structure_->update(triangles_.triangles); }
  /// Compares the structure, as it is, with brute force; `when` says after what.
  void check(std::string_view when) const;

  WorkloadSpec spec_;
  scene::TriangleList triangles_;
  std::unique_ptr<accel::AccelerationStructure> structure_;
};

/// Makes the workload of `spec.test`. The scene outlives it by shared ownership.
std::unique_ptr<SceneWorkload> make_workload(const WorkloadSpec& spec, const WorkloadTools& tools);

/// Why this test has nothing to measure for this scene and policy; empty if it has.
std::string reason_to_skip(TestKind test, accel::Policy policy, const scene::Scene& scene);

}  // namespace encore::app
