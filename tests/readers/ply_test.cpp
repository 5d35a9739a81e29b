// The PLY reader: every variant of the format, and nothing believed that the file does not hold.
#include "scene/ply_reader.h"
#include "tests/readers/reader_test.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

namespace encore::scene {
namespace {

std::string header(const std::string& format, const std::string& vertices = "4",
                   const std::string& faces = "1", const std::string& count_type = "uchar") {
  return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list " + count_type + " int vertex_indices\nend_header\n";
}

template <typename Value>
std::string packed(Value value, bool big) {
  std::string bytes(sizeof(value), '\0');
  std::memcpy(bytes.data(), &value, sizeof(value));
  if (big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string binary_square(bool big) {
  std::string data;
  for (const float v : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F, 0.0F, 0.0F, 1.0F, 0.1F}) {
    data += packed(v, big);
  }
  data += '\4';
  for (const std::int32_t i : {0, 1, 2, 3}) data += packed(i, big);
  return data;
}

const char* const kSquare = "0 0 0\n1 0 0\n1 1 0\n0 1 0.1\n4 0 1 2 3\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

Model read(const std::string& file) {
  return read_ply(file, "test.ply");
}

void expect_square(const std::string& file) {
  const Model model = read(file);
  ASSERT_EQ(model.mesh.triangles.size(), 2U);
  ASSERT_EQ(model.mesh.positions.size(), 4U);
  EXPECT_EQ(model.mesh.positions[3], glm::vec3(0.0F, 1.0F, 0.1F));
  EXPECT_EQ(model.mesh.triangles[0], glm::uvec3(0U, 1U, 2U));
  EXPECT_EQ(model.materials.size(), 1U);
  EXPECT_TRUE(model.warnings.messages.empty());
}

TEST(PlyReader, ReadsAllThreeFormatsWithAnyLineEnd) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    expect_square(replaced(header("ascii") + kSquare, "\n", end));
    expect_square(replaced(header("binary_little_endian"), "\n", end) + binary_square(false));
    expect_square(replaced(header("binary_big_endian"), "\n", end) + binary_square(true));
  }
}

TEST(PlyReader, BinaryDataMayStartWithALineFeed) {
  std::string data = binary_square(false);
  data[0] = '\n';
  const Model model = read(header("binary_little_endian") + data);
  EXPECT_EQ(model.mesh.triangles.size(), 2U);
  EXPECT_GT(model.mesh.positions[0].x, 0.0F);
}

TEST(PlyReader, FacesMayComeFirstAndOtherElementsAreSkipped) {
  expect_square(
      "ply\nformat ascii 1.0\ncomment hello\nobj_info x\nelement face 1\n"
      "property uchar flags\nproperty list uint8 uint32 vertex_index\nproperty list uchar float w\n"
      "element material 2\nproperty list int float values\n"
      "element vertex 4\nproperty double z\nproperty float32 x\nproperty float y\nend_header\n"
      "9 4 0 1 2 3 2 0.5 0.5\n1 7\n0\n0 0 0 0 1 0\n0 1 1 0.1 0 1");
}

TEST(PlyReader, ReadsNormalsAndColours) {
  const Model model = read_model(fixture("square.ply"));
  ASSERT_EQ(model.mesh.colors.size(), 4U);
  EXPECT_EQ(model.mesh.colors[1], glm::vec3(0.0F, 1.0F, 0.0F));
  EXPECT_EQ(model.mesh.colors[3], glm::vec3(0.2F));
  EXPECT_EQ(model.mesh.normals[2], glm::vec3(0.0F, 0.0F, 1.0F));
}

TEST(PlyReader, StripsTurnEverySecondTriangleAndRestartAtMinusOne) {
  const Model model = read_model(fixture("strip_big_endian.ply"));
  ASSERT_EQ(model.mesh.triangles.size(), 3U);
  for (const glm::uvec3& t : model.mesh.triangles) EXPECT_EQ(doubled_area(model.mesh, t), 1.0);
}

TEST(PlyReader, DropsAndCountsBadFaces) {
  std::string text = replaced(header("ascii") + kSquare, "face 1", "face 5");
  const Model model = read(text + "3 0 1 9\n3 0 1 -1\n3 0 1 1.5\n2 0 1\n");
  EXPECT_EQ(model.mesh.triangles.size(), 2U);
  EXPECT_TRUE(warns(model, "face 1: 3 triangles dropped: vertex index out of range"));
  EXPECT_TRUE(warns(model, "1 face with fewer than three corners"));

  const Model holes = read(header("ascii") + "0 0 0\n1 0 0\nnan inf 0\n0 1 0\n4 0 1 2 3\n");
  EXPECT_TRUE(holes.mesh.triangles.empty());
  EXPECT_TRUE(holes.mesh.positions.empty());
  EXPECT_TRUE(warns(holes, "2 triangles dropped: a coordinate is no finite number"));
}

TEST(PlyReader, PointsAreAValidEmptyModel) {
  const Model model = read(header("ascii", "2", "0") + "0 0 0\n1 1 1\n");
  EXPECT_TRUE(model.mesh.triangles.empty());
  EXPECT_TRUE(warns(model, "holds no triangles; 2 points not drawn"));
}

TEST(PlyReader, TrailingDataIsAWarning) {
  EXPECT_TRUE(warns(read(header("ascii") + kSquare + "junk"), "data behind the last element"));
  EXPECT_TRUE(warns(read(header("binary_big_endian") + binary_square(true) + "junk"),
                    "data behind the last element"));
}

TEST(PlyReader, EveryTruncationIsAnError) {
  const std::string ascii = header("ascii") + kSquare;
  // The last cut still leaves the whole number 3.
  for (std::size_t size = 1; size + 2 < ascii.size(); ++size) {
    EXPECT_TRUE(contains(error_of([&] { read(ascii.substr(0, size)); }), "test.ply")) << size;
  }
  for (const bool big : {false, true}) {
    const std::string binary =
        header(big ? "binary_big_endian" : "binary_little_endian") + binary_square(big);
    for (std::size_t size = 1; size < binary.size(); ++size) {
      EXPECT_TRUE(contains(error_of([&] { read(binary.substr(0, size)); }), "test.ply")) << size;
    }
  }
}

TEST(PlyReader, HugeCountsAreRefusedBeforeAnythingIsStored) {
  for (const char* count : {"4000000000", "18446744073709551615", "6148914691236517206"}) {
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
      EXPECT_TRUE(contains(error_of([&] { read(header(format, count) + kSquare); }),
                           "more than the file holds"));
      EXPECT_TRUE(contains(error_of([&] { read(header(format, "1", count) + kSquare); }),
                           "more than the file holds"));
    }
  }
  const std::string list = header("ascii", "4", "1", "uint");
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  EXPECT_TRUE(contains(error_of([&] { read(list + vertices + "4294967295 0 1 2"); }),
                       "test.ply:14: a list in the data"));
  EXPECT_TRUE(contains(error_of([&] { read(list + vertices + "-3 0 1 2"); }), "test.ply:14"));
}

