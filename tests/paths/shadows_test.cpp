#include "accel/make_structure.h"
#include "accel/settings.h"
#include "renderer/paths/scatter.h"
#include "tests/paths/paths_support.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using namespace encore;
using renderer::Image;
using renderer::test::picture_with;
using renderer::test::pixel;
using renderer::test::TestScene;

TEST(Shadows, AnOccluderDarkensExactlyThePixelsThatProjectionSays) {
  // A square of half width 0.5 at half height under a light at (0, 0, 2) throws a shadow of half
  // width 1 on the ground z = 0, which is seen from straight below the light, past the square.
  TestScene setup;
  setup.scene.camera = {.eye = {3, 0, 4}, .target = {3, 0, 0}, .orthographic_height = 8.0F};
  setup.scene.materials.resize(1);
  setup.scene.lights = {{.position = {0, 0, 2}, .color = glm::vec3(1.0F)}};
  renderer::test::add_square(setup.list, 20.0F, 0.0F);
  renderer::test::add_square(setup.list, 0.5F, 1.0F);
  const Image lit = picture_with(setup, {}, 64, 64);
  const Image shadowed = picture_with(setup, {.shadows = true}, 64, 64);
  int dark = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double across = 3.0 + (x + 0.5 - 32.0) / 8.0;
      const double up = (32.0 - y - 0.5) / 8.0;
      const double reach = std::max(std::abs(across), std::abs(up));
      if (reach > 0.5 && reach < 1.0) {
        ++dark;
        ASSERT_EQ(pixel(shadowed, x, y), glm::vec3(renderer::kAmbientLight * 0.1F));
      } else {
        ASSERT_EQ(pixel(shadowed, x, y), pixel(lit, x, y)) << x << ", " << y;
      }
    }
  }
  EXPECT_GT(dark, 100);
}

TEST(Shadows, TheirLightsOwnLampDoesNotHideIt) {
  TestScene setup;
  setup.scene.camera = {.eye = {1, 0, 4}};
  setup.scene.materials.resize(1);
  setup.scene.lights = {{.position = {0, 0, 2}, .color = glm::vec3(1.0F)}};
  renderer::test::add_square(setup.list, 20.0F, 0.0F);
  const Image lit = picture_with(setup, {}, 32, 32);
  renderer::test::add_square(setup.list, 0.001F, 2.0F);  // the light lies in it
  const Image lamp = picture_with(setup, {.shadows = true}, 32, 32);
  EXPECT_TRUE(renderer::test::same_bits(lit, lamp));
}

/// How many pixels of a convex sphere of flat triangles face the light, and how many of those have
/// something in its way. Scaled first, then moved.
struct Facing {
  int lit = 0;
  int blocked = 0;
};

Facing sphere_in_light(double scale, const glm::dvec3& offset) {
  TestScene setup;
  renderer::test::add_sphere(setup.list, 24);
  const auto place = [&](const glm::vec3& p) { return glm::vec3(glm::dvec3(p) * scale + offset); };
  for (scene::Triangle& t : setup.list.triangles) {
    t.v0 = place(t.v0);
    t.v1 = place(t.v1);
    t.v2 = place(t.v2);
  }
  const glm::vec3 light = place({5, 4, 6});
  const auto structure =
      accel::make_structure(accel::default_spec(accel::StructureKind::bvh_median));
  structure->build(setup.list.triangles);
  const renderer::CameraFrame frame = renderer::make_camera_frame(
      {.eye = place({0.3F, 0.2F, 3}), .target = place({0, 0, 0}), .vertical_fov_degrees = 50.0F},
      96, 96);
  const renderer::PixelRect all{0, 0, 96, 96};
  std::vector<scene::Ray> rays(all.count());
  std::vector<scene::Hit> hits(all.count());
  renderer::camera_rays(frame, all, rays);
  structure->intersect(rays, hits);
  Facing facing;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].found()) continue;
    const auto ray = renderer::shadow_ray(
        renderer::surface_point(rays[i], hits[i], setup.list.triangles[hits[i].triangle],
                                &setup.list.normals[hits[i].triangle]),
        light);
    if (!ray) continue;
    std::uint8_t blocked = 0;
    structure->occluded({&*ray, 1}, {&blocked, 1});
    ++facing.lit;
    facing.blocked += blocked;
  }
  return facing;
}

TEST(Shadows, AConvexSphereNeverHidesFromItself) {
  const Facing usual = sphere_in_light(1.0, glm::dvec3(0.0));
  EXPECT_GT(usual.lit, 1000);
  EXPECT_EQ(usual.blocked, 0);
  for (const double scale : {1e-18, 1e-9, 1e9, 1e18}) {
    const Facing facing = sphere_in_light(scale, glm::dvec3(0.0));
    EXPECT_NEAR(facing.lit, usual.lit, 20) << scale;
    EXPECT_EQ(facing.blocked, 0) << scale;
  }
  for (const glm::dvec3& way : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 1, 1), glm::dvec3(0, -1, 0)}) {
    for (const double times : {1e3, 1e6}) {
      const Facing facing = sphere_in_light(1.0, way * times);
      EXPECT_GT(facing.lit, 500) << times;
      EXPECT_EQ(facing.blocked, 0) << times;
    }
  }
}

TEST(Shadows, GlassHidesALight) {
  TestScene setup;
  setup.scene.camera = {.eye = {0, 0, 1}};
  setup.scene.materials = {scene::Material{}, renderer::test::glass(1.0F)};
  setup.scene.lights = {{.position = {0, 0, 4}}};
  renderer::test::add_square(setup.list, 20.0F, 0.0F, 0);
  renderer::test::add_square(setup.list, 20.0F, 2.0F, 1);
  const Image image = picture_with(setup, {.shadows = true, .refractions = true}, 4, 4);
  for (const glm::vec3& seen : image.pixels) {
    EXPECT_EQ(seen, glm::vec3(renderer::kAmbientLight * 0.1F));
  }
}

}  // namespace
