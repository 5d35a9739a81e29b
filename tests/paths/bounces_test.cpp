#include "tests/paths/paths_support.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace encore;
using renderer::Image;
using renderer::test::add_quad;
using renderer::test::glass;
using renderer::test::glowing;
using renderer::test::mirror;
using renderer::test::picture_with;
using renderer::test::pixel;
using renderer::test::TestScene;

constexpr glm::vec3 kRed{1.0F, 0.0F, 0.0F};
constexpr glm::vec3 kBlue{0.0F, 0.0F, 1.0F};

/// A mirror at z = -2 that fills the view from (0, 0, 1), and a small red triangle behind the eye.
TestScene mirror_room(glm::vec3 centre) {
  TestScene setup;
  setup.scene.camera = {.eye = {0, 0, 1}, .target = {0, 0, 0}};
  setup.scene.background = kBlue;
  setup.scene.materials = {mirror(), glowing(kRed)};
  renderer::test::add_square(setup.list, 10.0F, -2.0F, 0);
  setup.list.triangles.push_back(scene::make_triangle(centre + glm::vec3(-0.1F, -0.1F, 0),
                                                      centre + glm::vec3(0.1F, -0.1F, 0),
                                                      centre + glm::vec3(0, 0.15F, 0), 1));
  return setup;
}