TEST(PlyReader, HeaderErrorsNameTheLine) {
  const std::string good = header("ascii") + kSquare;
  EXPECT_TRUE(contains(error_of([] { read("plywood\n"); }), "test.ply:1: does not start"));
  EXPECT_TRUE(contains(error_of([&] { read(replaced(good, "ascii", "text")); }), "test.ply:2"));
  EXPECT_TRUE(contains(error_of([&] { read(replaced(good, "1.0", "2.0")); }), "test.ply:2"));
  EXPECT_TRUE(
      contains(error_of([&] { read(replaced(good, "vertex 4", "vertex -4")); }), "test.ply:3"));
  EXPECT_TRUE(contains(error_of([&] { read(replaced(good, "float y", "real y")); }), "test.ply:5"));
  EXPECT_TRUE(contains(error_of([&] { read(replaced(good, "uchar", "float")); }), "test.ply:8"));
  EXPECT_TRUE(
      contains(error_of([&] { read(replaced(good, "float z", "float w")); }), "x, y and z"));
  EXPECT_TRUE(contains(error_of([&] { read(replaced(good, "end_header\n", "")); }),
                       "test.ply:9: the data begins without an end_header"));
  EXPECT_TRUE(contains(error_of([&] { read(replaced(good, "1 1 0", "1 l 0")); }),
                       "test.ply:12: \"l\" stands where a number must be"));
}

// How a binary file may lay out its vertices and faces.
struct Layout {
  bool big = false;
  bool wide_counts = false;    // int instead of uchar
  bool short_corners = false;  // ushort instead of int
  bool extras = false;         // colours behind the positions, a flag before, a weight behind faces
  bool doubles = false;        // coordinates
};

