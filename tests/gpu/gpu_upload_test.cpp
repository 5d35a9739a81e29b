// Only what changed is sent, and what the device holds is what the host has.
#include "shaders/shared/gpu_types.h"
#include "shaders/shared/path_types.h"
#include "tests/bvh/test_scenes.h"
#include "tests/gpu/path_scenes.h"

namespace encore::renderer::test {
namespace {

using accel::StructureKind;

std::uint64_t structure_bytes(const GpuTestScene& setup) {
  std::uint64_t sum = 0;
  for (const accel::GpuBuffer& part : setup.structure->gpu_buffers()) sum += part.bytes.size();
  return sum;
}

/// Triangles with what shading needs of them.
std::uint64_t triangle_bytes(const GpuTestScene& setup, std::size_t count) {
  return count * (sizeof(gpu::Triangle) + (setup.list.normals.empty() ? 0 : 36) +
                  (setup.list.colors.empty() ? 0 : 36));
}

std::uint64_t material_bytes(const GpuTestScene& setup) {
  return (setup.scene.materials.size() + 1) * sizeof(gpu::Material) +
         setup.scene.lights.size() * sizeof(gpu::Light);
}

class GpuUploads : public encore::test::GlTest, public testing::WithParamInterface<StructureKind> {
 protected:
  /// Moves the scene on and says which triangles that changed.
  static std::size_t advance(GpuTestScene& setup, double time_s) {
    const std::uint64_t before = setup.list.version;
    EXPECT_EQ(scene::update_triangles(setup.scene, time_s, setup.list),
              scene::TriangleChange::moved);
    std::size_t count = 0;
    for (const auto& range : scene::changed_since(setup.list, before)) count += range.count;
    return count;
  }

  void expect_current_hits(GpuTracer& tracer, const GpuTestScene& setup) {
    expect_camera_hits(tracer, setup, 32, 32, "hits");
  }

