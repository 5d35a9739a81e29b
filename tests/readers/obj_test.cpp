// The OBJ reader: what it makes of good files and of bad ones.
#include "scene/obj_reader.h"
#include "tests/readers/reader_test.h"

namespace encore::scene {
namespace {

Model read(const std::string& text) {
  return read_obj(text, "test.obj", {});
}

const char* const kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(ObjReader, ReadsPositionsBitForBit) {
  const Model model = read(
      "v 0.1 -1.17549435e-38 16777217\nv 3.4028235e38 1e-45 0.30000001192092896\n"
      "v +1.5 .25 -0\nf 1 2 3\n");
  const auto& p = model.mesh.positions;
  ASSERT_EQ(p.size(), 3U);
  EXPECT_EQ(p[0], glm::vec3(0.1F, -1.17549435e-38F, 16777216.0F));
  EXPECT_EQ(p[1], glm::vec3(3.4028235e38F, 1e-45F, 0.3F));
  EXPECT_EQ(p[2], glm::vec3(1.5F, 0.25F, 0.0F));
}

TEST(ObjReader, NegativeIndicesCountFromTheLatestVertex) {
  const Model model = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -4 -3 -1\n");
  ASSERT_EQ(model.mesh.triangles.size(), 2U);
  EXPECT_EQ(model.mesh.positions[model.mesh.triangles[1].z], glm::vec3(5.0F));
  EXPECT_TRUE(model.warnings.messages.empty());
}

TEST(ObjReader, FacesMayComeBeforeTheirVertices) {
  EXPECT_EQ(read("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").mesh.triangles.size(), 1U);
}

TEST(ObjReader, MergesCornersThatShareEverythingAndOnlyThose) {
  const Model model = read(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 0\nvn 0 0 1\nvn 0 0 -1\n"
      "f 1//1 2//1 3//1\nf 1//1 3//1 4//1\nf 1//2 3//2 2//2\nf 5//1 2//1 3//1\n");
  // Four corners with the first normal, three with the second, and vertex 5, which lies on vertex 1
  // but is another one in the file.
  EXPECT_EQ(model.mesh.positions.size(), 8U);
  EXPECT_EQ(model.mesh.normals.size(), 8U);
}

TEST(ObjReader, CornersWithoutNormalGetAZeroNormal) {
  const Model model = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf 3 2 1\n");
  ASSERT_EQ(model.mesh.normals.size(), 6U);
  EXPECT_EQ(model.mesh.normals[0], glm::vec3(0.0F, 0.0F, 1.0F));
  EXPECT_EQ(model.mesh.normals[3], glm::vec3(0.0F));
}

TEST(ObjReader, ReadsVertexColoursAndFillsMissingOnesWithWhite) {
  const Model model = read("v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0 1.0 0 0 1\nf 1 2 3\n");
  ASSERT_EQ(model.mesh.colors.size(), 3U);
  EXPECT_EQ(model.mesh.colors[0], glm::vec3(1.0F, 0.5F, 0.0F));
  EXPECT_EQ(model.mesh.colors[1], glm::vec3(1.0F));
  EXPECT_EQ(model.mesh.colors[2], glm::vec3(0.0F, 0.0F, 1.0F));
}

TEST(ObjReader, ConcaveQuadIsCutAtItsReflexCorner) {
  const Model model = read("v 0 0 0\nv 2 -1 0\nv 0.5 0 0\nv 2 1 0\nf 1 2 3 4\n");
  ASSERT_EQ(model.mesh.triangles.size(), 2U);
  for (const glm::uvec3& t : model.mesh.triangles) EXPECT_GT(doubled_area(model.mesh, t), 0.0);
}

TEST(ObjReader, PolygonsOfMoreThan255CornersAreWhole) {
  std::string text;
  std::string face = "f";
  for (int i = 0; i < 1000; ++i) {
    text.append("v ").append(std::to_string(i)).append(" ");
    text.append(std::to_string(i * i)).append(" 0\n");
    face.append(" ").append(std::to_string(i + 1));
  }
  EXPECT_EQ(read(text + face).mesh.triangles.size(), 998U);
}

TEST(ObjReader, TakesAnyLineEndAndJoinedLines) {
  EXPECT_EQ(read("v 0 0 0\r\nv 1 0 0\rv 0 1 0\r\nf 1 \\\r\n 2 3 # three").mesh.triangles.size(),
            1U);
}

TEST(ObjReader, DropsAndCountsBadIndices) {
  const Model model = read(std::string(kTriangle) +
                           "f 1 2 4\nf 0 1 2\nf -4 1 2\nf 1 2 99999999999999999999\n"
                           "f 1 2 4294967297\nf 1 2 x\n");
  EXPECT_EQ(model.mesh.triangles.size(), 1U);
  EXPECT_TRUE(warns(model, "test.obj:5: 6 triangles dropped: vertex index out of range"));
}

TEST(ObjReader, DropsAndCountsTrianglesWithoutFiniteCoordinates) {
  const Model model = read(std::string(kTriangle) +
                           "v nan 0 0\nv 0 inf 0\nv 0 0 1e99\nv 1.#IND 0 0\nv abc 0 0\nv 1 2\n"
                           "f 1 2 4\nf 1 2 5\nf 1 2 6\nf 1 2 7\nf 1 2 8\nf 1 2 9\n");
  EXPECT_EQ(model.mesh.triangles.size(), 1U);
  EXPECT_EQ(model.mesh.positions.size(), 3U);
  EXPECT_TRUE(warns(model, "test.obj:11: 6 triangles dropped: a coordinate is no finite number"));
  EXPECT_TRUE(warns(model, "test.obj:9: \"abc\" is no number"));
}

TEST(ObjReader, FacesOfOneOrTwoCornersAreLeftOut) {
  const Model model = read(std::string(kTriangle) + "f 1\nf 1 2\nf\n");
  EXPECT_EQ(model.mesh.triangles.size(), 1U);
  EXPECT_TRUE(warns(model, "2 faces with fewer than three corners"));
}

TEST(ObjReader, BadNormalOrTextureIndexKeepsTheTriangle) {
  const Model model = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/7/9 2/-1/1 3\n");
  EXPECT_EQ(model.mesh.triangles.size(), 1U);
  EXPECT_TRUE(model.mesh.normals.empty());
  EXPECT_TRUE(warns(model, "4 corners without the normal or texture coordinate"));
}

TEST(ObjReader, FileWithoutFacesIsAValidEmptyModel) {
  const Model model = read("# nothing but\nv 0 0 0\nv 1 0 0\np 1 2\nl 1 2\n");
  EXPECT_TRUE(model.mesh.triangles.empty());
  EXPECT_TRUE(model.mesh.positions.empty());
  EXPECT_TRUE(warns(model, "holds no triangles; 2 points not drawn; 1 line not drawn"));
  EXPECT_TRUE(read("# a comment only").mesh.triangles.empty());
}

TEST(ObjReader, RefusesWhatIsNoObj) {
  EXPECT_TRUE(contains(error_of([] { read(""); }), "test.obj: the file is empty"));
  EXPECT_TRUE(contains(error_of([] { read("Dear reader,\nhello.\n"); }), "test.obj:1: \"Dear\""));
  EXPECT_TRUE(contains(error_of([] { read(std::string(100, '\0')); }), "binary"));
  EXPECT_TRUE(contains(error_of([] { read("\xFF\xFEv"); }), "UTF-16"));
}

TEST(ObjReader, ReadsMaterialsOfTheMtl) {
  const Model model = read_obj(fixture("tetrahedron.obj"));
  EXPECT_EQ(model.name, "tetrahedron");
  EXPECT_EQ(model.mesh.positions.size(), 4U);
  EXPECT_EQ(model.mesh.material_of, (std::vector<std::uint32_t>{0, 0, 1, 1}));
  ASSERT_EQ(model.materials.size(), 2U);
  const Material& metal = model.materials[0];
  EXPECT_EQ(metal.name, "red metal");
  EXPECT_EQ(metal.ambient, glm::vec3(0.2F, 0.0F, 0.0F));
  EXPECT_EQ(metal.diffuse, glm::vec3(0.8F, 0.1F, 0.1F));
  EXPECT_EQ(metal.specular, glm::vec3(0.5F));
  EXPECT_EQ(metal.emission, glm::vec3(0.0F, 0.25F, 0.0F));
  EXPECT_EQ(metal.shininess, 64.0F);
  EXPECT_EQ(metal.reflectivity, 0.5F);
  EXPECT_EQ(metal.illumination_model, 3);
  const Material& glass = model.materials[1];
  EXPECT_EQ(glass.opacity, 0.25F);
  EXPECT_EQ(glass.index_of_refraction, 1.5F);
  EXPECT_EQ(glass.ambient, Material().ambient);
  EXPECT_EQ(glass.shininess, Material().shininess);
  EXPECT_TRUE(model.warnings.messages.empty());
}

TEST(ObjReader, PathsNeedNotBeAscii) {
  const Model model = read_model(fixture("Größe_模型.obj"));
  EXPECT_EQ(model.name, "Größe_模型");
  ASSERT_EQ(model.materials.size(), 2U);
  EXPECT_EQ(model.materials[0].diffuse, glm::vec3(0.8F, 0.1F, 0.1F));
  EXPECT_TRUE(model.warnings.messages.empty());
}

TEST(ObjReader, MissingMaterialsAreWarnings) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "m.obj", "mtllib none.mtl\nusemtl a\n" + std::string(kTriangle) + "usemtl b\nf 3 2 1\n");
  const Model model = read_obj(file);
  EXPECT_EQ(model.mesh.triangles.size(), 2U);
  ASSERT_EQ(model.materials.size(), 2U);
  EXPECT_EQ(model.materials[1].diffuse, Material().diffuse);
  EXPECT_TRUE(warns(model, "m.obj:1: material file \"none.mtl\" not found"));
  EXPECT_TRUE(warns(model, "m.obj:2: material \"a\" (and 1 other) is in no material file"));
}

