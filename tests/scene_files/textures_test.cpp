// Textures in scene files and in the triangle list: there if a surface wears one, and only then.
#include "scene/basic_shapes.h"
#include "scene/checker_texture.h"
#include "scene/scene_info.h"
#include "support.h"

#include <algorithm>

namespace encore::scene::test {
namespace {

/// Two by two texels as PNM: red and green above blue and grey.
std::string picture() {
  return std::string("P6 2 2 255\n\xFF\0\0\0\xFF\0\0\0\xFF\x10\x10\x10", 23);
}

constexpr const char* kCheckered =
    "[[material]]\nname = \"board\"\ntexture = \"checker\"\n"
    "texture_colors = [[1, 0, 0], 0.5]\ntexture_cells = 4\n"
    "[[model]]\ngenerator = \"square\"\nmaterial = \"board\"\n";

TEST(Textures, ASceneFileMakesACheckerOfTwoLinearColours) {
  const Scene scene = parse(kCheckered);
  EXPECT_TRUE(scene.warnings.messages.empty()) << joined(scene.warnings);
  ASSERT_EQ(scene.materials.size(), 1U);
  ASSERT_NE(scene.materials[0].diffuse_texture, nullptr);
  const Texture& board = *scene.materials[0].diffuse_texture;
  EXPECT_EQ(board.name, "checker");
  ASSERT_EQ(board.width, 512);
  ASSERT_EQ(board.texels.size(), 512U * 512U);
  EXPECT_EQ(board.texels[0], 0xFF0000FFU);
  EXPECT_EQ(board.texels[127], 0xFF0000FFU);
  EXPECT_EQ(board.texels[128], 0xFFBCBCBCU);  // 0.5 is code 188
  EXPECT_EQ(board.texels[128U * 512U], 0xFFBCBCBCU);
  EXPECT_EQ(board.texels[128U * 512U + 128U], 0xFF0000FFU);
}

TEST(Textures, CodesAreThoseOfTheStandard) {
  EXPECT_EQ(srgb_code(-1.0F), 0U);
  EXPECT_EQ(srgb_code(0.0F), 0U);
  EXPECT_EQ(srgb_code(1.0F), 255U);
  EXPECT_EQ(srgb_code(7.0F), 255U);
  for (unsigned code = 0; code < 256; ++code) {
    const double encoded = code / 255.0;
    const double linear =
        encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    EXPECT_EQ(srgb_code(static_cast<float>(linear)), code);
  }
}

TEST(Textures, ASceneFileNamesAPictureBesideItOnce) {
  const TemporaryFolder folder;
  folder.write("p/a.ppm", picture());
  const Scene scene = parse(
      "[[model]]\ngenerator = \"square\"\nmaterial = { texture = \"p/a.ppm\" }\n"
      "[[model]]\ngenerator = \"box\"\nmaterial = { texture = \"p/../p/a.ppm\" }\n",
      folder.path());
  ASSERT_EQ(scene.materials.size(), 2U);
  ASSERT_NE(scene.materials[0].diffuse_texture, nullptr);
  EXPECT_EQ(scene.materials[0].diffuse_texture, scene.materials[1].diffuse_texture);
  EXPECT_EQ(scene.materials[0].diffuse_texture->texels[1], 0xFF00FF00U);
}

TEST(Textures, WhatIsWrongInASceneFileIsNamedWithItsPlace) {
  const TemporaryFolder folder;
  folder.write("bad.png", "Dear reader");
  const auto error = [&folder](const std::string& keys) {
    return error_in("[[model]]\ngenerator = \"square\"\n[model.material]\n" + keys, folder.path());
  };
  EXPECT_TRUE(contains(error("texture = \"a.png\"\n"),
                       "scene.toml:4:11: cannot find the texture 'a.png' (tried "));
  EXPECT_TRUE(contains(error("texture = \"bad.png\"\n"), "scene.toml:4:11: "));
  EXPECT_TRUE(contains(error("texture = \"bad.png\"\n"), "is no picture that can be read"));
  EXPECT_TRUE(contains(error("texture = 3\n"), "4:11: 'texture' must be a string"));
  EXPECT_TRUE(contains(error("texture_cells = 3\n"), "4:17: 'texture_cells' describes a checker"));
  const std::string checker = "texture = \"checker\"\n";
  EXPECT_TRUE(contains(error(checker + "texture_cells = 0\n"), "5:17: 'texture_cells' must be"));
  EXPECT_TRUE(
      contains(error(checker + "texture_cells = 2.5\n"), "must be a whole number, not 2.5"));
  EXPECT_TRUE(contains(error(checker + "texture_colors = [1]\n"), "must hold two colours, not 1"));
  EXPECT_TRUE(contains(error(checker + "texture_colors = [1, [1, 2]]\n"), "array of 3 numbers"));
  EXPECT_TRUE(contains(error(checker + "texture_colors = [1, 2]\n"), "between 0 and 1"));
}

TEST(Textures, AModelWithoutCoordinatesCannotWearOne) {
  const TemporaryFolder folder;
  folder.write("t.obj", kTriangleObj);
  const Scene scene =
      parse("[[model]]\nfile = \"t.obj\"\nmaterial = { texture = \"checker\" }\n", folder.path());
  EXPECT_EQ(scene.materials.at(0).diffuse_texture, nullptr);
  EXPECT_TRUE(contains(joined(scene.warnings),
                       "scene.toml:2:8: the material's texture is left out: the model has no"));
}

TEST(Textures, TheListHasCoordinatesOnlyWhereSomeSurfaceWearsATexture) {
  Scene scene = parse(kCheckered + std::string("[[model]]\ngenerator = \"box\"\n") +
                      "[[model]]\ngenerator = \"cow\"\n");
  TriangleList list;
  update_triangles(scene, 0.0, list);
  ASSERT_EQ(list.texcoords.size(), list.triangles.size());
  EXPECT_EQ(list.texcoords[0][1], glm::vec2(1.0F, 0.0F));
  EXPECT_EQ(list.texcoords[1][2], glm::vec2(0.0F, 1.0F));
  EXPECT_EQ(list.texcoords.back()[1], glm::vec2(0.0F));  // the cow has none
  const std::uint64_t version = list.version;
  EXPECT_EQ(update_triangles(scene, 0.5, list), TriangleChange::none);

  // Gone with the texture, and back with it; both change what lies beside every triangle.
  const auto texture = std::exchange(scene.materials[0].diffuse_texture, nullptr);
  scene.mark_changed();
  EXPECT_EQ(update_triangles(scene, 0.0, list), TriangleChange::moved);
  EXPECT_EQ(list.texcoords.capacity(), 0U);
  EXPECT_EQ(list.version, version + 1);
  scene.materials[0].diffuse_texture = texture;
  scene.mark_changed();
  EXPECT_EQ(update_triangles(scene, 0.0, list), TriangleChange::moved);
  EXPECT_EQ(list.texcoords.size(), list.triangles.size());
  EXPECT_EQ(changed_since(list, version + 1).size(), 1U);

  // A texture that only the model without coordinates wears is of no use.
  std::swap(scene.materials.front().diffuse_texture, scene.materials.back().diffuse_texture);
  scene.mark_changed();
  update_triangles(scene, 0.0, list);
  EXPECT_TRUE(list.texcoords.empty());
}

TEST(Textures, TheDescriptionCountsThemAndTheirBytes) {
  const auto info = [](const Scene& scene) { return describe(scene, triangles_at(scene)); };
  const Scene textured = parse(kCheckered + std::string("[[model]]\ngenerator = \"box\"\n"
                                                        "material = \"board\"\n"));
  const Scene plain = parse("[[model]]\ngenerator = \"square\"\n[[model]]\ngenerator = \"box\"\n");
  EXPECT_TRUE(info(textured).has_texcoords);
  EXPECT_EQ(info(textured).textures, 1U);
  EXPECT_EQ(info(textured).texture_bytes, 512U * 512U * 4U);
  EXPECT_FALSE(info(plain).has_texcoords);
  EXPECT_EQ(info(plain).textures, 0U);
  EXPECT_EQ(info(textured).triangle_list_bytes, info(plain).triangle_list_bytes + 14U * 24U);
}

TEST(Textures, TheSphereWearsAPictureOnceAroundWithItsMiddleInFront) {
  const Mesh mesh = sphere_model(16, 8).mesh;
  ASSERT_EQ(mesh.texcoords.size(), mesh.positions.size());
  double area = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec2 a(mesh.texcoords[t.x]);
    const glm::dvec2 b = glm::dvec2(mesh.texcoords[t.y]) - a;
    const glm::dvec2 c = glm::dvec2(mesh.texcoords[t.z]) - a;
    const double signed_area = 0.5 * (b.x * c.y - b.y * c.x);
    EXPECT_GT(signed_area, 0.0);  // not mirrored
    area += signed_area;
  }
  EXPECT_NEAR(area, 15.0 / 16.0 + 1.0 / 16.0 - 1.0 / 8.0, 1e-6);  // but half of each pole's row
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3& p = mesh.positions[i];
    const glm::vec2& t = mesh.texcoords[i];
    if (near(p, {0.0F, 0.0F, 1.0F})) {
      EXPECT_NEAR(t.x - std::floor(t.x), 0.5, 1e-6);
    }
    if (near(p, {1.0F, 0.0F, 0.0F})) {
      EXPECT_NEAR(t.x, 0.75, 1e-6);
    }
    if (near(p, {0.0F, 1.0F, 0.0F})) {
      EXPECT_EQ(t.y, 1.0F);
    }
    if (std::abs(p.y) < 1e-6F) {
      EXPECT_NEAR(t.y, 0.5, 1e-6);
    }
  }
}

TEST(Textures, EachFaceOfTheBoxWearsAWholePictureUprightAndUnmirrored) {
  const Mesh mesh = box_model().mesh;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec2 a = mesh.texcoords[t.x];
    const glm::vec2 b = mesh.texcoords[t.y] - a;
    const glm::vec2 c = mesh.texcoords[t.z] - a;
    EXPECT_EQ(b.x * c.y - b.y * c.x, 1.0F);
    const glm::vec3 p = mesh.positions[t.x];
    const bool side = p.y != mesh.positions[t.y].y || p.y != mesh.positions[t.z].y;
    if (side) {
      EXPECT_EQ(mesh.texcoords[t.x].y, p.y + 0.5F);
    }
  }
}

}  // namespace
}  // namespace encore::scene::test
