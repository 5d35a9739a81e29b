// What is left out is put in and measured, feature by feature, and told in table and JSON.
#include "app/needs_report.h"
#include "scene/sample_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace {

using namespace encore;
using app::FeatureCost;

const FeatureCost* find(const app::NeedsCost& cost, const std::string& feature) {
  const auto at = std::find_if(cost.features.begin(), cost.features.end(),
                               [&](const FeatureCost& one) { return one.feature == feature; });
  return at == cost.features.end() ? nullptr : &*at;
}

/// One triangle, plain: no normals, no colours, no highlights.
scene::Scene plain_scene() {
  scene::Scene scene = scene::make_sample_scene("triangle").value();
  for (scene::Material& material : scene.materials) material.specular = glm::vec3(0.0F);
  if (scene.lights.empty()) scene.lights.emplace_back();
  return scene;
}

std::optional<app::NeedsCost> measure(const scene::Scene& scene, bool stopped = false) {
  const std::atomic<bool> stop{stopped};
  return app::measure_needs_cost({.scene = &scene, .rays = {}, .size = {32, 24}, .threads = 1},
                                 stop);
}

TEST(NeedsCost, HasAFigureForEachFeatureThatIsLeftOut) {
  const auto cost = measure(plain_scene());
  ASSERT_TRUE(cost);
  EXPECT_EQ(cost->size.width, 32);
  EXPECT_EQ(cost->size.height, 24);
  EXPECT_GT(cost->frame_ms, 0.0);
  for (const char* feature : {"shading normals", "vertex colours", "texture coordinates",
                              "highlights", "reflected rays", "refracted rays", "counting"}) {
    ASSERT_NE(find(*cost, feature), nullptr) << feature;
    EXPECT_TRUE(find(*cost, feature)->same_picture) << feature;
  }
  for (const char* feature : {"shadow rays", "sample places"}) {
    ASSERT_NE(find(*cost, feature), nullptr) << feature;
    EXPECT_FALSE(find(*cost, feature)->same_picture) << feature;
    EXPECT_GT(find(*cost, feature)->worker_bytes.value_or(0), 0U) << feature;
  }
  for (const FeatureCost& one : cost->features) {
    EXPECT_LE(one.low_ms, one.ms) << one.feature;
    EXPECT_LE(one.ms, one.high_ms) << one.feature;
  }
}

TEST(NeedsCost, WhatASceneUsesIsNotPutIn) {
  const scene::Scene mirrors = scene::make_sample_scene("mirrors").value();
  const auto cost = measure(mirrors);
  ASSERT_TRUE(cost);
  EXPECT_EQ(find(*cost, "texture coordinates"), nullptr);
  // Its mirrors are switched off: with them the picture is another one.
  ASSERT_NE(find(*cost, "reflected rays"), nullptr);
  EXPECT_FALSE(find(*cost, "reflected rays")->same_picture);
}

TEST(NeedsCost, WithoutLightNothingIsShaded) {
  scene::Scene dark = plain_scene();
  dark.lights.clear();
  const auto cost = measure(dark);
  ASSERT_TRUE(cost);
  EXPECT_EQ(find(*cost, "shading normals"), nullptr);
  EXPECT_EQ(find(*cost, "shadow rays"), nullptr);
  EXPECT_NE(find(*cost, "sample places"), nullptr);
}

TEST(NeedsCost, ThereIsNoneWithoutTrianglesOrWhenStopped) {
  EXPECT_FALSE(measure(scene::Scene{}));
  EXPECT_FALSE(measure(plain_scene(), true));
}

TEST(NeedsCost, NoiseIsWhereRoundsDisagree) {
  EXPECT_TRUE((FeatureCost{"a", true, 0.1, -0.1, 0.2}).below_noise());
  EXPECT_FALSE((FeatureCost{"a", true, 0.1, 0.05, 0.2}).below_noise());
  EXPECT_FALSE((FeatureCost{"a", true, -0.1, -0.2, -0.05}).below_noise());
}

std::vector<app::SceneLeftOut> two_features() {
  app::SceneLeftOut scene;
  scene.scene = "a \"scene\"";
  scene.features = {{"shading normals", "no mesh has any", 4096, 2048},
                    {"shadow rays", "switched off", {}, {}},
                    {"counting", "no heat map is drawn", {}, {}}};
  scene.cost.emplace();
  scene.cost->size = {64, 48};
  scene.cost->features = {{"shading normals", true, 0.25, 0.125, 0.5},
                          {"shadow rays", false, 3.0, 2.0, 4.0, 1024},
                          {"counting", true, 0.1, -0.1, 0.2}};
  return {scene};
}

TEST(LeftOutReport, TellsBytesMillisecondsAndWhy) {
  const std::string text = app::left_out_text(two_features());
  for (const char* part :
       {"Left out\n", "shading normals", "2.0 KiB", "4.0 KiB", "0.250 (0.125 to 0.500)",
        "no mesh has any", "3.000 (2.000 to 4.000) *", "below noise", "64x48", "1.0 KiB"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  }
  EXPECT_EQ(app::left_out_text({}), "");
}

TEST(LeftOutReport, WhatWasNotMeasuredIsNullAndNotZero) {
  auto scenes = two_features();
  const std::string measured = app::left_out_json(scenes);
  EXPECT_NE(measured.find("\"ms\": 0.25, \"low_ms\": 0.125, \"high_ms\": 0.5"), std::string::npos)
      << measured;
  EXPECT_NE(measured.find("\"same_picture\": false"), std::string::npos);
  EXPECT_NE(measured.find("a \\\"scene\\\""), std::string::npos);
  scenes[0].cost.reset();
  const std::string json = app::left_out_json(scenes);
  EXPECT_NE(json.find("\"frame_ms\": null"), std::string::npos);
  EXPECT_NE(json.find("\"ms\": null"), std::string::npos);
  EXPECT_EQ(json.find("\"ms\": 0"), std::string::npos);
  EXPECT_EQ(app::left_out_json({}), "[]");
}

TEST(LeftOutReport, IsOfScenesThatAreDrawn) {
  const auto scene = std::make_shared<const scene::Scene>(plain_scene());
  app::WorkloadSpec spec;
  spec.scene = scene;
  spec.size = {16, 16};
  spec.threads = 1;
  const std::atomic<bool> stop{false};
  EXPECT_TRUE(app::scenes_left_out({spec}, stop).empty());
  app::WorkloadSpec still = spec;
  still.test = app::TestKind::fixed;
  app::WorkloadSpec device = still;
  device.device = app::Device::gpu;
  const auto found = app::scenes_left_out({spec, device, still}, stop);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].cost);
  const auto has = [&](const char* feature) {
    return std::any_of(found[0].features.begin(), found[0].features.end(),
                       [&](const scene::LeftOut& one) { return one.feature == feature; });
  };
  EXPECT_TRUE(has("animation"));
  EXPECT_FALSE(has("device copies"));
  EXPECT_FALSE(app::scenes_left_out({device}, stop)[0].cost);
}

}  // namespace