TEST(ObjReader, BrokenMaterialFilesAreWarnings) {
  const TemporaryFolder folder;
  const auto obj = folder.write("m.obj", "mtllib a b.mtl\nusemtl x\n" + std::string(kTriangle));
  const std::string mtl =
      "newmtl x\nKd red\nKs nan 0 0\nd 7\nNs 1e2147483648\nKa 3 3 3\nKe 0.5\nillum 999999999999\n";
  folder.write("a b.mtl", mtl + std::string(1, '\0') + "\xFF\n");
  const Model model = read_obj(obj);
  ASSERT_EQ(model.materials.size(), 1U);
  EXPECT_EQ(model.materials[0].diffuse, Material().diffuse);
  EXPECT_EQ(model.materials[0].opacity, 1.0F);
  EXPECT_EQ(model.materials[0].shininess, Material().shininess);
  EXPECT_EQ(model.materials[0].ambient, glm::vec3(1.0F));
  EXPECT_EQ(model.materials[0].emission, glm::vec3(0.5F));
  EXPECT_TRUE(warns(model, "a b.mtl:2: Kd has no usable number"));
}

TEST(ObjReader, MaterialFilesThatAreNoFilesDoNotBlock) {
  const TemporaryFolder folder;
  const auto file = folder.write("m.obj", "mtllib /dev/zero\nmtllib .\n" + std::string(kTriangle));
  EXPECT_TRUE(warns(read_obj(file), "not found"));
}

}  // namespace
}  // namespace encore::scene
