#include "accel/make_structure.h"
#include "renderer/cpu_tracer.h"
#include "scene/sample_scenes.h"
#include "tests/renderer/test_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>

namespace {

using namespace encore;
using renderer::Image;

Image picture(const scene::Scene& scene, const scene::TriangleList& list,
              accel::AccelerationStructure& structure, int width, int height) {
  structure.build(list.triangles);
  renderer::CpuTracer tracer(2);
  tracer.init({&scene, &list, &structure});
  Image image;
  image.resize(width, height);
  tracer.render(scene.camera, image);
  return image;
}

bool same_bits(const Image& a, const Image& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

class StructuresAgree : public testing::TestWithParam<accel::StructureKind> {};

TEST_P(StructuresAgree, AStructureDrawsTheVeryPictureOfBruteForce) {
  const auto setup = renderer::test::sphere_before_square();
  const auto structure = accel::make_structure(accel::default_spec(GetParam()));
  const Image image = picture(setup->scene, setup->list, *structure, 90, 70);
  EXPECT_TRUE(same_bits(image, picture(setup->scene, setup->list, setup->structure, 90, 70)));
}

TEST_P(StructuresAgree, AlsoForAWholeScene) {
  const auto scene = scene::make_sample_scene(scene::kDefaultSceneName);
  ASSERT_TRUE(scene.has_value());
  scene::TriangleList list;
  scene::update_triangles(*scene, 0.3, list);
  const auto structure = accel::make_structure(accel::default_spec(GetParam()));
  accel::BruteForce brute;
  EXPECT_TRUE(
      same_bits(picture(*scene, list, *structure, 48, 48), picture(*scene, list, brute, 48, 48)));
}

INSTANTIATE_TEST_SUITE_P(All, StructuresAgree, testing::ValuesIn(accel::all_structure_kinds()),
                         [](const auto& parameter) {
                           std::string name(accel::to_string(parameter.param));
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