constexpr int kGrid = 70;  // more than one block of rows

// A sheet of squares, each of two triangles; every `quads`th square is one face of four corners.
// Both as text and as `layout` says.
std::pair<std::string, std::string> sheet(const Layout& layout, int quads, int bad_face) {
  const std::string real = layout.doubles ? "double" : "float";
  std::string vertices =
      "property " + real + " x\nproperty " + real + " y\nproperty " + real + " z\n";
  if (layout.extras) vertices += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  std::string list = std::string("property list ") + (layout.wide_counts ? "int " : "uchar ") +
                     (layout.short_corners ? "ushort" : "int") + " vertex_indices\n";
  if (layout.extras) list = "property uchar flag\n" + list + "property short weight\n";
  std::string text;
  std::string data;
  const auto put = [&](auto value) {
    text += std::to_string(value) + " ";
    data += packed(value, layout.big);
  };
  for (int i = 0; i < kGrid * kGrid; ++i) {
    for (const int v : {i % kGrid, i / kGrid, i % 7}) {
      const float quarter = 0.25F * static_cast<float>(v);
      layout.doubles ? put(static_cast<double>(quarter)) : put(quarter);
    }
    for (int k = 0; layout.extras && k < 3; ++k) put(static_cast<std::uint8_t>(i * (k + 3)));
  }
  int faces = 0;
  const auto face = [&](std::vector<int> corners) {
    if (++faces == bad_face) corners[1] = layout.short_corners ? 60000 : -5;
    if (layout.extras) put(static_cast<std::uint8_t>(9));
    const int count = static_cast<int>(corners.size());
    layout.wide_counts ? put(count) : put(static_cast<std::uint8_t>(count));
    for (const int c : corners) layout.short_corners ? put(static_cast<std::uint16_t>(c)) : put(c);
    if (layout.extras) put(static_cast<std::int16_t>(-3));
  };
  for (int i = 0; i + kGrid < kGrid * kGrid; ++i) {
    if (i % kGrid == kGrid - 1) continue;
    if (quads != 0 && i % quads == quads - 1) {
      face({i, i + 1, i + kGrid + 1, i + kGrid});
    } else {
      face({i, i + 1, i + kGrid});
      face({i + 1, i + kGrid + 1, i + kGrid});
    }
  }
  const std::string rest = " 1.0\nelement vertex " + std::to_string(kGrid * kGrid) + "\n" +
                           vertices + "element face " + std::to_string(faces) + "\n" + list +
                           "end_header\n";
  const std::string format = layout.big ? "binary_big_endian" : "binary_little_endian";
  return {"ply\nformat ascii" + rest + text, "ply\nformat " + format + rest + data};
}

void expect_same(const Model& a, const Model& b) {
  EXPECT_EQ(a.mesh.positions, b.mesh.positions);
  EXPECT_EQ(a.mesh.colors, b.mesh.colors);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.mesh.material_of, b.mesh.material_of);
  EXPECT_EQ(a.warnings.messages, b.warnings.messages);
}

// Rows read at once against the same numbers read one by one.
TEST(PlyReader, EveryLayoutGivesWhatTextGives) {
  for (int bits = 0; bits < 32; ++bits) {
    const Layout layout{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0,
                        (bits & 16) != 0};
    for (const int quads : {0, 1000, 3}) {
      for (const int bad_face : {0, 5000}) {
        const auto [text, binary] = sheet(layout, quads, bad_face);
        const Model model = read(binary);
        const std::size_t dropped = bad_face == 0 ? 0 : 1;
        ASSERT_GE(model.mesh.triangles.size() + 2 * dropped, 2U * (kGrid - 1) * (kGrid - 1));
        EXPECT_EQ(warns(model, "face 4999: "), dropped == 1) << bits << " " << quads;
        expect_same(read(text), model);
      }
    }
  }
}

TEST(PlyReader, TruncationIsTheSameErrorInABlockOfRows) {
  const std::string whole = sheet({}, 0, 0).second;
  // The last face has 12 bytes of corners behind its length.
  const std::string face_cut = error_of([&] { read(whole.substr(0, whole.size() - 5)); });
  EXPECT_TRUE(
      contains(face_cut, "at byte " + std::to_string(whole.size() - 12) + ": a list in the data"))
      << face_cut;
}

}  // namespace
}  // namespace encore::scene