  void expect_clock(const Transfer& transfer) {
    EXPECT_EQ(transfer.device_s.has_value(), context_->capabilities().timestamp_bits > 0);
    if (transfer.device_s) {
      EXPECT_GE(*transfer.device_s, 0.0);
    }
  }
};

TEST_P(GpuUploads, TheFirstOneSendsEverythingOnce) {
  for (const char* name : {"mug", "cow", "toys"}) {
    const auto setup = sample_scene(name, spec_of(GetParam()));
    GpuTracer tracer(context_);
    EXPECT_TRUE(tracer.transfers());
    tracer.init(setup->input());
    const Transfer sent = tracer.last_transfer();
    EXPECT_EQ(sent.converted_bytes, material_bytes(*setup)) << name;
    EXPECT_EQ(sent.uploaded_bytes, triangle_bytes(*setup, setup->list.triangles.size()) +
                                       structure_bytes(*setup) + material_bytes(*setup))
        << name;
    expect_clock(sent);
  }
}

TEST_P(GpuUploads, WithoutAChangeNothingIsSent) {
  const auto setup = sample_scene("toys", spec_of(GetParam()));
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  setup->scene.camera.eye *= 0.5F;
  tracer.draw(setup->scene.camera, 16, 16);
  EXPECT_EQ(scene::update_triangles(setup->scene, 0.0, setup->list), scene::TriangleChange::none);
  const std::size_t programs = context_->programs().compiled();
  tracer.refresh();
  EXPECT_EQ(tracer.last_transfer().uploaded_bytes, 0U);
  EXPECT_EQ(tracer.last_transfer().converted_bytes, 0U);
  EXPECT_EQ(context_->programs().compiled(), programs);
  expect_clock(tracer.last_transfer());
}

TEST_P(GpuUploads, MovingPartsSendTheirTrianglesAndARebuildTheStructure) {
  const auto setup = sample_scene("toys", spec_of(GetParam()));
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  for (const double time_s : {0.1, 0.35}) {
    const std::size_t moved = advance(*setup, time_s);
    EXPECT_GT(moved, 0U);
    EXPECT_LT(moved, setup->list.triangles.size());
    tracer.refresh();
    EXPECT_EQ(tracer.last_transfer().uploaded_bytes, triangle_bytes(*setup, moved));
    EXPECT_EQ(tracer.last_transfer().converted_bytes, 0U);
    setup->structure->build(setup->list.triangles);
    tracer.refresh();
    EXPECT_EQ(tracer.last_transfer().uploaded_bytes, structure_bytes(*setup));
    expect_current_hits(tracer, *setup);
  }
  const std::size_t moved = advance(*setup, 0.6);
  setup->structure->update(setup->list.triangles);
  tracer.refresh();
  EXPECT_EQ(tracer.last_transfer().uploaded_bytes,
            triangle_bytes(*setup, moved) + structure_bytes(*setup));
  expect_current_hits(tracer, *setup);
}

TEST_P(GpuUploads, AChangingNumberOfTrianglesSendsThemAll) {
  const auto setup = sample_scene("metaballs", spec_of(GetParam()));
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  for (const double share : {0.2, 0.5, 0.0}) {
    scene::update_triangles(setup->scene, share * setup->scene.duration_s(), setup->list);
    setup->structure->build(setup->list.triangles);
    tracer.refresh();
    EXPECT_EQ(tracer.last_transfer().uploaded_bytes,
              triangle_bytes(*setup, setup->list.triangles.size()) + structure_bytes(*setup));
    expect_current_hits(tracer, *setup);
  }
}

TEST_P(GpuUploads, AnEditedSceneSendsMaterialsAndLights) {
  const auto setup = sample_scene("mug", spec_of(GetParam()));
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  setup->scene.materials.resize(setup->scene.materials.size() + 3);
  setup->scene.lights.clear();
  setup->scene.mark_changed();
  tracer.refresh();
  EXPECT_EQ(tracer.last_transfer().converted_bytes, material_bytes(*setup));
  EXPECT_EQ(tracer.last_transfer().uploaded_bytes, material_bytes(*setup));

  // Without light normals are of no use, so they are not kept up to date; with it they are again.
  setup->scene.lights.resize(2);
  setup->scene.mark_changed();
  tracer.refresh();
  EXPECT_EQ(tracer.last_transfer().uploaded_bytes,
            material_bytes(*setup) + std::as_bytes(std::span(setup->list.normals)).size());
}

TEST_P(GpuUploads, FromNothingToSomethingAndBack) {
  const auto setup = scene_of({}, spec_of(GetParam()));
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  expect_current_hits(tracer, *setup);
  for (const std::size_t count : {300U, 1U, 0U, 20U}) {
    setup->move_to(accel::test::soup(count, 5.0F, 1));
    ++setup->list.topology_version;
    setup->structure->build(setup->list.triangles);
    tracer.refresh();
    expect_current_hits(tracer, *setup);
  }
}

TEST_P(GpuUploads, TexturesAndWhatRaysNeedAreSentWhenTheyAreNeeded) {
  const auto setup = scene_of(accel::test::soup(40, 5.0F, 1), spec_of(GetParam()));
  setup->scene.lights.resize(1);
  setup->scene.materials.resize(3);
  setup->scene.materials[1].reflectivity = 0.5F;
  add_textures(*setup);
  constexpr std::uint64_t kHead = (256 + 2 * 4) * sizeof(std::uint32_t);
  constexpr std::uint64_t kTexels = (7 * 5 + 1 * 3) * sizeof(std::uint32_t);
  constexpr std::uint64_t kCoordinates = std::uint64_t{40} * 3 * sizeof(glm::vec2);
  const std::uint64_t bounces = 4 * sizeof(gpu::Bounce);
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  const auto sent = [&] { return tracer.last_transfer().uploaded_bytes; };
  EXPECT_EQ(sent(), triangle_bytes(*setup, 40) + kCoordinates + structure_bytes(*setup) +
                        material_bytes(*setup) + kHead + kTexels);
  EXPECT_EQ(tracer.last_transfer().converted_bytes, material_bytes(*setup) + kHead);

  setup->list.texcoords[7][1] += glm::vec2(0.25F);
  setup->list.bookkeeping.instances[0].version = ++setup->list.version;
  tracer.refresh();
  EXPECT_EQ(sent(), triangle_bytes(*setup, 40) + kCoordinates);
  setup->scene.mark_changed();
  tracer.refresh();
  EXPECT_EQ(sent(), material_bytes(*setup)) << "the same textures are worn";
  setup->scene.materials[2].diffuse_texture = nullptr;
  setup->scene.mark_changed();
  tracer.refresh();
  EXPECT_EQ(sent(), material_bytes(*setup) + (256 + 4 + 3) * sizeof(std::uint32_t));

  tracer.set_rays({.reflections = true, .textures = false});
  tracer.refresh();
  EXPECT_EQ(sent(), material_bytes(*setup) + bounces);
  tracer.set_rays({.shadows = true, .samples = 4});
  tracer.refresh();
  EXPECT_EQ(sent(), material_bytes(*setup) + kCoordinates);
  tracer.set_rays({.samples = 9});
  tracer.refresh();
  EXPECT_EQ(sent(), 0U);
  CpuTracer cpu(1);
  cpu.set_rays({.samples = 9});
  cpu.init(setup->input());
  tracer.draw(setup->scene.camera, 32, 32);
  cpu.draw(setup->scene.camera, 32, 32);
  Image found;
  Image expected;
  tracer.read(found);
  cpu.read(expected);
  expect_within_bound(found, expected, "textures");
}

INSTANTIATE_TEST_SUITE_P(Kinds, GpuUploads, testing::ValuesIn(gpu_kinds()), kind_name);

}  // namespace
}  // namespace encore::renderer::test
