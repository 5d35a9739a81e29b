// Diffuse textures: which files give which texels, how models of every reader come by them, and
// that what is missing or broken costs the texture and not the model.
#include "scene/obj_reader.h"
#include "scene/obj_reader_mtl_map.h"
#include "scene/texture_reader.h"
#include "tests/readers/picture_bytes.h"
#include "tests/readers/reader_test.h"

#include <algorithm>
#include <vector>

namespace encore::scene {
namespace {

constexpr const char* kWornTriangle =
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n";

std::vector<std::uint32_t> picture() {
  return {std::begin(kPictureTexels), std::end(kPictureTexels)};
}

TEST(Texture, PngAndPnmGiveTheSameTexelsWithTheTopRowFirst) {
  for (const std::string& bytes : {png_picture(), pnm_picture()}) {
    const Texture texture = decode_texture(bytes, "t");
    EXPECT_EQ(texture.width, 2);
    EXPECT_EQ(texture.height, 2);
    EXPECT_EQ(texture.texels, picture());
    EXPECT_EQ(texture.bytes(), 16U);
  }
}

TEST(Texture, GreyBecomesColourAndTransparencyIsLeftOut) {
  EXPECT_EQ(decode_texture(std::string("P5 1 1 255\n\x40", 12), "t").texels,
            std::vector<std::uint32_t>{0xFF404040U});
  // TGA, 32 bits a texel, uncompressed, from the top: blue, green, red, alpha.
  const char tga[] = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 32, 0x28, 1, 2, 3, 4};
  EXPECT_EQ(decode_texture({tga, sizeof(tga)}, "t").texels,
            std::vector<std::uint32_t>{0xFF010203U});
}

TEST(Texture, WhatIsNoPictureOrTooLargeIsOneClearLine) {
  const auto error = [](const std::string& bytes) {
    return error_of([&bytes] { decode_texture(bytes, "t.png"); });
  };
  EXPECT_TRUE(contains(error(""), "t.png: the file is empty"));
  EXPECT_TRUE(contains(error("Dear reader"), "t.png: is no picture that can be read"));
  EXPECT_TRUE(contains(error("P6 20000 1 255\n"), "has 20000x1 texels; the limits are 16384 a"));
  EXPECT_TRUE(contains(error("P6 16384 16384 255\n"), "and 256 MiB; scale it down"));
  EXPECT_TRUE(contains(error(png_picture().substr(0, 50)), "t.png: is damaged"));
}

TEST(Texture, EveryTruncationDecodesOrIsAnInputError) {
  for (const std::string& whole : {png_picture(), pnm_picture()}) {
    for (std::size_t size = 0; size < whole.size(); ++size) {
      try {
        EXPECT_EQ(decode_texture(whole.substr(0, size), "t").texels.size(), 4U);
      } catch (const InputError& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("t: "));
      }
    }
  }
}

TEST(Texture, MtlMapsSkipTheirOptions) {
  const auto file = [](const char* arguments) {
    return std::string(parse_mtl_map(arguments).file);
  };
  EXPECT_EQ(file(" a.png "), "a.png");
  EXPECT_EQ(file("-clamp on -blendu off a b.png"), "a b.png");
  EXPECT_EQ(file("-s 1 2 a.png"), "a.png");
  EXPECT_EQ(file("-o 0.1 0.2 0.3 -mm 0 1 -texres 512 -imfchan r -bm 2 sub\\a.png"), "sub\\a.png");
  EXPECT_EQ(file("-t 1 \"a b.png\""), "a b.png");
  EXPECT_EQ(file("-a.png"), "-a.png");
  EXPECT_EQ(file("-s 1 1 1"), "");
  EXPECT_EQ(file(""), "");
  EXPECT_TRUE(parse_mtl_map("-s 2 2 a.png").transformed);
  EXPECT_FALSE(parse_mtl_map("-clamp on a.png").transformed);
}

