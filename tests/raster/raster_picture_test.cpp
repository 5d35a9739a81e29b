// The rasteriser's pictures are the tracer's, but for pixels on edges.

#include "renderer/image_diff.h"
#include "scene/sample_scenes.h"
#include "tests/raster/raster_scenes.h"
#include "tests/support/gl_context.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <utility>

namespace {

using namespace encore;
using renderer::Image;
using renderer::test::TestScene;

/// How far the rasteriser's picture is from the tracer's: pixels that differ visibly, the rest.
struct Difference {
  double share = 0.0;
  double rmse = 0.0;
};

Difference difference_of(const Image& raster, const Image& traced) {
  const renderer::ImageDifference found = renderer::compare_images(raster, traced, 0.02);
  return {static_cast<double>(found.differing) / static_cast<double>(traced.pixels.size()),
          found.rmse};
}

bool same_bits(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

class RasterPicture : public test::GlTest {
 protected:
  Difference difference(const scene::Scene& scene, const scene::TriangleList& list,
                        const scene::Camera& camera, int width, int height) const {
    return difference_of(
        renderer::test::raster_picture(context_, scene, list, camera, width, height),
        renderer::test::traced_picture(scene, list, camera, width, height));
  }

  /// The picture of a scene that is given directly.
  [[nodiscard]] Image picture(const TestScene& setup, int width = 48, int height = 48) const {
    return renderer::test::raster_picture(context_, setup.scene, setup.list, setup.scene.camera,
                                          width, height);
  }
};

class RasterSamples : public RasterPicture, public testing::WithParamInterface<std::string> {};

TEST_P(RasterSamples, LookAsTheyAreTraced) {
  const auto scene = scene::make_sample_scene(GetParam());
  ASSERT_TRUE(scene.has_value());
  scene::TriangleList list;
  scene::update_triangles(*scene, 0.0, list);
  const Difference found = difference(*scene, list, scene->camera, 64, 64);
  EXPECT_LT(found.share, 0.01);
  EXPECT_LT(found.rmse, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RasterSamples,
                         testing::Values("triangle", "toys", "mug", "cow", "car", "still-life",
                                         "wave", "metaballs"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

TEST_P(RasterSamples, LookAsTheyAreTracedInOrthographicViews) {
  const auto scene = scene::make_sample_scene(GetParam());
  ASSERT_TRUE(scene.has_value());
  scene::TriangleList list;
  scene::update_triangles(*scene, 0.0, list);
  scene::Camera camera = scene->camera;
  camera.orthographic_height = glm::length(list.bounds().size());
  Difference found = difference(*scene, list, camera, 64, 64);
  EXPECT_LT(found.share, 0.01);
  EXPECT_LT(found.rmse, 0.02);
  // Askew, and with the plane through the eye in the middle of the scene.
  camera.eye = list.bounds().center();
  camera.target = camera.eye + glm::vec3(0.3F, -0.4F, -1.0F);
  camera.orthographic_height *= 0.5F;
  found = difference(*scene, list, camera, 75, 40);
  EXPECT_LT(found.share, 0.02);
  EXPECT_LT(found.rmse, 0.04);
}

TEST_F(RasterPicture, ATriangleBeyondThePictureIsEqualEverywhere) {
  TestScene setup;
  setup.scene.camera = {.eye = {0.3F, -0.2F, 2.0F}};
  setup.scene.materials.resize(1);
  setup.scene.materials[0].specular = glm::vec3(0.5F);
  setup.scene.lights = {{.position = {2.0F, 3.0F, 4.0F}}};
  setup.list.triangles = {
      scene::make_triangle({-30.0F, -20.0F, 0.5F}, {30.0F, -20.0F, -0.5F}, {0.0F, 50.0F, 0.0F})};
  const Image traced =
      renderer::test::traced_picture(setup.scene, setup.list, setup.scene.camera, 61, 47);
  const auto found = renderer::compare_images(picture(setup, 61, 47), traced, 1e-4);
  EXPECT_EQ(found.differing, 0U) << "largest difference " << found.largest;
}

TEST_F(RasterPicture, RowsRunFromTheTopAndColumnsFromTheLeft) {
  TestScene setup;
  // The view spans [-2, 2]; the square covers the upper right quarter of it.
  setup.scene.camera = {.eye = {0.0F, 0.0F, 2.0F}};
  setup.scene.background = {0.0F, 0.0F, 1.0F};
  setup.scene.materials.resize(1);
  setup.scene.materials[0].emission = {1.0F, 0.0F, 0.0F};
  setup.scene.materials[0].ambient = glm::vec3(0.0F);
  renderer::test::add_square(setup.list, 1.0F, 0.0F);
  for (scene::Triangle& triangle : setup.list.triangles) {
    for (glm::vec3* corner : {&triangle.v0, &triangle.v1, &triangle.v2}) {
      *corner += glm::vec3(1.0F, 1.0F, 0.0F);
    }
  }
  const Image image = picture(setup, 32, 32);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      ASSERT_EQ(image.pixels[static_cast<std::size_t>(y * 32 + x)],
                x >= 16 && y < 16 ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1))
          << x << ", " << y;
    }
  }
}

TEST_F(RasterPicture, WindingDoesNotMatter) {
  const auto setup = renderer::test::sphere_before_square();
  const Image image = picture(*setup);
  for (std::size_t i = 0; i < setup->list.triangles.size(); ++i) {
    std::swap(setup->list.triangles[i].v1, setup->list.triangles[i].v2);
    std::swap(setup->list.normals[i][1], setup->list.normals[i][2]);
  }
  const auto found = renderer::compare_images(picture(*setup), image, 1e-3);
  EXPECT_EQ(found.differing, 0U) << "largest difference " << found.largest;
}

TEST_F(RasterPicture, ScenesOfAnySizeLookTheSame) {
  const auto setup = renderer::test::sphere_before_square();
  const Image image = picture(*setup);
  for (const int exponent : {-58, -40, 40, 58}) {
    const auto scaled = renderer::test::sphere_before_square();
    renderer::test::scale_scene(*scaled, exponent);
    const auto found = renderer::compare_images(picture(*scaled), image, 1e-4);
    EXPECT_EQ(found.differing, 0U) << "2^" << exponent << ": " << found.largest;
  }
}

TEST_F(RasterPicture, OrthographicScenesOfAnySizeLookTheSame) {
  const auto setup = renderer::test::sphere_before_square();
  setup->scene.camera.orthographic_height = 3.0F;
  const Image image = picture(*setup);
  EXPECT_LT(difference(setup->scene, setup->list, setup->scene.camera, 48, 48).share, 0.02);
  for (const int exponent : {-58, -40, 40, 58}) {
    const auto scaled = renderer::test::sphere_before_square();
    renderer::test::scale_scene(*scaled, exponent);
    scaled->scene.camera.orthographic_height = std::ldexp(3.0F, exponent);
    const auto found = renderer::compare_images(picture(*scaled), image, 1e-4);
    EXPECT_EQ(found.differing, 0U) << "2^" << exponent << ": " << found.largest;
  }
}

TEST_F(RasterPicture, WhatLiesBehindTheEyeIsNotSeenInOrthographicViews) {
  TestScene setup;
  setup.scene.materials.resize(1);
  setup.scene.materials[0].emission = {1.0F, 0.0F, 0.0F};
  setup.scene.materials[0].ambient = glm::vec3(0.0F);
  setup.scene.background = {0.0F, 0.0F, 1.0F};
  renderer::test::add_square(setup.list, 3.0F, 1.0F);
  setup.scene.camera = {.eye = {0, 0, 1.01F}, .target = {0, 0, 0}, .orthographic_height = 2.0F};
  for (const glm::vec3& pixel : picture(setup).pixels) ASSERT_EQ(pixel, glm::vec3(1, 0, 0));
  setup.scene.camera.eye.z = 0.99F;
  for (const glm::vec3& pixel : picture(setup).pixels) ASSERT_EQ(pixel, glm::vec3(0, 0, 1));
}

TEST_F(RasterPicture, OddSizesAndWideViewsHaveTheTracersPixels) {
  const auto setup = renderer::test::sphere_before_square();
  for (const auto& [width, height] : {std::pair{1, 1}, {37, 53}, {101, 17}, {3, 64}}) {
    const Difference found =
        difference(setup->scene, setup->list, setup->scene.camera, width, height);
    EXPECT_LT(found.share, 0.03) << width << " x " << height;
  }
  for (const float degrees : {5.0F, 120.0F, 170.0F, 179.0F}) {
    scene::Camera camera = setup->scene.camera;
    camera.vertical_fov_degrees = degrees;
    camera.up = {1.0F, 1.0F, 0.0F};
    EXPECT_LT(difference(setup->scene, setup->list, camera, 64, 40).share, 0.02) << degrees;
  }
}

TEST_F(RasterPicture, WhatPassesTheEyeIsCutOffCleanly) {
  // A floor that reaches far behind the eye, and a sphere around it.
  TestScene setup;
  setup.scene.camera = {.eye = {0.1F, 0.2F, 0.3F}, .target = {0.0F, 0.0F, -5.0F}};
  setup.scene.materials.resize(2);
  setup.scene.materials[1].diffuse = {0.2F, 0.6F, 0.1F};
  setup.scene.lights = {{.position = {0.0F, 0.5F, -0.2F}}};
  renderer::test::add_sphere(setup.list, 16, 0);
  setup.list.normals.clear();
  setup.list.triangles.push_back(scene::make_triangle(
      {-900.0F, -0.3F, 700.0F}, {0.0F, -0.3F, -900.0F}, {800.0F, -0.3F, 600.0F}, 1));
  EXPECT_LT(difference(setup.scene, setup.list, setup.scene.camera, 64, 64).share, 0.02);
}

TEST_F(RasterPicture, ColoursStayFiniteOnAWallThatAlmostTouchesTheEye) {
  for (const float gap : {1e-4F, 1e-5F, 1e-6F}) {
    TestScene setup;
    setup.scene.camera = {.eye = {0.1F, 0.0F, 0.3F}, .target = {0.2F, 0.0F, -5.0F}};
    setup.scene.materials.resize(1);
    setup.scene.materials[0].ambient = glm::vec3(0.0F);
    setup.scene.lights = {{.position = {0.0F, 1.5F, -1.0F}}};
    const float x = 0.1F + gap;
    setup.list.triangles = {
        scene::make_triangle({x, -100.0F, 50.0F}, {x, -100.0F, -50.0F}, {x, 1000.0F, 10.0F})};
    setup.list.colors = {{glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}};
    for (const glm::vec3& pixel : picture(setup).pixels) {
      // One light of white: no colour can be brighter than the vertices'.
      for (int c = 0; c < 3; ++c) ASSERT_TRUE(pixel[c] >= 0.0F && pixel[c] <= 1.0F) << gap;
    }
  }
}

TEST_F(RasterPicture, TheNearerOfTwoSurfacesIsSeenAtEveryDistance) {
  for (const float distance : {1e-6F, 1.0F, 1e3F, 1e7F}) {
    TestScene setup;
    setup.scene.camera = {.eye = {0.0F, 0.0F, 0.0F}, .target = {0.0F, 0.0F, -1.0F}};
    setup.scene.materials.resize(3);
    for (std::size_t i = 0; i < 3; ++i) {
      setup.scene.materials[i].ambient = glm::vec3(0.0F);
      setup.scene.materials[i].emission[static_cast<int>(i)] = 1.0F;
    }
    // Drawn first, last, and something far away that sets the scale.
    renderer::test::add_square(setup.list, 3.0F * distance, -distance, 1);
    renderer::test::add_square(setup.list, 3.0F * distance, -1.0001F * distance, 0);
    renderer::test::add_square(setup.list, 1e8F, -1e8F, 2);
    for (const glm::vec3& pixel : picture(setup, 16, 16).pixels) {
      ASSERT_EQ(pixel, glm::vec3(0, 1, 0)) << distance;
    }
  }
}

TEST_F(RasterPicture, AnEmptySceneIsAllBackground) {
  TestScene setup;
  setup.scene.background = {0.5F, 0.25F, 0.125F};
  const Image image = picture(setup, 17, 5);
  ASSERT_EQ(image.pixels.size(), 85U);
  for (const glm::vec3& pixel : image.pixels) EXPECT_EQ(pixel, setup.scene.background);
}

TEST_F(RasterPicture, EveryKindOfShadingIsTheTracers) {
  for (int kind = 0; kind < 16; ++kind) {
    const auto setup = renderer::test::sphere_before_square();
    if ((kind & 1) == 0) setup->scene.lights.clear();
    if ((kind & 2) == 0) setup->list.normals.clear();
    if ((kind & 4) == 0) setup->scene.materials[0].specular = glm::vec3(0.0F);
    if ((kind & 8) != 0) {
      for (std::size_t i = 0; i < setup->list.triangles.size(); ++i) {
        setup->list.colors.push_back({glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)});
      }
    }
    const Difference found = difference(setup->scene, setup->list, setup->scene.camera, 48, 48);
    EXPECT_LT(found.share, 0.02) << kind;
    EXPECT_LT(found.rmse, 0.02) << kind;
  }
}

TEST_F(RasterPicture, TrianglesAreTheirOwnInFramesOfSeveralPieces) {
  TestScene setup;
  setup.scene.camera = {.eye = {0.0F, 0.0F, 3.0F}, .vertical_fov_degrees = 60.0F};
  setup.scene.materials.resize(2);
  setup.scene.materials[1].diffuse = {0.2F, 0.6F, 0.1F};
  setup.scene.lights = {{.position = {2.0F, 3.0F, 4.0F}}};
  renderer::test::add_sphere(setup.list, 370, 0);
  renderer::test::add_square(setup.list, 1.2F, -1.5F, 1);
  setup.list.normals.resize(setup.list.triangles.size());
  ASSERT_GT(setup.list.triangles.size(), std::size_t{1} << 18U) << "that is a single piece";
  EXPECT_LT(difference(setup.scene, setup.list, setup.scene.camera, 48, 48).share, 0.02);
}

TEST_F(RasterPicture, ConsecutiveDrawsAreTheSameBitForBit) {
  const auto setup = renderer::test::sphere_before_square();
  renderer::RasterRenderer raster(context_);
  raster.init({&setup->scene, &setup->list, nullptr});
  Image first, second, small;
  raster.draw(setup->scene.camera, 48, 48);
  raster.read(first);
  // Another size in between must leave nothing behind.
  raster.draw(setup->scene.camera, 9, 7);
  raster.read(small);
  EXPECT_EQ(small.width, 9);
  EXPECT_EQ(small.height, 7);
  raster.draw(setup->scene.camera, 48, 48);
  raster.read(second);
  EXPECT_TRUE(same_bits(first, second));
}

}  // namespace
