// However hostile the triangles: memory grows no faster than their number, by a stated factor.
#include "accel/memory_bound.h"

#include "accel/make_structure.h"
#include "accel/stability_cases.h"
#include "accel/stability_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace encore::accel {
namespace {

using stability::Triangles;

struct Hostile {
  const char* name;
  Triangles triangles;
};

std::vector<Hostile> hostile_scenes(std::size_t count) {
  return {{"corner to corner", stability::corner_to_corner(count, 1)},
          {"spanning", stability::spanning(count, 2)},
          {"same centroid", stability::same_centroid(count, 3)},
          {"repeated", stability::repeated(count)},
          {"diagonal", stability::diagonal(count, 4)},
          {"one a level", stability::one_a_level(count)}};
}

class MemoryBound : public testing::TestWithParam<StructureKind> {};

TEST_P(MemoryBound, IsKeptOnHostileScenesOfEverySize) {
  const StructureSpec spec = default_spec(GetParam());
  for (const std::size_t count : {1U, 300U, 5000U, 20000U}) {
    for (const Hostile& scene : hostile_scenes(count)) {
      const auto structure = make_structure(spec);
      structure->build(scene.triangles);
      EXPECT_LE(structure->stats().bytes, most_bytes(spec, count)) << scene.name << ", " << count;
    }
  }
}

TEST_P(MemoryBound, IsAFactorOfTheNumberOfTriangles) {
  const StructureSpec spec = default_spec(GetParam());
  for (std::uint64_t count = 1; count < std::uint64_t{1} << 26; count *= 8) {
    EXPECT_LE(most_bytes(spec, count), 200 * count + (18U << 20)) << count;
  }
}

TEST_P(MemoryBound, IsKeptWithSettingsThatAskForEverything) {
  StructureSpec spec = default_spec(GetParam());
  ASSERT_EQ(apply_setting(spec, "grid.cells_per_axis", "256"), "");
  ASSERT_EQ(apply_setting(spec, "grid.most_references", "1"), "");
  ASSERT_EQ(apply_setting(spec, "kd.most_references", "2"), "");
  ASSERT_EQ(apply_setting(spec, "kd.depth_offset", "60"), "");
  ASSERT_EQ(apply_setting(spec, "kd.leaf_triangles", "1"), "");
  ASSERT_EQ(apply_setting(spec, "kd.bad_split_retries", "60"), "");
  for (const Hostile& scene : hostile_scenes(20000)) {
    const auto structure = make_structure(spec);
    structure->build(scene.triangles);
    EXPECT_LE(structure->stats().bytes, most_bytes(spec, 20000)) << scene.name;
  }
}

std::string kind_name(const testing::TestParamInfo<StructureKind>& kind) {
  std::string name(to_string(kind.param));
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Kinds, MemoryBound, testing::ValuesIn(all_structure_kinds()), kind_name);

TEST(LimitedStructures, SayThatTheyAre) {
  StructureSpec grid = default_spec(StructureKind::grid_box);
  ASSERT_EQ(apply_setting(grid, "grid.most_references", "1"), "");
  ASSERT_EQ(apply_setting(grid, "grid.cells_per_axis", "128"), "");
  StructureSpec kd = default_spec(StructureKind::kd_median);
  ASSERT_EQ(apply_setting(kd, "kd.bad_split_retries", "60"), "");
  for (const StructureSpec& spec : {grid, kd}) {
    const auto structure = make_structure(spec);
    structure->build(stability::soup(5000, 1));
    EXPECT_FALSE(structure->stats().limited) << structure->name();
    structure->build(stability::spanning(5000, 1));
    EXPECT_TRUE(structure->stats().limited) << structure->name();
    structure->build(stability::soup(5000, 1));
    EXPECT_FALSE(structure->stats().limited) << structure->name();
  }
}

// What is built last must not be what pays for it.
TEST(LimitedKdTrees, ShareTheirReferencesOutEvenly) {
  StructureSpec spec = default_spec(StructureKind::kd_median);
  ASSERT_EQ(apply_setting(spec, "kd.bad_split_retries", "60"), "");
  const auto structure = make_structure(spec);
  // The same crowd on either side of x = 0.
  Triangles triangles = stability::spanning(6000, 5);
  const std::size_t half = triangles.size();
  for (std::size_t i = 0; i < half; ++i) {
    Triangle mirrored = triangles[i];
    for (glm::vec3* v : {&triangles[i].v0, &triangles[i].v1, &triangles[i].v2}) v->x += 1.5F;
    for (glm::vec3* v : {&mirrored.v0, &mirrored.v1, &mirrored.v2}) v->x = -(v->x + 1.5F);
    triangles.push_back(mirrored);
  }
  structure->build(triangles);
  ASSERT_TRUE(structure->stats().limited);
  std::uint64_t lower = 0;
  std::uint64_t upper = 0;
  structure->visit([&](const NodeView& node) {
    if (node.leaf) (node.bounds.center().x < 0.0F ? lower : upper) += node.triangles.size();
    return true;
  });
  EXPECT_LT(lower, 2 * upper);
  EXPECT_LT(upper, 2 * lower);
  EXPECT_LT(structure->stats().largest_leaf, half / 2);
}

TEST(MostReferences, ParseAndRefuse) {
  StructureSpec grid = default_spec(StructureKind::grid_exact);
  EXPECT_EQ(apply_setting(grid, "grid.most_references", "7"), "");
  EXPECT_EQ(std::get<GridSettings>(grid.settings).most_references, 7);
  EXPECT_NE(apply_setting(grid, "grid.most_references", "0"), "");
  StructureSpec kd = default_spec(StructureKind::kd_sah);
  EXPECT_EQ(apply_setting(kd, "kd.most_references", "64"), "");
  EXPECT_EQ(std::get<KdTreeSettings>(kd.settings).most_references, 64);
  EXPECT_NE(apply_setting(kd, "kd.most_references", "1"), "");
  EXPECT_NE(apply_setting(kd, "kd.most_references", "2000"), "");
}

}  // namespace
}  // namespace encore::accel
