#pragma once

#include "accel/make_structure.h"
#include "accel/settings.h"
#include "renderer/cpu_tracer.h"
#include "renderer/gpu_tracer.h"
#include "scene/sample_scenes.h"
#include "scene/scene.h"
#include "scene/triangles.h"
#include "tests/support/gl_context.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace encore::renderer::test {

/// A scene, its triangles and a structure over them, as a tracer wants them.
struct GpuTestScene {
  scene::Scene scene;
  scene::TriangleList list;
  std::unique_ptr<accel::AccelerationStructure> structure;

  [[nodiscard]] RenderInput input() const { return {&scene, &list, structure.get()}; }

  /// Overwrites the triangles, which must be as many, as an animation does.
  void move_to(std::vector<scene::Triangle> triangles) {
    list.triangles = std::move(triangles);
    ++list.version;
    list.bookkeeping.instances.resize(1);
    list.bookkeeping.instances[0].count = list.triangles.size();
    list.bookkeeping.instances[0].version = list.version;
  }
};

inline accel::StructureSpec spec_of(accel::StructureKind kind) {
  return accel::default_spec(kind);
}

/// These triangles alone: no lights, no materials.
inline std::unique_ptr<GpuTestScene> scene_of(std::vector<scene::Triangle> triangles,
                                              const accel::StructureSpec& spec) {
  auto made = std::make_unique<GpuTestScene>();
  made->list.topology_version = 1;
  made->move_to(std::move(triangles));
  made->structure = accel::make_structure(spec);
  made->structure->build(made->list.triangles);
  return made;
}

/// A sample scene at a time in seconds.
inline std::unique_ptr<GpuTestScene> sample_scene(std::string_view name,
                                                  const accel::StructureSpec& spec,
                                                  double time_s = 0.0) {
  auto made = std::make_unique<GpuTestScene>();
  made->scene = scene::make_sample_scene(name).value();
  scene::update_triangles(made->scene, time_s, made->list);
  made->structure = accel::make_structure(spec);
  made->structure->build(made->list.triangles);
  return made;
}

inline std::vector<accel::StructureKind> gpu_kinds() {
  std::vector<accel::StructureKind> kinds = accel::all_structure_kinds();
  std::erase(kinds, accel::StructureKind::brute);
  return kinds;
}

/// The name of a test that runs with each kind.
inline std::string kind_name(const testing::TestParamInfo<accel::StructureKind>& test) {
  std::string name(accel::to_string(test.param));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// Expects the same bits; says of the first three that differ which they are.
inline void expect_same_hits(const std::vector<scene::Hit>& found,
                             const std::vector<scene::Hit>& expected, const std::string& what) {
  ASSERT_EQ(found.size(), expected.size()) << what;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (std::memcmp(&found[i], &expected[i], sizeof(scene::Hit)) == 0 || ++wrong > 3) continue;
    ADD_FAILURE() << what << ", ray " << i << ": expected triangle " << expected[i].triangle
                  << " at " << expected[i].t << " (" << expected[i].u << ", " << expected[i].v
                  << "), found " << found[i].triangle << " at " << found[i].t << " (" << found[i].u
                  << ", " << found[i].v << ")";
  }
  EXPECT_EQ(wrong, 0U) << what << ", of " << found.size();
}

/// Expects a tracer's hits of these rays to be those of the structure on the CPU.
inline void expect_structure_hits(GpuTracer& tracer, const accel::AccelerationStructure& structure,
                                  const std::vector<scene::Ray>& rays, const std::string& what) {
  std::vector<scene::Hit> expected(rays.size());
  std::vector<scene::Hit> found(rays.size());
  structure.intersect(rays, expected);
  tracer.trace_rays(rays, found);
  expect_same_hits(found, expected, what);
}

/// Expects a tracer's hits of the scene's camera to be those of the CPU tracer; returns them.
inline std::vector<scene::Hit> expect_camera_hits(GpuTracer& tracer, const GpuTestScene& setup,
                                                  int width, int height, const std::string& what) {
  CpuTracer cpu(1);
  cpu.init(setup.input());
  std::vector<scene::Hit> found;
  std::vector<scene::Hit> expected;
  tracer.trace_hits(setup.scene.camera, width, height, found);
  cpu.trace_hits(setup.scene.camera, width, height, expected);
  expect_same_hits(found, expected, what);
  return found;
}

}  // namespace encore::renderer::test
