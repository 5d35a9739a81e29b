// Every sample scene has a small picture in tests/fixtures/golden. After a change that is meant to
// alter pictures, run this program once with ENCORE_UPDATE_GOLDEN=1 and look at what changed.

#include "accel/make_structure.h"
#include "renderer/cpu_tracer.h"
#include "renderer/image_io.h"
#include "scene/sample_scenes.h"
#include "tests/renderer/png.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace encore;

class Golden : public testing::TestWithParam<std::string> {};

TEST_P(Golden, TheSceneLooksAsItDid) {
  const auto scene = scene::make_sample_scene(GetParam());
  ASSERT_TRUE(scene.has_value());
  scene::TriangleList list;
  scene::update_triangles(*scene, 0.0, list);
  const auto structure =
      accel::make_structure(accel::default_spec(accel::StructureKind::bvh_median));
  structure->build(list.triangles);
  renderer::CpuTracer tracer;
  tracer.init({&*scene, &list, structure.get()});
  renderer::Image image;
  image.resize(64, 64);
  tracer.render(scene->camera, image);

  const auto path = std::filesystem::path(ENCORE_FIXTURES) / "golden" / (GetParam() + ".png");
  if (std::getenv("ENCORE_UPDATE_GOLDEN") != nullptr) renderer::write_png(image, path);
  const auto golden = renderer::test::read_png(path);
  ASSERT_EQ(golden.values.size(), std::size_t{64} * 64 * 3) << "no golden picture " << path;

  // Scene, hits, shading and encoding use IEEE basic operations only, so not one code may differ.
  std::size_t differing = 0;
  bool all_background = true;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    all_background &= image.pixels[i] == scene->background;
    for (int c = 0; c < 3; ++c) {
      const auto code = renderer::to_srgb8(image.pixels[i][c]);
      differing += code != golden.values[3 * i + static_cast<std::size_t>(c)] ? 1 : 0;
    }
  }
  EXPECT_EQ(differing, 0U);
  EXPECT_FALSE(all_background) << "the picture shows nothing";
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const scene::SampleScene& sample : scene::sample_scenes()) all.push_back(sample.name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(SampleScenes, Golden, testing::ValuesIn(names()),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           for (char& c : name) {
                             if (c == '-' || c == '.') c = '_';
                           }
                           return name;
                         });

}  // namespace
