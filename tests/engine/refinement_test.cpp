// A picture of several samples comes part by part, and ends as the picture drawn at once.
#include "app/window/refinement.h"

#include "app/window/pane_picture.h"
#include "app/window/scene_preferences.h"
#include "energy/clock.h"
#include "renderer/image_diff.h"
#include "scene/sample_scenes.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace encore::app {
namespace {

renderer::Image plain(float value) {
  renderer::Image image;
  image.resize(2, 2);
  for (auto& pixel : image.pixels) pixel = glm::vec3(value);
  return image;
}

TEST(Refinement, DoublesFromOneSampleOn) {
  Refinement refinement;
  refinement.begin(20);
  std::vector<std::uint32_t> counts;
  while (const auto next = refinement.next()) {
    counts.push_back(next->count);
    refinement.add(plain(1.0F), *next, 0.0, std::nullopt);
  }
  EXPECT_EQ(counts, (std::vector<std::uint32_t>{1, 1, 2, 4, 8, 4}));
  EXPECT_TRUE(refinement.complete());
  EXPECT_EQ(refinement.view().samples, 20);
}

TEST(Refinement, PartsThatWouldTakeLongAreCutButMeetEachDoubling) {
  Refinement refinement;
  refinement.begin(16);
  std::vector<int> known;
  while (const auto next = refinement.next()) {
    EXPECT_LE(next->count, 2U);
    refinement.add(plain(float(next->first % 2)), *next, 0.2 * next->count, std::nullopt);
  }
  for (const ui::PictureError& error : refinement.view().errors) known.push_back(error.samples);
  EXPECT_EQ(known, (std::vector<int>{2, 4, 8, 16}));
}

TEST(Refinement, RaysOfAllPartsAreCounted) {
  Refinement refinement;
  refinement.begin(4);
  renderer::RayFigures rays;
  rays[scene::RayKind::camera] = {10, 1.0};
  rays[scene::RayKind::shadow] = {3, std::nullopt};
  while (const auto next = refinement.next()) refinement.add(plain(0.0F), *next, 0.1, rays);
  ASSERT_TRUE(refinement.rays().has_value());
  EXPECT_EQ((*refinement.rays())[scene::RayKind::camera].rays, 30U);
  EXPECT_EQ((*refinement.rays())[scene::RayKind::camera].seconds, 3.0);
  EXPECT_EQ((*refinement.rays())[scene::RayKind::shadow].seconds, std::nullopt);
}

class PicturePartsTest : public testing::Test {
 protected:
  PicturePartsTest() {
    request_.scene = std::make_shared<const scene::Scene>(*scene::make_sample_scene("mug"));
    request_.device = Device::cpu;
    request_.camera = request_.scene->camera;
    request_.width = 48;
    request_.height = 32;
    request_.threads = 1;
    request_.rays.samples = 16;
  }
  bool draw(const std::atomic<bool>* cancel = nullptr) {
    tracer_.prepare(request_, log_, nullptr);
    return picture_.trace(tracer_, request_, 1, log_, cancel);
  }
  PaneOutput output() {
    PaneOutput output;
    picture_.fill(output);
    return output;
  }
  PaneRequest request_;
  energy::SteadyClock clock_;
  energy::PhaseLog log_{clock_, 256};
  PaneTracer tracer_{std::nullopt};
  PanePicture picture_;
};

TEST_F(PicturePartsTest, ErrorFallsAndTheEndIsTheWholePicture) {
  ASSERT_TRUE(draw());
  EXPECT_FALSE(picture_.complete());
  EXPECT_FALSE(output().whole);
  EXPECT_EQ(output().refinement->samples, 1);
  while (!picture_.complete()) ASSERT_TRUE(draw());
  const PaneOutput done = output();
  EXPECT_TRUE(done.whole);
  ASSERT_EQ(done.refinement->errors.size(), 4U);
  EXPECT_GT(done.refinement->errors.front().rmse, 0.0);
  EXPECT_LT(done.refinement->errors.back().rmse, done.refinement->errors.front().rmse);
  ASSERT_TRUE(tracer_.draw(request_.camera, 48, 32, log_, nullptr));
  renderer::Image whole;
  tracer_.renderer()->read(whole);
  EXPECT_LT(renderer::compare_images(whole, *done.image).rmse, 1e-6);
}

TEST_F(PicturePartsTest, AnotherRequestBeginsAnew) {
  ASSERT_TRUE(draw());
  ASSERT_TRUE(draw());
  EXPECT_EQ(output().refinement->samples, 2);
  request_.camera.eye.x += 0.1F;
  ASSERT_TRUE(draw());
  EXPECT_EQ(output().refinement->samples, 1);
  request_.rays.seed = 7;
  ASSERT_TRUE(draw());
  EXPECT_EQ(output().refinement->samples, 1);
  request_.rays.samples = 1;
  ASSERT_TRUE(draw());
  EXPECT_TRUE(picture_.complete());
  EXPECT_FALSE(output().refinement.has_value());
}

TEST_F(PicturePartsTest, ACancelledPartLeavesWhatWasThere) {
  ASSERT_TRUE(draw());
  const auto before = output().image;
  const std::atomic<bool> cancel{true};
  EXPECT_FALSE(draw(&cancel));
  EXPECT_EQ(output().image, before);
  EXPECT_EQ(output().refinement->samples, 1);
  ASSERT_TRUE(draw());
  EXPECT_EQ(output().refinement->samples, 2);
}

TEST_F(PicturePartsTest, ACoarsePictureIsOfOneSample) {
  tracer_.prepare(request_, log_, nullptr);
  ASSERT_TRUE(picture_.trace(tracer_, request_, 4, log_, nullptr));
  EXPECT_EQ(output().image->width, 12);
  EXPECT_FALSE(output().whole);
  ASSERT_TRUE(draw());
  EXPECT_EQ(output().image->width, 48);
}

TEST_F(PicturePartsTest, AnotherIntersectionBuildsNothing) {
  ASSERT_TRUE(draw());
  const std::uint64_t builds = tracer_.build_serial();
  request_.structure.intersection = accel::IntersectionMode::watertight;
  EXPECT_FALSE(tracer_.must_build(request_));
  ASSERT_TRUE(draw());
  EXPECT_EQ(tracer_.build_serial(), builds);
  EXPECT_EQ(tracer_.structure()->intersection(), accel::IntersectionMode::watertight);
  EXPECT_EQ(output().refinement->samples, 1);
}

TEST(ScenePreferences, SetRaysAndIntersectionAndNameWhatIsWrong) {
  scene::Scene scene;
  scene.preferences = {{"rays", "shadows,reflections", "a.toml:1"},
                       {"samples", "8", "a.toml:2"},
                       {"depth", "99", "a.toml:3"},
                       {"intersection", "watertight", "a.toml:4"},
                       {"structure", "kd-sah", "a.toml:5"}};
  ui::Settings settings = ui::default_settings();
  const auto problems = apply_preferences(scene, settings);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems[0].find("a.toml:3: "), std::string::npos);
  EXPECT_TRUE(settings.rays.shadows);
  EXPECT_TRUE(settings.rays.reflections);
  EXPECT_FALSE(settings.rays.textures);
  EXPECT_EQ(settings.rays.samples, 8);
  EXPECT_EQ(settings.rays.depth, scene::RaySettings{}.depth);
  EXPECT_EQ(settings.panes[1].structure.intersection, accel::IntersectionMode::watertight);
  EXPECT_EQ(settings.panes[0].structure.kind, accel::StructureKind::bvh_median);
}

}  // namespace
}  // namespace encore::app
