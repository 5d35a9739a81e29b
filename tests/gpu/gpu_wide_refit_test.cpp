// A refit of bvh-sah on the device leaves the boxes that the CPU's does.
#include "accel/test_rays.h"
#include "accel/wide/wide_bvh.h"
#include "tests/bvh/moved_triangles.h"
#include "tests/gpu/gpu_scenes.h"

#include <algorithm>
#include <span>

namespace encore::renderer::test {
namespace {

using accel::BuildPreset;
using accel::StructureKind;
using accel::WideBvh;
using accel::test::moved;
using accel::test::Triangles;

constexpr BuildPreset kPresets[] = {BuildPreset::fast, BuildPreset::balanced, BuildPreset::best};

accel::StructureSpec wide_spec(BuildPreset preset = BuildPreset::balanced) {
  return {.kind = StructureKind::bvh_sah, .settings = accel::BvhSettings{.preset = preset}};
}

const WideBvh& wide_of(const GpuTestScene& setup) {
  return dynamic_cast<const WideBvh&>(*setup.structure);
}

/// Zeros of either sign are the same end of a box.
bool same_node(const gpu::WideNode& a, const gpu::WideNode& b) {
  return std::equal(std::begin(a.bounds), std::end(a.bounds), std::begin(b.bounds)) &&
         std::equal(std::begin(a.child), std::end(a.child), std::begin(b.child));
}

class GpuWideRefitTest : public encore::test::GlTest {
 protected:
  /// Refits on both sides, from copies of the same nodes, and expects the same boxes.
  void expect_cpu_nodes(BuildPreset preset, const Triangles& start,
                        const std::vector<Triangles>& frames) {
    const auto setup = scene_of(start, wide_spec(preset));
    GpuScene device(context_, true);
    device.upload_all(setup->input());
    GpuWideRefit refit(context_, wide_of(*setup));
    WideBvh host({.preset = preset}, accel::MemoryMode::pool);
    host.build(setup->list.triangles);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      SCOPED_TRACE(i);
      setup->move_to(frames[i]);
      EXPECT_EQ(device.upload_changes().uploaded_bytes, frames[i].size() * sizeof(scene::Triangle));
      refit.run(*device.nodes(), *device.references(), device.triangles());
      host.update(frames[i]);
      const auto expected = host.tree().nodes.span();
      std::vector<gpu::WideNode> found(expected.size());
      device.nodes()->read(std::as_writable_bytes(std::span(found)));
      std::size_t wrong = 0;
      for (std::size_t n = 0; n < found.size(); ++n) {
        if (same_node(found[n], expected[n]) || ++wrong > 3) continue;
        ADD_FAILURE() << "node " << n << " of " << found.size();
      }
      EXPECT_EQ(wrong, 0U) << accel::to_string(preset);
    }
  }
};

TEST_F(GpuWideRefitTest, LeavesTheBoxesOfTheCpuOfEveryPreset) {
  const Triangles start = accel::test::soup(2000, 1.0F, 30);
  const std::vector<Triangles> frames = {
      moved(start, 0.1F, 31),
      moved(start, 5.0F, 32),
      accel::test::scaled(start, 4.0F),
      accel::test::scaled(start, -0.0F),  // all zeros, of both signs
      start,
      start,  // nothing differs
  };
  for (const BuildPreset preset : kPresets) expect_cpu_nodes(preset, start, frames);
}

TEST_F(GpuWideRefitTest, LeavesTheBoxesOfTheCpuOnHostileScenes) {
  for (const auto& [name, triangles] : accel::test::all_test_scenes()) {
    if (triangles.empty()) continue;
    SCOPED_TRACE(name);
    const float size = triangles[0].v1.x - triangles[0].v0.x;
    expect_cpu_nodes(BuildPreset::best, triangles, {moved(triangles, size, 3), triangles});
  }
}

TEST_F(GpuWideRefitTest, DenormalCoordinatesAreNotFlushed) {
  const Triangles start = accel::test::scaled(accel::test::soup(300, 1.0F, 33), 0x1p-130F);
  expect_cpu_nodes(BuildPreset::fast, start, {moved(start, 0x1p-131F, 34)});
}

TEST_F(GpuWideRefitTest, WhenOnlyOneTriangleMovesItsBoxesFollow) {
  const Triangles start = accel::test::soup(700, 1.0F, 40);
  expect_cpu_nodes(BuildPreset::balanced, start, accel::test::one_moved_each(start));
}

TEST_F(GpuWideRefitTest, FollowedByTracingGivesTheHitsOfARefitOnTheCpu) {
  for (const BuildPreset preset : kPresets) {
    const auto setup = sample_scene("toys", wide_spec(preset));
    GpuTracer tracer(context_);
    tracer.init(setup->input());
    ASSERT_TRUE(tracer.can_refit());
    WideBvh host({.preset = preset}, accel::MemoryMode::pool);
    host.build(setup->list.triangles);
    const auto expect_hits = [&](std::string_view what) {
      host.update(setup->list.triangles);
      for (const accel::RayKind kind : {accel::RayKind::inside, accel::RayKind::edge}) {
        const auto rays = accel::test_rays(kind, 1000, 8, setup->list.triangles, host);
        expect_structure_hits(tracer, host, rays, std::string(what));
      }
    };
    for (const double time_s : {0.2, 0.9}) {
      const std::uint64_t version = setup->structure->version();
      scene::update_triangles(setup->scene, time_s, setup->list);
      tracer.refresh();
      tracer.refit();
      EXPECT_EQ(setup->structure->version(), version) << "the host's structure is not touched";
      expect_hits(accel::to_string(preset));
    }
    // A build on the host replaces what was fitted, and can be fitted again.
    setup->structure->build(setup->list.triangles);
    tracer.refresh();
    EXPECT_EQ(tracer.last_transfer().uploaded_bytes, wide_of(*setup).tree().nodes.bytes().size() +
                                                         wide_of(*setup).tree().ids.bytes().size());
    scene::update_triangles(setup->scene, 0.3, setup->list);
    tracer.refresh();
    tracer.refit();
    expect_hits("after a build");
  }
}

TEST_F(GpuWideRefitTest, OfNothingAndOfOneTriangle) {
  for (const std::size_t count : {0U, 1U, 2U}) {
    const auto setup = scene_of(accel::test::soup(count, 1.0F, 2), wide_spec());
    GpuTracer tracer(context_);
    tracer.init(setup->input());
    setup->move_to(accel::test::soup(count, 1.0F, 3));
    tracer.refresh();
    tracer.refit();
    if (count == 0) continue;
    setup->structure->update(setup->list.triangles);
    const auto rays =
        accel::test_rays(accel::RayKind::outside, 500, 1, setup->list.triangles, *setup->structure);
    expect_structure_hits(tracer, *setup->structure, rays, std::to_string(count));
  }
}

TEST_F(GpuWideRefitTest, IsRefusedWhereItCannotBeRight) {
  const auto setup = scene_of(accel::test::soup(9, 1.0F, 2), wide_spec());
  GpuTracer tracer(context_);
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
