// What cannot be done is said in a line, and nothing is drawn from half of a scene.
#include "accel/brute_force.h"
#include "tests/bvh/test_scenes.h"
#include "tests/gpu/gpu_scenes.h"
#include "tests/gpu/small_device.h"
#include "tests/support/messages.h"

#include <stdexcept>

namespace encore::renderer::test {
namespace {

using accel::StructureKind;
using encore::test::contains;

/// The message of the exception of this kind that `action` throws.
template <class Exception, class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

using GpuErrors = encore::test::GlTest;

TEST_F(GpuErrors, MissingInputIsNamed) {
  GpuTracer tracer(context_);
  EXPECT_THROW(tracer.init({}), std::invalid_argument);
  const auto setup = scene_of({}, spec_of(StructureKind::bvh_median));
  EXPECT_THROW(tracer.init({nullptr, &setup->list, setup->structure.get()}), std::invalid_argument);
  EXPECT_THROW(tracer.init({&setup->scene, nullptr, setup->structure.get()}),
               std::invalid_argument);
  EXPECT_THROW(tracer.init({&setup->scene, &setup->list, nullptr}), std::invalid_argument);
  EXPECT_THROW(GpuTracer(nullptr), std::invalid_argument);
  EXPECT_THROW(GpuScene(context_, true).upload_all({&setup->scene, &setup->list, nullptr}),
               std::invalid_argument);
}

TEST_F(GpuErrors, ASceneWithoutAStructureIsEnoughWhereNothingIsTraced) {
  const auto setup = sample_scene("wheel", spec_of(StructureKind::brute));
  GpuScene device(context_, false);
  EXPECT_THROW(device.upload_changes(), std::logic_error);
  EXPECT_GT(device.upload_all({&setup->scene, &setup->list, nullptr}).uploaded_bytes,
            setup->list.triangles.size() * sizeof(scene::Triangle));
  EXPECT_EQ(device.upload_changes().uploaded_bytes, 0U);
  EXPECT_EQ(device.nodes(), nullptr);
}

TEST_F(GpuErrors, BruteForceHasNoTraversal) {
  const auto setup = scene_of(accel::test::soup(5, 1.0F, 1), spec_of(StructureKind::brute));
  GpuTracer tracer(context_);
  const std::string message =
      message_of<std::invalid_argument>([&] { tracer.init(setup->input()); });
  EXPECT_EQ(message, "structure brute has no GPU traversal; use --device cpu or another structure");
}

TEST_F(GpuErrors, NothingWorksBeforeInit) {
  GpuTracer tracer(context_);
  Image image;
  std::vector<scene::Hit> hits(1);
  std::vector<accel::TraceCounters> counters;
  const std::vector<scene::Ray> rays(1);
  EXPECT_THROW(tracer.refresh(), std::logic_error);
  EXPECT_THROW(tracer.draw({}, 8, 8), std::logic_error);
  EXPECT_THROW(tracer.read(image), std::logic_error);
  EXPECT_THROW(tracer.trace_hits({}, 8, 8, hits), std::logic_error);
  EXPECT_THROW(tracer.trace_counters({}, 8, 8, counters), std::logic_error);
  EXPECT_THROW(tracer.trace_rays(rays, hits), std::logic_error);
}

TEST_F(GpuErrors, WrongCamerasAndSizesAreRefusedAsOnTheCpu) {
  const auto setup = scene_of(accel::test::soup(5, 1.0F, 1), spec_of(StructureKind::bvh_median));
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  std::vector<scene::Hit> hits;
  EXPECT_THROW(tracer.draw({.eye = glm::vec3(0.0F)}, 8, 8), std::invalid_argument);
  EXPECT_THROW(tracer.draw({}, 0, 8), std::invalid_argument);
  EXPECT_THROW(tracer.trace_hits({}, 8, -1, hits), std::invalid_argument);
  const std::vector<scene::Ray> rays(2);
  std::vector<scene::Hit> one(1);
  EXPECT_THROW(tracer.trace_rays(rays, one), std::invalid_argument);
  EXPECT_TRUE(contains(message_of<gl::GlError>([&] { tracer.trace_hits({}, 1 << 30, 8, hits); }),
                       "1073741824 x 8"));
  EXPECT_TRUE(hits.empty());
  EXPECT_THROW(tracer.draw_samples({}, 8, 8, 0, 2), std::invalid_argument);
  EXPECT_THROW(tracer.draw_samples({}, 8, 8, 1, 1), std::invalid_argument);
  EXPECT_THROW(tracer.draw_samples({}, 8, 8, 0, 0), std::invalid_argument);
  EXPECT_NO_THROW(tracer.draw_samples({}, 8, 8, 0, 1));
}

TEST_F(GpuErrors, APictureLargerThanTheDeviceAllowsIsRefused) {
  const auto setup = scene_of(accel::test::soup(5, 1.0F, 1), spec_of(StructureKind::bvh_median));
  GpuTracer tracer(std::make_shared<SmallDevice>(context_, 1U << 20));
  tracer.init(setup->input());
  const std::string message = message_of<gl::GlError>([&] { tracer.draw({}, 65, 8); });
  EXPECT_TRUE(contains(message, "65 x 8")) << message;
  EXPECT_TRUE(contains(message, "64 x 64")) << message;
  EXPECT_NO_THROW(tracer.draw({}, 64, 64));
}

TEST_F(GpuErrors, ADeviceWithSmallBuffersDrawsTheSamePicture) {
  // Software devices keep a slot of such a buffer for every ray: here for parts of a row.
  const auto setup = scene_of(accel::test::soup(60, 5.0F, 1), spec_of(StructureKind::bvh_median));
  Image expected;
  Image found;
  for (Image* image : {&expected, &found}) {
    GpuTracer tracer(image == &expected ? context_ : std::make_shared<SmallDevice>(context_, 5000));
    tracer.init(setup->input());
    tracer.draw(setup->scene.camera, 61, 64);
    tracer.read(*image);
  }
  EXPECT_EQ(std::memcmp(found.pixels.data(), expected.pixels.data(),
                        expected.pixels.size() * sizeof(glm::vec3)),
            0);
  EXPECT_NE(found.pixels, std::vector<glm::vec3>(found.pixels.size(), found.pixels.front()));
}

TEST_F(GpuErrors, AStructureThatDoesNotFitIsNamedAndNothingIsDrawn) {
  // A hundred triangles, but two hundred nodes less one.
  const auto setup = scene_of(accel::test::soup(100, 1.0F, 1), spec_of(StructureKind::bvh_median));
  const auto device = std::make_shared<SmallDevice>(context_, 5000);
  GpuTracer tracer(device);
  const std::string message = message_of<gl::GlError>([&] { tracer.init(setup->input()); });
  EXPECT_TRUE(contains(message, "the nodes of bvh-median")) << message;
  EXPECT_THROW(tracer.draw({}, 8, 8), std::logic_error);
  device->allow(1U << 20);
  tracer.init(setup->input());
  EXPECT_NO_THROW(tracer.draw({}, 8, 8));

  // The same while it runs: until a refresh succeeds there is nothing to draw.
  device->allow(5000);
  setup->move_to(accel::test::soup(200, 1.0F, 1));
  ++setup->list.topology_version;
  setup->structure->build(setup->list.triangles);
  EXPECT_THROW(tracer.refresh(), gl::GlError);
  EXPECT_THROW(tracer.draw({}, 8, 8), std::logic_error);
  device->allow(1U << 20);
  tracer.refresh();
  EXPECT_NO_THROW(tracer.draw({}, 8, 8));
}

TEST_F(GpuErrors, TwoTracersOnOneContextDoNotDisturbEachOther) {
  const auto first = sample_scene("wheel", spec_of(StructureKind::bvh_median));
  const auto second = scene_of(accel::test::soup(50, 3.0F, 1), spec_of(StructureKind::bvh_median));
  GpuTracer one(context_);
  GpuTracer two(context_);
  one.init(first->input());
  std::vector<scene::Hit> before;
  one.trace_hits(first->scene.camera, 24, 24, before);
  two.init(second->input());
  std::vector<scene::Hit> other;
  two.trace_hits(second->scene.camera, 24, 24, other);
  two.refit();
  std::vector<scene::Hit> after;
  one.trace_hits(first->scene.camera, 24, 24, after);
  expect_same_hits(after, before, "the first tracer");
}

TEST_F(GpuErrors, AnotherContextThatIsCurrentIsLeftForTheTracersOwn) {
  const auto setup = sample_scene("wheel", spec_of(StructureKind::bvh_median));
  std::vector<scene::Hit> before;
  std::vector<scene::Hit> after;
  {
    GpuTracer tracer(context_);
    tracer.init(setup->input());
    tracer.trace_hits(setup->scene.camera, 24, 24, before);
    const auto other = gl::make_headless_context();
    other->make_current();
    tracer.trace_hits(setup->scene.camera, 24, 24, after);
    expect_same_hits(after, before, "with another context");
    other->make_current();
  }
  context_->make_current();
}

}  // namespace
}  // namespace encore::renderer::test
