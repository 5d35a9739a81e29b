// Ray settings by name, as the command line, scene files and studies give them.
#include "scene/ray_settings.h"

#include "support.h"

namespace encore::scene::test {
namespace {

TEST(RaySettings, RaysSaysOfAllFourWhetherTheyAreOn) {
  RaySettings rays;
  EXPECT_EQ(apply_ray_setting(rays, "rays", "shadows,refractions"), "");
  EXPECT_TRUE(rays.shadows && rays.refractions);
  EXPECT_FALSE(rays.reflections || rays.textures);
  EXPECT_EQ(ray_list(rays), "shadows,refractions");
  EXPECT_EQ(apply_ray_setting(rays, "rays", "all"), "");
  EXPECT_EQ(ray_list(rays), "shadows,reflections,refractions,textures");
  EXPECT_EQ(apply_ray_setting(rays, "rays", "none"), "");
  EXPECT_EQ(ray_list(rays), "none");
  EXPECT_EQ(ray_list(RaySettings{}), "textures");
}

TEST(RaySettings, WhatRayListSaysIsReadBack) {
  for (int bits = 0; bits < 16; ++bits) {
    RaySettings rays;
    rays.shadows = (bits & 1) != 0;
    rays.reflections = (bits & 2) != 0;
    rays.refractions = (bits & 4) != 0;
    rays.textures = (bits & 8) != 0;
    RaySettings read;
    EXPECT_EQ(apply_ray_setting(read, "rays", ray_list(rays)), "");
    EXPECT_EQ(read, rays);
  }
}

TEST(RaySettings, NumbersHaveTheirLimits) {
  RaySettings rays;
  EXPECT_EQ(apply_ray_setting(rays, "samples", "4096"), "");
  EXPECT_EQ(apply_ray_setting(rays, "depth", "0"), "");
  EXPECT_EQ(apply_ray_setting(rays, "seed", "4294967295"), "");
  EXPECT_EQ(rays.samples, 4096);
  EXPECT_EQ(rays.depth, 0);
  EXPECT_EQ(rays.seed, 4294967295U);
  EXPECT_EQ(apply_ray_setting(rays, "samples", "0"),
            "'0' is not a value for samples; it takes a whole number from 1 to 4096");
  EXPECT_TRUE(contains(apply_ray_setting(rays, "depth", "17"), "from 0 to 16"));
  EXPECT_TRUE(contains(apply_ray_setting(rays, "seed", "-1"), "from 0 to 4294967295"));
  for (const char* bad : {"", "4.5", "four", "4 ", "99999999999999999999"}) {
    EXPECT_NE(apply_ray_setting(rays, "samples", bad), "") << bad;
  }
  EXPECT_EQ(rays.samples, 4096);
}

TEST(RaySettings, WrongNamesAreToldWithTheNearest) {
  RaySettings rays;
  const RaySettings before = rays;
  EXPECT_EQ(apply_ray_setting(rays, "rays", "shadows,reflection"),
            "unknown rays 'reflection'; there are shadows, reflections, refractions, textures, all "
            "and none; did you mean 'reflections'?");
  for (const char* bad : {"", "shadows,", ",shadows", "all,shadows", "Shadows"}) {
    EXPECT_NE(apply_ray_setting(rays, "rays", bad), "") << bad;
  }
  EXPECT_EQ(apply_ray_setting(rays, "dept", "1"),
            "unknown setting 'dept'; there are rays, samples, depth, seed; did you mean 'depth'?");
  EXPECT_EQ(rays, before);
}

TEST(RaySettings, EveryKeyIsKnownAndEveryKindHasAName) {
  for (const std::string_view key : ray_setting_keys()) {
    RaySettings rays;
    EXPECT_EQ(apply_ray_setting(rays, key, key == "rays" ? "none" : "7"), "") << key;
    EXPECT_NE(rays, RaySettings{}) << key;
  }
  EXPECT_EQ(to_string(RayKind::camera), "camera");
  EXPECT_EQ(to_string(RayKind::refraction), "refraction");
}

}  // namespace
}  // namespace encore::scene::test
