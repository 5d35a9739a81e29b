#pragma once

#include "accel/brute_force.h"
#include "app/workloads.h"

#include <memory>

namespace encore::app {

/// What the fake structures of one test did.
struct StructureCounts {
  int builds = 0;
  int updates = 0;
};

/// Brute force that counts what is done to it, and may be told to lie.
class FakeStructure final : public accel::AccelerationStructure {
 public:
  FakeStructure(StructureCounts& counts, bool can_refit) : counts_(counts), refits_(can_refit) {}

  [[nodiscard]] std::string_view name() const override { return "fake"; }
  void build(std::span<const scene::Triangle> triangles) override {
    ++counts_.builds;
    brute_.build(triangles);
  }
  void update(std::span<const scene::Triangle> triangles) override {
    ++counts_.updates;
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

/// Tools that make the fakes, and what those did.
struct FakeTools {
  StructureCounts counts;
  int frames = 0;
  bool can_refit = true;
  bool lie = false;
  bool lie_after_update = false;

  WorkloadTools tools() {
    return {[this](const accel::StructureSpec&) {
              auto structure = std::make_unique<FakeStructure>(counts, can_refit);
              if (lie) structure->lie();
              if (lie_after_update) structure->lie_after_update();
              return structure;
            },
            [this](int) { return std::make_unique<FakeRenderer>(frames); }};
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