TEST(Reflections, AMirrorShowsATriangleWhereItsImageIs) {
  // At (1, 0.5, 2), its mirror image is at z = -6: 7 in front of the eye, in a view of 90 degrees.
  TestScene setup = mirror_room({1.0F, 0.5F, 2.0F});
  const Image image = picture_with(setup, {.reflections = true}, 141, 141);
  int red = 0;
  for (int y = 0; y < 141; ++y) {
    for (int x = 0; x < 141; ++x) {
      const double right = (x + 0.5 - 70.5) / 70.5 * 7.0 - 1.0;
      const double up = (70.5 - y - 0.5) / 70.5 * 7.0 - 0.5;
      // Its edges: up = -0.1 and two from (-+0.1, -0.1) to (0, 0.15).
      const double inside = std::min(up + 0.1, 0.25 * (0.1 - std::abs(right)) - 0.1 * (up + 0.1));
      if (std::abs(inside) < 1e-4) continue;
      ASSERT_EQ(pixel(image, x, y), inside > 0.0 ? kRed : kBlue) << x << ", " << y;
      red += inside > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(red, 1);
}

TEST(Reflections, TheDepthLimitIsKept) {
  // Two mirrors face each other; each of them glows a little, and half of the light goes on.
  TestScene setup;
  setup.scene.camera = {.eye = {0, 0, 0}, .target = {0, 0, -1}};
  scene::Material material = glowing(glm::vec3(1.0F));
  material.reflectivity = 0.5F;
  setup.scene.materials = {material};
  renderer::test::add_square(setup.list, 100.0F, -1.0F, 0);
  renderer::test::add_square(setup.list, 100.0F, 1.0F, 0);
  for (const int depth : {0, 1, 2, 3, 8}) {
    const Image image = picture_with(setup, {.reflections = true, .depth = depth}, 3, 3);
    // With no bounce at all no mirror is needed, and its colour is Phong's alone.
    const double expected = depth == 0 ? 1.0 : 1.0 - std::pow(0.5, depth + 1);
    EXPECT_NEAR(pixel(image, 1, 1).r, expected, 1e-6) << depth;
  }
  // Beyond 2^-10 nothing is traced any more.
  const Image deep = picture_with(setup, {.reflections = true, .depth = 16}, 3, 3);
  EXPECT_NEAR(pixel(deep, 1, 1).r, 1.0 - std::pow(0.5, 11), 1e-6);
}

/// What lies behind at z = -10: red where x > 0, else blue.
void add_backdrop(TestScene& setup) {
  add_quad(setup.list, {-50, -50, -10}, {0, -50, -10}, {0, 50, -10}, {-50, 50, -10}, 1);
  add_quad(setup.list, {0, -50, -10}, {50, -50, -10}, {50, 50, -10}, {0, 50, -10}, 2);
  setup.scene.materials = {glass(1.5F), glowing(kBlue), glowing(kRed)};
}

TEST(Refractions, ASlabShiftsWhatIsBehindByTheKnownOffset) {
  // Parallel rays at 45 degrees through glass of thickness 1: along x they come out
  // 1 * (tan 45 - tan(asin(sin 45 / 1.5))) short of where they would have been.
  TestScene setup;
  add_backdrop(setup);
  renderer::test::add_box(setup.list, {-40, -40, -1}, {40, 40, 0}, 0);
  const double shift = 1.0 - std::tan(std::asin(std::sqrt(0.5) / 1.5));
  // The ray of the picture's centre meets z = -10 at x = 0 without the slab.
  setup.scene.camera = {.eye = {-20, 0, 10}, .target = {0, 0, -10}, .orthographic_height = 2.0F};
  const Image image = picture_with(setup, {.refractions = true}, 201, 201);
  // A pixel to the right moves the ray by sqrt(2) * 2 / 201 along x on the backdrop.
  const double step = std::sqrt(2.0) * 2.0 / 201.0;
  for (int x = 0; x < 201; ++x) {
    const double at = (x + 0.5 - 100.5) * step - shift;
    if (std::abs(at) < 1e-4) continue;
    const glm::vec3 seen = pixel(image, x, 100);
    EXPECT_GT(at > 0.0 ? seen.r : seen.b, 0.8F) << x;
    EXPECT_EQ(at > 0.0 ? seen.b : seen.r, 0.0F) << x;
  }
}

TEST(Refractions, GlassOfIndexOneIsAWindow) {
  TestScene setup;
  add_backdrop(setup);
  setup.scene.materials[0].index_of_refraction = 1.0F;
  setup.scene.camera = {.eye = {0.3F, 0.2F, 8.0F}};
  const Image without = picture_with(setup, {}, 32, 32);
  renderer::test::add_box(setup.list, {-1, -1, -1}, {1, 1, 0}, 0);
  setup.list.normals.clear();
  const Image with = picture_with(setup, {.reflections = true, .refractions = true}, 32, 32);
  EXPECT_TRUE(renderer::test::same_bits(without, with));
}

TEST(Refractions, APrismTurnsLightByTotalReflection) {
  // A right-angled prism: rays along -z enter the front squarely, are mirrored by the slanted face
  // (45 degrees are beyond asin(1 / 1.5) = 41.8) and leave upwards.
  TestScene setup;
  setup.scene.materials = {glass(1.5F), glowing(kRed), glowing(kBlue)};
  const auto at = [](float x, int corner) {
    return corner == 0   ? glm::vec3(x, -1, 1)
           : corner == 1 ? glm::vec3(x, 1, 1)
                         : glm::vec3(x, 1, -1);
  };
  const float w = 1.0F;
  add_quad(setup.list, at(-w, 0), at(w, 0), at(w, 1), at(-w, 1), 0);  // front
  add_quad(setup.list, at(-w, 1), at(w, 1), at(w, 2), at(-w, 2), 0);  // top
  add_quad(setup.list, at(-w, 2), at(w, 2), at(w, 0), at(-w, 0), 0);  // slanted, faces away
  setup.list.triangles.push_back(scene::make_triangle(at(w, 0), at(w, 2), at(w, 1), 0));
  setup.list.triangles.push_back(scene::make_triangle(at(-w, 0), at(-w, 1), at(-w, 2), 0));
  add_quad(setup.list, {-9, 5, 9}, {9, 5, 9}, {9, 5, -9}, {-9, 5, -9}, 1);      // above: red
  add_quad(setup.list, {-9, -9, -5}, {9, -9, -5}, {9, 9, -5}, {-9, 9, -5}, 2);  // behind: blue
  setup.scene.camera = {
      .eye = {0.1F, 0.1F, 4}, .target = {0.1F, 0.1F, 0}, .orthographic_height = 0.5F};
  const Image image = picture_with(setup, {.refractions = true}, 5, 5);
  for (const glm::vec3& seen : image.pixels) {
    EXPECT_NEAR(seen.r, 0.96 * 0.96, 1e-3);
    EXPECT_EQ(seen.b, 0.0F);
  }
}

TEST(Refractions, FullyClearGlassShowsNothingOfItself) {
  TestScene setup;
  setup.scene.background = glm::vec3(1.0F);
  setup.scene.materials = {glass(1.3F)};
  setup.scene.camera = {.eye = {0, 0, 3}, .vertical_fov_degrees = 60.0F};
  renderer::test::add_sphere(setup.list, 16, 0);
  // In a furnace of ones light is only lost at the depth limit and where rays hardly count.
  const Image image = picture_with(
      setup, {.reflections = true, .refractions = true, .depth = scene::kMostDepth}, 48, 48);
  for (const glm::vec3& seen : image.pixels) {
    EXPECT_GT(seen.g, 0.97F);
    EXPECT_LT(seen.g, 1.0001F);
  }
}

TEST(Bounces, SizeOfTheSceneDoesNotMatter) {
  const auto usual = renderer::test::everything();
  const Image expected = picture_with(*usual, renderer::test::kEverything, 48, 36);
  for (const float scale : {0x1p-60F, 0x1p60F}) {
    const auto setup = renderer::test::everything();
    for (scene::Triangle& t : setup->list.triangles) {
      t.v0 *= scale;
      t.v1 *= scale;
      t.v2 *= scale;
    }
    for (scene::Light& light : setup->scene.lights) light.position *= scale;
    setup->scene.camera.eye *= scale;
    setup->scene.camera.target *= scale;
    const Image image = picture_with(*setup, renderer::test::kEverything, 48, 36);
    EXPECT_TRUE(renderer::test::same_bits(image, expected)) << scale;
  }
}

}  // namespace
