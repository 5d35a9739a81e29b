#pragma once

#include "accel/brute_force.h"
#include "app/workloads.h"
#include "renderer/gl/error.h"

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace encore::app {

/// What the fake structures of one test did.
struct StructureCounts {
  int made = 0;
  int builds = 0;
  int updates = 0;
};

/// Brute force that counts what is done to it, and may be told to lie.
class FakeStructure final : public accel::AccelerationStructure {
 public:
  FakeStructure(StructureCounts& counts, bool can_refit) : counts_(counts), refits_(can_refit) {
    ++counts_.made;
  }

  [[nodiscard]] std::string_view name() const override { return "fake"; }
  void build(std::span<const scene::Triangle> triangles) override {
    ++counts_.builds;
    mark_changed();
    brute_.build(triangles);
  }
  void update(std::span<const scene::Triangle> triangles) override {
    ++counts_.updates;
    mark_changed();
    updated_ = true;
    brute_.build(triangles);
  }
  [[nodiscard]] bool can_refit() const override { return refits_; }
  void intersect(std::span<const scene::Ray> rays, std::span<scene::Hit> hits) const override {
    brute_.intersect(rays, hits);
    if (!lies_ && !(lies_after_update_ && updated_)) return;
    for (scene::Hit& hit : hits) {
      if (hit.found()) hit.t *= 2.0F;
    }
  }
  void intersect_counted(std::span<const scene::Ray> rays, std::span<scene::Hit> hits,
                         std::span<accel::TraceCounters> counters) const override {
    brute_.intersect_counted(rays, hits, counters);
  }
  void occluded(std::span<const scene::Ray> rays, std::span<std::uint8_t> blocked) const override {
    brute_.occluded(rays, blocked);
  }
  [[nodiscard]] accel::BuildStats stats() const override { return brute_.stats(); }
  [[nodiscard]] accel::GpuBuffers gpu_buffers() const override { return {}; }
  void visit(const std::function<bool(const accel::NodeView&)>& visitor) const override {
    brute_.visit(visitor);
  }

  void lie() { lies_ = true; }
  void lie_after_update() { lies_after_update_ = true; }

 private:
  accel::BruteForce brute_;
  StructureCounts& counts_;
  bool refits_;
  bool lies_ = false;
  bool lies_after_update_ = false;
  bool updated_ = false;
};

/// A renderer that draws nothing but sees how often it was asked.
class FakeRenderer final : public renderer::Renderer {
 public:
  explicit FakeRenderer(int& frames) : frames_(frames) {}
  void init(const renderer::RenderInput& input) override { input_ = input; }
  void refresh() override {}
  void draw(const scene::Camera&, int, int) override {
    if (input_.structure != nullptr) ++frames_;
  }
  void read(renderer::Image&) override {}

 private:
  renderer::RenderInput input_;
  int& frames_;
};

/// What the fake devices of one test are to do, and did.
struct DeviceScript {
  bool can_refit = true;
  bool can_build = false;
  bool clock = true;              ///< it has one, by which everything takes 2 ms
  bool lie = false;               ///< its hits are wrong
  bool lie_after_refit = false;   ///< those after a refit are
  bool out_of_memory = false;     ///< init() fails
  std::vector<std::string> done;  ///< "init", "refresh 1000", "refit", "build", "draw"
  int read = 0;                   ///< pictures fetched
};

/// A device with copies of its own: 100 bytes for the triangles and 1000 for a structure. Its hits
/// are those of the triangles that the copy of the structure was made for or fitted to, so whoever
/// forgets to send or to fit something gets wrong ones.
class FakeDevice final : public renderer::Tracer {
 public:
  explicit FakeDevice(DeviceScript& script) : script_(script) {}

  void init(const renderer::RenderInput& input) override {
    if (script_.out_of_memory) throw renderer::gl::GlError("the nodes do not fit");
    input_ = input;
    versions_.reset();
    send("init");
  }
  void refresh() override { send("refresh"); }
  void draw(const scene::Camera&, int, int) override { script_.done.emplace_back("draw"); }
  void read(renderer::Image&) override { ++script_.read; }
  [[nodiscard]] bool transfers() const override { return true; }
  [[nodiscard]] renderer::Transfer last_transfer() const override {
    return {sent_ / 10, sent_, seconds()};
  }
  [[nodiscard]] std::optional<double> last_draw_s() const override { return seconds(); }
  [[nodiscard]] std::string device_name() const override { return "fake board"; }

  [[nodiscard]] bool can_refit() const override { return script_.can_refit; }
  void refit() override {
    if (!script_.can_refit) throw std::logic_error("this device cannot refit");
    script_.done.emplace_back("refit");
    refitted_ = true;
    traced_ = triangles_;
  }

  [[nodiscard]] bool can_build() const override { return script_.can_build; }
  void build() override {
    if (!script_.can_build) throw std::logic_error("this device cannot build");
    script_.done.emplace_back("build");
    traced_ = triangles_;
  }

  void trace_hits(const scene::Camera&, int width, int height,
                  std::vector<scene::Hit>& hits) override {
    // As many hits as pixels in a row: no other count of the tests is like it.
    hits.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), {});
    for (int x = 0; x < width; ++x) hits[static_cast<std::size_t>(x)].triangle = 0;
  }
  void trace_counters(const scene::Camera&, int, int, std::vector<accel::TraceCounters>&) override {
  }
  void trace_rays(std::span<const scene::Ray> rays, std::span<scene::Hit> hits) override {
    accel::BruteForce brute;
    brute.build(traced_);
    brute.intersect(rays, hits);
    if (!script_.lie && !(script_.lie_after_refit && refitted_)) return;
    for (scene::Hit& hit : hits) {
      if (hit.found()) hit.t *= 2.0F;
    }
  }

 private:
  struct Versions {
    std::uint64_t triangles = 0;
    std::uint64_t structure = 0;
  };
  [[nodiscard]] std::optional<double> seconds() const {
    return script_.clock ? std::optional(0.002) : std::nullopt;
  }
  void send(const std::string& what) {
    const Versions now{input_.triangles->version,
                       input_.structure != nullptr ? input_.structure->version() : 0};
    sent_ = 0;
    if (!versions_ || versions_->triangles != now.triangles) {
      sent_ += 100;
      triangles_ = input_.triangles->triangles;
    }
    if (input_.structure != nullptr && (!versions_ || versions_->structure != now.structure)) {
      sent_ += 1000;
      traced_ = triangles_;
    }
    versions_ = now;
    script_.done.push_back(what + " " + std::to_string(sent_));
  }

  DeviceScript& script_;
  renderer::RenderInput input_;
  std::optional<Versions> versions_;
  std::vector<scene::Triangle> triangles_;
  std::vector<scene::Triangle> traced_;
  std::uint64_t sent_ = 0;
  bool refitted_ = false;
};

