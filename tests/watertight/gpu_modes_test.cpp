// The intersection modes in the shaders: the watertight hits are those of the CPU, bit for bit;
// Möller and Trumbore's are the same triangles but where rounding alone decides.
#include "accel/test_rays.h"
#include "accel/watertight_study.h"
#include "tests/gpu/gpu_scenes.h"

#include <cmath>

namespace encore::renderer::test {
namespace {

using accel::IntersectionMode;
using accel::StructureKind;

class GpuModes : public encore::test::GlTest, public testing::WithParamInterface<StructureKind> {
 protected:
  [[nodiscard]] static accel::StructureSpec spec(IntersectionMode mode) {
    accel::StructureSpec spec = spec_of(GetParam());
    spec.intersection = mode;
    return spec;
  }
};

TEST_P(GpuModes, WatertightHitsAreThoseOfTheCpu) {
  GpuTracer tracer(context_);
  // Each mesh may need a program of its own, which devices in software take seconds to compile.
  const auto cases = accel::watertight_cases();
  for (const accel::WatertightCase& mesh : {cases.at(1), cases.at(2)}) {
    const auto setup = scene_of(mesh.triangles, spec(IntersectionMode::watertight));
    tracer.init(setup->input());
    for (const accel::RayKind kind : accel::all_ray_kinds()) {
      const auto rays = accel::test_rays(kind, 150, 3, mesh.triangles, *setup->structure);
      expect_structure_hits(tracer, *setup->structure, rays,
                            mesh.name + ", " + std::string(accel::to_string(kind)));
    }
  }
}

TEST_P(GpuModes, MollerTrumboreHitsAreNearlyAllThoseOfTheCpu) {
  GpuTracer tracer(context_);
  const auto setup = sample_scene("toys", spec(IntersectionMode::moller_trumbore));
  tracer.init(setup->input());
  const auto rays =
      accel::test_rays(accel::RayKind::outside, 1000, 4, setup->list.triangles, *setup->structure);
  std::vector<scene::Hit> expected(rays.size());
  std::vector<scene::Hit> found(rays.size());
  setup->structure->intersect(rays, expected);
  tracer.trace_rays(rays, found);
  std::size_t hits = 0;
  std::size_t others = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (found[i].found()) ++hits;
    if (found[i].triangle != expected[i].triangle) {
      ++others;
    } else if (found[i].found()) {
      EXPECT_LE(std::fabs(found[i].t - expected[i].t), 1e-6F * expected[i].t);
    }
  }
  EXPECT_GT(hits, 200U);
  EXPECT_LE(others, 2U);
}

INSTANTIATE_TEST_SUITE_P(Structures, GpuModes, testing::ValuesIn(gpu_kinds()), kind_name);

}  // namespace
}  // namespace encore::renderer::test
