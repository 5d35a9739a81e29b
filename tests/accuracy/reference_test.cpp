// The truth that configurations are held to.
#include "app/accuracy/reference.h"

#include "app/accuracy/configuration_tracers.h"
#include "scene/sample_scenes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <memory>
#include <optional>

namespace encore::app {
namespace {

class AccuracyReferenceTest : public testing::Test {
 protected:
  AccuracyReferenceTest() {
    plan_.scene = std::make_shared<const scene::Scene>(*scene::make_sample_scene("mirrors"));
    plan_.size = {48, 40};
    plan_.samples = 64;
    plan_.threads = 1;
    plan_.rays.shadows = true;
  }
  WorkloadSpec spec(int samples, accel::IntersectionMode mode) const {
    WorkloadSpec spec;
    spec.scene = plan_.scene;
    spec.structure = accel::default_spec(accel::StructureKind::kd_sah);
    spec.structure.intersection = mode;
    spec.test = TestKind::fixed;
    spec.size = plan_.size;
    spec.threads = 1;
    spec.rays = plan_.rays;
    spec.rays.samples = samples;
    return spec;
  }
  AccuracyReference::Plan plan_;
  std::atomic<bool> stop_{false};
};

TEST_F(AccuracyReferenceTest, ErrorsFallWithSamplesAndPreciseHitsAreRight) {
  double told = 0.0;
  const AccuracyReference reference(plan_, stop_, [&](double share) {
    EXPECT_GT(share, told);
    told = share;
  });
  ASSERT_TRUE(reference.complete());
  EXPECT_EQ(told, 1.0);
  ConfigurationTracers tracers(*plan_.scene, reference.triangles(), standard_tools(), stop_);
  double last = std::numeric_limits<double>::infinity();
  for (const int samples : {1, 4, 16}) {
    const auto errors =
        reference.errors_of(tracers.ready(spec(samples, accel::IntersectionMode::precise)));
    ASSERT_TRUE(errors.has_value());
    EXPECT_EQ(errors->hits.rays, 48U * 40U);
    EXPECT_EQ(errors->hits.wrong(), 0U);
    EXPECT_EQ(errors->hits.largest_t, 0.0);
    EXPECT_LT(errors->rmse, last) << samples;
    EXPECT_GT(errors->rmse, 0.0) << "the reference's samples lie elsewhere";
    last = errors->rmse;
  }
  ASSERT_TRUE(reference.own_error().has_value());
  EXPECT_LT(*reference.own_error(), last);
}

TEST_F(AccuracyReferenceTest, TheModesTakeTurnsOnOneStructure) {
  const AccuracyReference reference(plan_, stop_, [](double) {});
  ConfigurationTracers tracers(*plan_.scene, reference.triangles(), standard_tools(), stop_);
  const auto errors = [&](accel::IntersectionMode mode) {
    return reference.errors_of(tracers.ready(spec(1, mode))).value();
  };
  const PictureErrors first = errors(accel::IntersectionMode::precise);
  const PictureErrors rounded = errors(accel::IntersectionMode::moller_trumbore);
  ASSERT_TRUE(rounded.hits.largest_t.has_value());
  EXPECT_GT(*rounded.hits.largest_t, 0.0) << "single precision is not exact";
  const PictureErrors again = errors(accel::IntersectionMode::precise);
  EXPECT_EQ(again.hits.wrong(), 0U);
  EXPECT_EQ(again.hits.largest_t, 0.0);
  EXPECT_EQ(again.rmse, first.rmse);
}

TEST_F(AccuracyReferenceTest, FarFromTheOriginMollerTrumboreErrsAndThatIsCounted) {
  scene::Scene far = *scene::make_sample_scene("mirrors");
  // Wide angles and a far eye: distances of which single precision knows few digits.
  far.camera.eye = far.camera.target + (far.camera.eye - far.camera.target) * 3000.0F;
  far.camera.vertical_fov_degrees = 0.03F;
  plan_.scene = std::make_shared<const scene::Scene>(far);
  plan_.samples = 2;
  const AccuracyReference reference(plan_, stop_, [](double) {});
  ConfigurationTracers tracers(*plan_.scene, reference.triangles(), standard_tools(), stop_);
  const auto errors =
      reference.errors_of(tracers.ready(spec(1, accel::IntersectionMode::moller_trumbore)));
  ASSERT_TRUE(errors.has_value());
  EXPECT_GT(errors->hits.wrong(), 0U);
  const auto exact = reference.errors_of(tracers.ready(spec(1, accel::IntersectionMode::precise)));
  EXPECT_EQ(exact->hits.wrong(), 0U);
}

TEST_F(AccuracyReferenceTest, AnotherCameraSeesOtherHits) {
  plan_.samples = 2;
  const AccuracyReference own(plan_, stop_, [](double) {});
  plan_.camera = plan_.scene->camera;
  const AccuracyReference same(plan_, stop_, [](double) {});
  EXPECT_EQ(own.image().pixels, same.image().pixels);
  plan_.camera->eye += glm::vec3(0.5F);
  const AccuracyReference moved(plan_, stop_, [](double) {});
  EXPECT_NE(own.image().pixels, moved.image().pixels);
}

TEST_F(AccuracyReferenceTest, AStoppedOneIsNotComplete) {
  const AccuracyReference reference(plan_, stop_, [&](double share) { stop_ = share >= 0.25; });
  EXPECT_FALSE(reference.complete());
  ConfigurationTracers tracers(*plan_.scene, reference.triangles(), standard_tools(), stop_);
  EXPECT_FALSE(
      reference.errors_of(tracers.ready(spec(1, accel::IntersectionMode::precise))).has_value());
}

}  // namespace
}  // namespace encore::app
