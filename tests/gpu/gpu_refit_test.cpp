// A refit on the device leaves the very nodes that the CPU's does, in every update case.
#include "accel/bvh/bvh.h"
#include "accel/test_rays.h"
#include "tests/bvh/moved_triangles.h"
#include "tests/gpu/gpu_scenes.h"

#include <span>

namespace encore::renderer::test {
namespace {

using accel::Bvh;
using accel::StructureKind;
using accel::UpdateCase;
using accel::test::moved;
using accel::test::Triangles;

accel::StructureSpec bvh_spec(UpdateCase update_case = UpdateCase::real, std::uint64_t seed = 1) {
  return {.kind = StructureKind::bvh_median,
          .settings = accel::BvhSettings{.update_case = update_case, .seed = seed}};
}

const Bvh& bvh_of(const GpuTestScene& setup) {
  return dynamic_cast<const Bvh&>(*setup.structure);
}

class GpuRefitTest : public encore::test::GlTest {
 protected:
  /// Refits on both sides, from copies of the same nodes, and expects the same bytes.
  void expect_cpu_nodes(UpdateCase update_case, const Triangles& start,
                        const std::vector<Triangles>& frames) {
    const auto setup = scene_of(start, bvh_spec(update_case, 5));
    GpuScene device(context_, true);
    device.upload_all(setup->input());
    GpuRefit refit(context_, bvh_of(*setup));
    Bvh host(StructureKind::bvh_median, {.update_case = update_case, .seed = 5},
             accel::MemoryMode::pool);
    host.build(setup->list.triangles);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      SCOPED_TRACE(i);
      setup->move_to(frames[i]);
      EXPECT_EQ(device.upload_changes().uploaded_bytes, frames[i].size() * sizeof(scene::Triangle));
      refit.run(*device.nodes(), device.triangles());
      host.update(frames[i]);
      std::vector<gpu::BvhNode> found(host.nodes().size());
      device.nodes()->read(std::as_writable_bytes(std::span(found)));
      std::size_t wrong = 0;
      for (std::size_t n = 0; n < found.size(); ++n) {
        if (std::memcmp(&found[n], &host.nodes()[n], sizeof found[n]) == 0 || ++wrong > 3) continue;
        ADD_FAILURE() << "node " << n << " of " << found.size();
      }
      EXPECT_EQ(wrong, 0U) << accel::to_string(update_case);
    }
  }
};

TEST_F(GpuRefitTest, LeavesTheNodesOfTheCpuInEveryCase) {
  const Triangles start = accel::test::soup(2000, 1.0F, 30);
  const std::vector<Triangles> frames = {
      moved(start, 0.1F, 31),
      moved(start, 5.0F, 32),
      accel::test::scaled(start, 4.0F),
      accel::test::scaled(start, 0.125F),
      accel::test::scaled(start, -0.0F),  // all zeros, of both signs
      start,
      start,  // nothing differs
  };
  for (const UpdateCase update_case :
       {UpdateCase::real, UpdateCase::best, UpdateCase::average, UpdateCase::worst}) {
    expect_cpu_nodes(update_case, start, frames);
  }
}

TEST_F(GpuRefitTest, LeavesTheNodesOfTheCpuOnHostileScenes) {
  for (const auto& [name, triangles] : accel::test::all_test_scenes()) {
    if (triangles.empty()) continue;
    SCOPED_TRACE(name);
    const float size = triangles[0].v1.x - triangles[0].v0.x;
    expect_cpu_nodes(UpdateCase::real, triangles,
                     {moved(triangles, size, 3), accel::test::scaled(triangles, 0.5F), triangles});
  }
}

TEST_F(GpuRefitTest, DenormalCoordinatesAreNotFlushed) {
  const Triangles start = accel::test::scaled(accel::test::soup(300, 1.0F, 33), 0x1p-130F);
  expect_cpu_nodes(UpdateCase::real, start, {moved(start, 0x1p-131F, 34)});
}

TEST_F(GpuRefitTest, WhenOnlyOneTriangleMovesTheRestStays) {
  const Triangles start = accel::test::soup(700, 1.0F, 40);
  expect_cpu_nodes(UpdateCase::real, start, accel::test::one_moved_each(start));
}

TEST_F(GpuRefitTest, FollowedByTracingGivesTheHitsOfARefitOnTheCpu) {
  const auto setup = sample_scene("toys", bvh_spec());
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  ASSERT_TRUE(tracer.can_refit());
  Bvh host(StructureKind::bvh_median, {}, accel::MemoryMode::pool);
  host.build(setup->list.triangles);
  for (const double time_s : {0.2, 0.5, 0.9}) {
    const std::uint64_t version = setup->structure->version();
    scene::update_triangles(setup->scene, time_s, setup->list);
    tracer.refresh();
    tracer.refit();
    EXPECT_EQ(setup->structure->version(), version) << "the host's structure is not touched";
    host.update(setup->list.triangles);
    for (const accel::RayKind kind : {accel::RayKind::inside, accel::RayKind::edge}) {
      const auto rays = accel::test_rays(kind, 1500, 8, setup->list.triangles, host);
      expect_structure_hits(tracer, host, rays, std::string(accel::to_string(kind)));
    }
  }
  // A build on the host replaces what was fitted, and can be fitted again.
  setup->structure->build(setup->list.triangles);
  tracer.refresh();
  EXPECT_EQ(tracer.last_transfer().uploaded_bytes, bvh_of(*setup).nodes().size_bytes());
  scene::update_triangles(setup->scene, 0.3, setup->list);
  tracer.refresh();
  tracer.refit();
  const auto rays =
      accel::test_rays(accel::RayKind::inside, 1500, 8, setup->list.triangles, *setup->structure);
  host.update(setup->list.triangles);
  expect_structure_hits(tracer, host, rays, "after a build");
}

TEST_F(GpuRefitTest, OfNothingAndOfOneTriangle) {
  for (const std::size_t count : {0U, 1U, 2U}) {
    const auto setup = scene_of(accel::test::soup(count, 1.0F, 2), bvh_spec());
    GpuTracer tracer(context_);
    tracer.init(setup->input());
    setup->move_to(accel::test::soup(count, 2.0F, 3));
    tracer.refresh();
    tracer.refit();
    setup->structure->update(setup->list.triangles);
    if (count == 0) continue;
    const auto rays =
        accel::test_rays(accel::RayKind::outside, 500, 1, setup->list.triangles, *setup->structure);
    expect_structure_hits(tracer, *setup->structure, rays, std::to_string(count));
  }
}

TEST_F(GpuRefitTest, IsRefusedWhereItCannotBeRight) {
  GpuTracer tracer(context_);
  EXPECT_FALSE(tracer.can_refit());
  EXPECT_THROW(tracer.refit(), std::logic_error);
  const auto grid = scene_of(accel::test::soup(9, 1.0F, 2), spec_of(StructureKind::grid_box));
  tracer.init(grid->input());
  EXPECT_FALSE(tracer.can_refit());
  EXPECT_THROW(tracer.refit(), std::logic_error);

  const auto setup = scene_of(accel::test::soup(9, 1.0F, 2), bvh_spec());
  tracer.init(setup->input());
  EXPECT_NO_THROW(tracer.refit());
  setup->structure->build(setup->list.triangles);
  EXPECT_THROW(tracer.refit(), std::logic_error) << "the device has another structure";
  tracer.refresh();
  EXPECT_NO_THROW(tracer.refit());
  setup->move_to(accel::test::soup(8, 1.0F, 2));
  ++setup->list.topology_version;
  tracer.refresh();
  EXPECT_THROW(tracer.refit(), std::logic_error) << "the structure is of nine triangles";
}

}  // namespace
}  // namespace encore::renderer::test