TEST(Texture, ObjFindsItAsTheMtlNamesIt) {
  for (const char* stated : {"sub dir/a b.png", "sub dir\\a b.png", "C:\\elsewhere\\beside.png",
                             "-clamp on -s 1 1 1 beside.png", "/nowhere/beside.png"}) {
    const TemporaryFolder folder;
    folder.write("m.mtl", std::string("newmtl a\nKd 0.5 1 1\nmap_Kd ") + stated + "\n");
    folder.write("sub dir/a b.png", png_picture());
    folder.write("beside.png", png_picture());
    const Model model = read_model(folder.write("m.obj", kWornTriangle));
    ASSERT_EQ(model.materials.size(), 1U);
    ASSERT_NE(model.materials[0].diffuse_texture, nullptr) << stated;
    EXPECT_EQ(model.materials[0].diffuse_texture->texels, picture());
    EXPECT_EQ(model.materials[0].diffuse, glm::vec3(0.5F, 1.0F, 1.0F));
    EXPECT_EQ(warns(model, "m.mtl:3: offset, scale"), contains(stated, "-s")) << stated;
    ASSERT_EQ(model.mesh.texcoords.size(), 3U);
    EXPECT_EQ(model.mesh.texcoords[1], glm::vec2(1.0F, 0.0F));
  }
}

TEST(Texture, TheDiffuseColourIsAsTinyobjHasItWhereNoneIsStated) {
  const TemporaryFolder folder;
  folder.write("a.png", png_picture());
  folder.write("m.mtl", "newmtl a\nmap_Kd a.png\nnewmtl b\nmap_Kd a.png\nKd 0 0 0\n");
  const Model model =
      read_model(folder.write("m.obj", kWornTriangle + std::string("usemtl b\nf 3/3 2/2 1/1\n")));
  ASSERT_EQ(model.materials.size(), 2U);
  EXPECT_EQ(model.materials[0].diffuse, glm::vec3(0.6F));
  EXPECT_EQ(model.materials[1].diffuse, glm::vec3(0.0F));
  EXPECT_NE(model.materials[0].diffuse_texture, nullptr);
  EXPECT_EQ(model.materials[0].diffuse_texture, model.materials[1].diffuse_texture);
}

TEST(Texture, MissingAndBrokenOnesAreWarningsThatNameFileAndMaterial) {
  const TemporaryFolder folder;
  folder.write("m.mtl", "newmtl a\nmap_Kd none.png\nnewmtl b\nmap_Kd bad.png\n");
  folder.write("bad.png", "Dear reader");
  const Model model =
      read_model(folder.write("m.obj", kWornTriangle + std::string("usemtl b\nf 3/3 2/2 1/1\n")));
  EXPECT_EQ(model.mesh.triangles.size(), 2U);
  EXPECT_EQ(model.materials.at(0).diffuse_texture, nullptr);
  EXPECT_EQ(model.materials.at(1).diffuse_texture, nullptr);
  EXPECT_EQ(model.warnings.messages.size(), 2U);
  EXPECT_TRUE(warns(model, "m.mtl: material \"a\": the texture \"none.png\" was not found"));
  EXPECT_TRUE(warns(model, "material \"b\": "));
  EXPECT_TRUE(warns(model, "bad.png: is no picture that can be read"));
}