/// Tools that make the fakes, and what those did.
struct FakeTools {
  StructureCounts counts;
  int frames = 0;
  bool can_refit = true;
  bool lie = false;
  bool lie_after_update = false;
  DeviceScript device;
  bool opengl = true;  ///< there is a graphics device
  bool software = true;
  int opened = 0;  ///< how often it was opened

  WorkloadTools tools() {
    return {[this](const accel::StructureSpec&) {
              auto structure = std::make_unique<FakeStructure>(counts, can_refit);
              if (lie) structure->lie();
              if (lie_after_update) structure->lie_after_update();
              return structure;
            },
            [this](Device where, int) -> std::unique_ptr<renderer::Renderer> {
              if (where == Device::cpu) return std::make_unique<FakeRenderer>(frames);
              return std::make_unique<FakeDevice>(device);
            },
            [this]() -> GpuInfo {
              ++opened;
              if (!opengl)
                throw renderer::gl::GlUnavailable("there is no OpenGL here:\n  nothing was found");
              return {"fake board, software, runs on the CPU", "4.5 fake", software};
            }};
  }
};

/// Two triangles before the camera; `motion` moves them.
inline std::shared_ptr<scene::Model> two_triangles(std::size_t count = 2) {
  auto model = std::make_shared<scene::Model>();
  model->mesh.positions = {{-8, -8, 0}, {8, -8, 0}, {8, 8, 1}, {-8, 8, 1}};
  model->mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  model->mesh.triangles.resize(count);
  model->materials.resize(1);
  return model;
}

inline std::shared_ptr<const scene::Scene> small_scene(scene::Motion motion = {}) {
  auto scene = std::make_shared<scene::Scene>();
  scene->name = "small";
  scene->materials.resize(1);
  scene->lights.resize(1);
  scene::Instance instance;
  instance.model = two_triangles();
  instance.motion = std::move(motion);
  scene->instances.push_back(std::move(instance));
  return scene;
}

/// A motion whose triangles are elsewhere every frame.
inline scene::Motion moving() {
  scene::RigidMotion motion;
  motion.keys = {{0.0F, {}}, {2.0F, {}}};
  motion.keys[1].pose.translation = {3, 1, 0};
  return motion;
}

/// A motion that takes two seconds and goes nowhere.
inline scene::Motion resting() {
  scene::RigidMotion motion;
  motion.keys = {{0.0F, {}}, {2.0F, {}}};
  return motion;
}

}  // namespace encore::app
