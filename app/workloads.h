#pragma once

#include "accel/acceleration_structure.h"
#include "accel/build_place.h"
#include "accel/settings.h"
#include "accel/update_policy.h"
#include "accel/verify.h"
#include "app/common_options.h"
#include "app/device.h"
#include "app/gpu_device.h"
#include "energy/workload.h"
#include "renderer/renderer.h"
#include "scene/ray_settings.h"
#include "scene/scene.h"
#include "scene/triangles.h"

#include <array>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace encore::app {

/// What is looped over. The thesis' three tests (section 5.1) are build, static and forced.
enum class TestKind {
  /// A loop of builds, or of updates with Policy::refit, forced though nothing changed. On the GPU
  /// there are only its own updates, and its own builds where it builds.
  /// Policy::automatic has neither this test nor forced: nothing decays where nothing moves.
  build,
  fixed,     ///< "static": build once, then a loop of frames
  animated,  ///< "dynamic": animate, build or update by the policy, render, frame by frame
  forced,    ///< build or update, render, frame by frame, though nothing moves
};
std::string_view to_string(TestKind test);

/// How workloads make what they measure; tests put their own in.
struct WorkloadTools {
  std::function<std::unique_ptr<accel::AccelerationStructure>(const accel::StructureSpec&)>
      make_structure;
  /// `threads`: of the CPU; 0: all. For Device::gpu it is a renderer::Tracer.
  std::function<std::unique_ptr<renderer::Renderer>(Device, int threads)> make_renderer;
  /// Opens the graphics device and says what it is. Throws renderer::gl::GlUnavailable.
  std::function<GpuInfo()> open_gpu;
};
/// The program's own structures and renderers. Those that need OpenGL share `gpu`, which makes its
/// context when the first of them is made or the device is opened.
WorkloadTools standard_tools(const std::shared_ptr<GpuContext>& gpu);
/// With the best graphics device that there is.
WorkloadTools standard_tools();

/// One configuration to measure.
struct WorkloadSpec {
  std::shared_ptr<const scene::Scene> scene;
  Device device = Device::cpu;
  accel::StructureSpec structure;  ///< of no meaning where no rays are traced
  accel::Policy policy = accel::Policy::rebuild;
  TestKind test = TestKind::build;
  ImageSize size;            ///< of the tests that render
  std::string group;         ///< of the study it belongs to; empty outside studies
  std::uint32_t repeat = 1;  ///< which repeat of the same configuration this is, from 1
  int threads = 0;           ///< for rendering; 0: all
  /// Device::gpu, where the tests build frame after frame; never automatic.
  accel::BuildPlace build_on = accel::BuildPlace::cpu;
  scene::RaySettings rays;  ///< of the tests that render, where rays are traced
};

/// For people: "toys, bvh-median, gpu, dynamic (refit), 256x256"; the CPU goes without saying.
std::string workload_name(const WorkloadSpec& spec);

/// What identifies a configuration, in the order of configuration_columns().
std::vector<energy::KeyValue> configuration_of(const WorkloadSpec& spec, std::size_t triangles);

/// A structure, or a device's copy of it, that does not return the hits of brute force. what()
/// names scene, structure, device, the ray and both answers.
class MismatchError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The columns of a session of these workloads, in order.
std::vector<std::string> configuration_columns();
std::vector<std::string> counter_columns();

/// What the tests have in common: a scene at a time, and a structure over its triangles where rays
/// are traced.
///
/// prepare() holds the structure to brute force over a sample of rays, also after an update where
/// the test does updates, and throws MismatchError: a wrong structure is never timed. On the GPU it
/// is the device's own answers that are compared.
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
    std::optional<double> rays;  ///< of all kinds, an operation
    std::optional<double> hits;  ///< of the last frame's camera rays
    bool pixels = false;         ///< whether there is a picture
    /// Of each kind: rays an operation, and the share of the render phase's time that they took.
    struct Kind {
      std::optional<double> rays{};
      std::optional<double> share{};
    };
    std::array<Kind, scene::kRayKinds> kinds{};
  };
  [[nodiscard]] virtual RayFigures ray_figures() const { return {}; }
  /// Policy::automatic: frames in which a rebuild now would pay back, where that is known.
  [[nodiscard]] virtual std::optional<double> break_even_frames() const { return std::nullopt; }
  /// What a device adds that works on copies. Means over the measured operations.
  struct DeviceFigures {
    std::optional<double> uploaded_bytes;
    std::optional<double> converted_bytes;
    /// By the device's own clock. Not known: it happened, but the device has no clock.
    std::optional<double> transfer_s;
    std::optional<double> render_s;
    bool transfer_unknown = false;
    bool render_unknown = false;
  };
  [[nodiscard]] virtual DeviceFigures device_figures() const { return {}; }
  /// Whether the device fits its own copy of the structure, so that the host's is not the one that
  /// is traced any more.
  [[nodiscard]] virtual bool host_structure_is_stale() const { return false; }
  /// Whether the device builds a tree of its own, so that nothing is known of what is traced.
  [[nodiscard]] virtual bool built_on_device() const { return false; }

  /// Brings the triangles to a time of the animation; nothing else.
  scene::TriangleChange go_to(double time_s) {
    return scene::update_triangles(*spec_.scene, time_s, triangles_);
  }
  void build() { carry_out(accel::UpdateAction::build); }
  void update() { carry_out(accel::UpdateAction::update); }
  void carry_out(accel::UpdateAction action) {
    accel::carry_out(action, spec_.policy, *structure_, triangles_.triangles);
  }
  /// Compares the hits of what is traced, as it is, with brute force; `when` says after what. Does
  /// nothing where no rays are traced.
  void check(std::string_view when) const;
  /// The comparison itself, and the name of what was compared.
  [[nodiscard]] virtual accel::HitComparison compare(const accel::AccelerationStructure& truth,
                                                     std::span<const scene::Ray> rays) const;
  [[nodiscard]] virtual std::string traced_name() const;

  WorkloadSpec spec_;
  scene::TriangleList triangles_;
  std::unique_ptr<accel::AccelerationStructure> structure_;  ///< null where no rays are traced

 private:
  static void append_ray_counters(const RayFigures& rays, energy::Seconds render,
                                  std::vector<energy::Counter>& counters);
  void append_structure_counters(std::vector<energy::Counter>& counters) const;
};

/// Makes the workload of `spec.test`. The scene outlives it by shared ownership.
std::unique_ptr<SceneWorkload> make_workload(const WorkloadSpec& spec, const WorkloadTools& tools);

/// Why this test has nothing to measure for this scene, device, structure and policy; empty if it
/// has.
std::string reason_to_skip(const WorkloadSpec& spec);

}  // namespace encore::app