TEST(Texture, IsNotReadWithoutCoordinates) {
  const TemporaryFolder folder;
  folder.write("m.mtl", "newmtl a\nmap_Kd none.png\n");
  const Model model = read_model(
      folder.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"));
  EXPECT_TRUE(model.mesh.texcoords.empty());
  EXPECT_TRUE(model.warnings.messages.empty());
}

TEST(Texture, OneSetReadsAFileOnceForAllModelsAndSearchesItsFolders) {
  const TemporaryFolder folder;
  folder.write("elsewhere/a.png", png_picture());
  folder.write("m.mtl", "newmtl a\nmap_Kd pictures/a.png\n");
  const auto obj = folder.write("m.obj", kWornTriangle);
  TextureSet textures({folder.path() / "elsewhere"});
  const Model first = read_model(obj, &textures);
  const Model second = read_model(obj, &textures);
  ASSERT_NE(first.materials.at(0).diffuse_texture, nullptr);
  EXPECT_EQ(first.materials[0].diffuse_texture, second.materials.at(0).diffuse_texture);
  EXPECT_NE(read_texture(folder.path() / "elsewhere/a.png").texels.size(), 0U);
}

TEST(Texture, AssimpMaterialsHaveThemToo) {
  const TemporaryFolder folder;
  folder.write("a.png", png_picture());
  const Model model = read_model(folder.write("m.gltf", gltf_triangle("a.png")));
  ASSERT_EQ(model.mesh.texcoords.size(), 3U);
  EXPECT_EQ(model.mesh.texcoords[0], glm::vec2(0.0F, 0.0F));
  EXPECT_EQ(model.mesh.texcoords[2], glm::vec2(0.0F, 1.0F));
  const Material& worn = model.materials.at(model.mesh.material_of.empty() ? 0 : 1);
  ASSERT_NE(worn.diffuse_texture, nullptr);
  EXPECT_EQ(worn.diffuse_texture->texels, picture());
  EXPECT_TRUE(model.warnings.messages.empty());

  folder.write("b.gltf", gltf_triangle("none.png"));
  EXPECT_TRUE(warns(read_model(folder.path() / "b.gltf"),
                    "b.gltf: material \"worn\": the texture \"none.png\" was not found"));
}

TEST(Texture, ThoseWithinAModelFileAreLeftOutWithAWarning) {
  const TemporaryFolder folder;
  const Model model =
      read_model(folder.write("m.gltf", gltf_triangle("data:image/png;base64,iVBORw0KGgo=")));
  EXPECT_EQ(model.mesh.triangles.size(), 1U);
  EXPECT_TRUE(warns(model, "m.gltf: 1 texture within the model file left out"));
}

TEST(Texture, CoordinatesSurvivePolygonsUnusedVerticesAndPly) {
  const TemporaryFolder folder;
  // An unused vertex in front, a concave polygon, one corner with another coordinate.
  const Model obj = read_model(folder.write(
      "m.obj",
      "v 9 9 9\nv 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nvt 0 0\nvt 1 0\nvt 0.25 0.25\nvt 0 1\n"
      "vt 0.5 0.5\nf 2/1 3/2 4/3 5/4\nf 2/5 5/4 4/3\n"));
  ASSERT_EQ(obj.mesh.triangles.size(), 3U);
  ASSERT_EQ(obj.mesh.texcoords.size(), obj.mesh.positions.size());
  EXPECT_EQ(obj.mesh.positions.size(), 5U);
  const auto is_quarter = [](const glm::vec3& p, const glm::vec2& t) {
    return t == glm::vec2(p.x, p.y) / 4.0F;
  };
  int own = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    own += is_quarter(obj.mesh.positions[i], obj.mesh.texcoords[i]) ? 1 : 0;
  }
  EXPECT_EQ(own, 4);

  for (const char* names :
       {"property float s\nproperty float t\n", "property float u\nproperty float v\n"}) {
    const Model ply = read_model(folder.write(
        "m.ply", std::string("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                             "property float y\nproperty float z\n") +
                     names +
                     "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                     "9 9 9 9 9\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 1 2 3\n"));
    ASSERT_EQ(ply.mesh.texcoords.size(), 3U);
    EXPECT_EQ(ply.mesh.texcoords[2], glm::vec2(0.0F, 1.0F));
  }
}

TEST(Texture, RealModelsKeepTheirCoordinates) {
  const auto folder = real_models();
  if (folder.empty()) GTEST_SKIP() << "no real models: set ENCORE_MODELS to their folder";
  const Model spot = read_model(folder / "extra/common/spot.obj");
  EXPECT_EQ(spot.mesh.triangles.size(), 5856U);
  ASSERT_EQ(spot.mesh.texcoords.size(), spot.mesh.positions.size());
  EXPECT_EQ(spot.mesh.texcoords.size(), 3225U);
}

}  // namespace
}  // namespace encore::scene
