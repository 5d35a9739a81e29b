#include "scene/scene_info.h"

#include "scene/basic_shapes.h"
#include "support.h"

namespace encore::scene::test {
namespace {

SceneInfo info_of(const Scene& scene) {
  return describe(scene, triangles_at(scene));
}

TEST(SceneInfo, AnEmptySceneHasZerosEverywhere) {
  const SceneInfo info = info_of(Scene{});
  EXPECT_EQ(info.triangles, 0U);
  EXPECT_EQ(info.surface_area, 0.0);
  EXPECT_EQ(info.extent.max, 0.0);
  EXPECT_EQ(info.occupied_share, 0.0);
  EXPECT_EQ(info.animation.kind, "static");
}

TEST(SceneInfo, CountsABox) {
  const Scene scene = parse("[[model]]\ngenerator = \"box\"\nscale = 2\n");
  const SceneInfo info = info_of(scene);
  EXPECT_EQ(info.triangles, 12U);
  EXPECT_EQ(info.vertices, 24U);  // four a face, for its texture
  EXPECT_EQ(info.models, 1U);
  EXPECT_EQ(info.instances, 1U);
  EXPECT_EQ(info.lights, 1U);
  EXPECT_DOUBLE_EQ(info.surface_area, 24.0);
  EXPECT_NEAR(info.area_unevenness, 0.0, 1e-12);
  EXPECT_DOUBLE_EQ(info.area.max, 1.0);
  EXPECT_DOUBLE_EQ(info.extent.median, 1.0);
  EXPECT_EQ(info.coarse_cells, glm::ivec3(16));
  EXPECT_DOUBLE_EQ(info.triangles_per_volume, 12.0 / 8.0);
  EXPECT_GT(info.mesh_bytes, 0U);
  EXPECT_GE(info.triangle_list_bytes, 12U * sizeof(Triangle));
  EXPECT_EQ(info.degenerate_triangles, 0U);
}

TEST(SceneInfo, TellsAnEvenSceneFromAnUnevenOne) {
  const SceneInfo even = info_of(parse("[[model]]\ngenerator = \"sphere\"\n"));
  // The same ball, tiny, in a hall a thousand times its size.
  const SceneInfo uneven =
      info_of(parse("[[model]]\ngenerator = \"sphere\"\ntranslate = [60, 60, 60]\n"
                    "[[model]]\ngenerator = \"box\"\nscale = 2000\n"));
  EXPECT_LT(even.area_unevenness, 0.5);
  EXPECT_GT(uneven.area_unevenness, 0.99);
  EXPECT_LT(even.fullest_cell_share, 0.05);
  EXPECT_GT(uneven.fullest_cell_share, 0.9);
  EXPECT_GT(even.occupied_share, 10 * uneven.occupied_share);
  EXPECT_LT(uneven.extent.median, 1e-3);
}

TEST(SceneInfo, CountsDegenerateAndDroppedTriangles) {
  Model model = square_model();
  model.mesh.triangles.emplace_back(1, 1, 2);  // two corners the same
  model.mesh.triangles.emplace_back(0, 1, 4);  // a corner at infinity
  model.mesh.positions.emplace_back(INFINITY, 0.0F, 0.0F);
  const SceneInfo info = info_of(place_model(std::move(model)));
  EXPECT_EQ(info.triangles, 3U);
  EXPECT_EQ(info.degenerate_triangles, 1U);
  EXPECT_EQ(info.dropped_non_finite, 1U);
}

TEST(SceneInfo, AFlatSceneHasACoarseGridOfOneLayerAndNoVolume) {
  const SceneInfo info = info_of(parse("[[model]]\ngenerator = \"square\"\n"));
  EXPECT_EQ(info.coarse_cells, glm::ivec3(16, 16, 1));
  EXPECT_EQ(info.triangles_per_volume, 0.0);
}

TEST(SceneInfo, KnowsHowItMoves) {
  const TemporaryFolder folder;
  folder.write("f/1.obj", kTriangleObj);
  folder.write("f/2.obj", kSquareObj);
  folder.write("f/3.obj", kTriangleObj);
  const std::string box = "[[model]]\ngenerator = \"box\"\n";
  const std::string keys = "[[model.key]]\ntime = 0\n[[model.key]]\ntime = 3\ntranslate=[1,0,0]\n";
  const std::string frames = "[[model]]\nframes = { folder = \"f\", fps = 2 }\n";

  const SceneInfo rigid = info_of(parse(box + keys));
  EXPECT_EQ(rigid.animation.kind, "rigid parts");
  EXPECT_EQ(rigid.animation.duration_s, 3.0);
  EXPECT_EQ(rigid.animation.moving_instances, 1U);
  EXPECT_EQ(info_of(parse(box + "deform = { kind = \"wave\" }\n")).animation.kind, "deforming");

  const SceneInfo sequence = info_of(parse(box + frames, folder.path()));
  EXPECT_EQ(sequence.animation.kind, "frame sequence");
  EXPECT_EQ(sequence.animation.frames, 3U);
  EXPECT_EQ(sequence.animation.duration_s, 1.5);
  EXPECT_EQ(sequence.animation.min_triangles, 13U);
  EXPECT_EQ(sequence.animation.max_triangles, 14U);
  EXPECT_EQ(sequence.models, 4U);
  EXPECT_EQ(info_of(parse(box + keys + frames, folder.path())).animation.kind, "mixed");
}

TEST(SceneInfo, PassesTheWarningsOn) {
  const SceneInfo info = info_of(parse("nmae = \"x\"\n"));
  ASSERT_EQ(info.warnings.size(), 1U);
}

}  // namespace
}  // namespace encore::scene::test
