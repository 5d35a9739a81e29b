// Trees of bvh-sah are what wide_tree.h says, whatever the triangles, preset, threads and
// instruction set.
#include "accel/bvh/bvh.h"
#include "accel/memory_bound.h"
#include "cases.h"
#include "check_wide_tree.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace encore::accel::test {
namespace {

constexpr BuildPreset kPresets[] = {BuildPreset::fast, BuildPreset::balanced, BuildPreset::best};

std::string name_of(BuildPreset preset, const std::string& scene) {
  return std::string(to_string(preset)) + ", " + scene;
}

/// A small dense ball in a hall of long triangles.
Triangles ball_in_a_hall(std::uint32_t count, float size) {
  Triangles triangles = encore::test::scaled(stability::ball(count, glm::vec3(0.0F), 1.0F),
                                             glm::vec3(size), glm::vec3(3, 2, 1));
  for (int i = 0; i < 60; ++i) {
    const glm::vec3 at(static_cast<float>(i % 12) * 10 - 60, -50, static_cast<float>(i) - 30);
    triangles.push_back(
        scene::make_triangle(at, at + glm::vec3(9, 100, 5), at + glm::vec3(1, 0, 0)));
  }
  return triangles;
}

std::vector<Case> large_cases() {
  return {{"ball", stability::ball(30000, glm::vec3(0.0F), 1.0F)},
          {"soup", encore::test::triangle_soup(40000, 0.05F, 1.0F, 3)},
          {"hall", ball_in_a_hall(20000, 0.01F)},
          {"a hall of another size", ball_in_a_hall(20000, 0x1p-20F)},
          {"all equal", Triangles(9000, scene::make_triangle({0, 0, 0}, {1, 0, 2}, {0, 1, 3}))},
          {"flat", encore::test::scaled(encore::test::triangle_soup(9000, 0.05F, 1.0F, 4),
                                        glm::vec3(1, 0, 1))},
          {"a line", encore::test::scaled(encore::test::triangle_soup(9000, 0.05F, 1.0F, 5),
                                          glm::vec3(1, 0, 0))},
          {"one a level", stability::one_a_level(6000)},
          {"as large as can be",
           encore::test::scaled(encore::test::triangle_soup(9000, 0.05F, 0.9F, 6), 0x1p126F)},
          {"below the normal range",
           encore::test::scaled(encore::test::triangle_soup(9000, 0.05F, 0.9F, 7), 0x1p-135F)}};
}

TEST(WideBuild, TreesAreSound) {
  for (const BuildPreset preset : kPresets) {
    for (const auto& cases : {hard_cases(), large_cases()}) {
      for (const Case& scene : cases) {
        SCOPED_TRACE(name_of(preset, scene.name));
        const BuiltTree built(scene.triangles, preset);
        expect_sound(built.tree, scene.triangles, preset == BuildPreset::best);
      }
    }
  }
}

TEST(WideBuild, EverySmallNumberOfTriangles) {
  for (const BuildPreset preset : kPresets) {
    for (std::size_t count = 1; count < 80; ++count) {
      SCOPED_TRACE(name_of(preset, std::to_string(count)));
      const Triangles triangles = encore::test::triangle_soup(count, 0.1F, 1.0F, 11);
      const BuiltTree built(triangles, preset);
      expect_sound(built.tree, triangles, preset == BuildPreset::best);
    }
  }
}

TEST(WideBuild, ThreadsAndInstructionSetsMakeNoDifference) {
  for (const BuildPreset preset : kPresets) {
    for (const Case& scene : large_cases()) {
      SCOPED_TRACE(name_of(preset, scene.name));
      const BuiltTree one(scene.triangles, preset);
      for (const int threads : {2, 3}) {
        EXPECT_TRUE(same(one.tree, BuiltTree(scene.triangles, preset, threads).tree)) << threads;
      }
      for (const Isa isa : available_isas()) {
        BuiltTree other({}, preset);
        other.builder.set_isa(isa);
        other.build(scene.triangles, preset);
        EXPECT_TRUE(same(one.tree, other.tree)) << to_string(isa);
      }
    }
  }
}

/// Nodes of the root's level and the two below it whose children are not in the order of
/// order_wide_children().
std::size_t out_of_order(const WideTree& tree, std::uint32_t index, std::uint32_t depth) {
  const gpu::WideNode& node = tree.nodes[index];
  std::size_t wrong = 0;
  for (std::uint32_t k = 0; k < WideTree::kWidth && node.child[k] != WideChild::kNoChild; ++k) {
    const bool leaf = WideChild::is_leaf(node.child[k]);
    if (!leaf && depth < 2) wrong += out_of_order(tree, node.child[k], depth + 1);
    if (k == 0) continue;
    const bool leaf_before = WideChild::is_leaf(node.child[k - 1]);
    const double area = child_bounds(node, k).area();
    const double area_before = child_bounds(node, k - 1).area();
    const bool fine = leaf == leaf_before ? area_before <= area : leaf;
    wrong += fine ? 0 : 1;
  }
  return wrong;
}

TEST(WideBuild, RaysThatTakeAnyHitMeetWhatHidesMuchFirst) {
  for (const BuildPreset preset : kPresets) {
    for (const Case& scene : large_cases()) {
      SCOPED_TRACE(name_of(preset, scene.name));
      EXPECT_EQ(out_of_order(BuiltTree(scene.triangles, preset).tree, 0, 0), 0U);
    }
  }
}

/// How many leaves have so many blocks.
std::array<std::size_t, WideChild::kMostLeafBlocks + 1> leaves_by_blocks(const WideTree& tree) {
  std::array<std::size_t, WideChild::kMostLeafBlocks + 1> leaves{};
  for (const gpu::WideNode& node : tree.nodes.span()) {
    for (const std::uint32_t child : node.child) {
      if (child == WideChild::kNoChild || !WideChild::is_leaf(child)) continue;
      ++leaves[WideChild::blocks(child)];
    }
  }
  return leaves;
}

TEST(WideBuild, BlocksAreWellFilledAndNodesHold) {
  for (const BuildPreset preset : kPresets) {
    for (const Case& scene : large_cases()) {
      SCOPED_TRACE(name_of(preset, scene.name));
      const BuiltTree built(scene.triangles, preset);
      const auto leaves = leaves_by_blocks(built.tree);
      EXPECT_EQ(leaves[1] + leaves[2], built.tree.leaves);
      // On a line every box has no area, and so all planes cost the same.
      if (preset == BuildPreset::fast || scene.name != "a line") {
        EXPECT_GE(double(built.tree.references), 3.2 * double(built.tree.blocks.size()));
      }
      // Each of at least nine references but the root.
      EXPECT_LE(built.tree.nodes.size(), built.tree.references / 7 + 1);
      if (scene.name == "ball") {
        EXPECT_GT(leaves[2], leaves[1] / 100);
      }
    }
  }
}

TEST(WideBuild, StaysWithinTheBoundOfMemory) {
  for (const BuildPreset preset : kPresets) {
    for (const auto& cases : {hard_cases(), large_cases()}) {
      for (const Case& scene : cases) {
        const BuiltTree built(scene.triangles, preset);
        const std::size_t bytes = built.tree.nodes.bytes().size() +
                                  built.tree.blocks.bytes().size() + built.tree.ids.bytes().size();
        EXPECT_LE(bytes, most_wide_bytes(preset, scene.triangles.size()))
            << name_of(preset, scene.name);
      }
    }
  }
}

TEST(WideBuild, SecondBuildOfAPoolAllocatesNothing) {
  for (const BuildPreset preset : kPresets) {
    for (const Case& scene : large_cases()) {
      for (const int threads : {1, 2}) {
        BuiltTree built(scene.triangles, preset, threads, MemoryMode::pool);
        EXPECT_GT(built.allocations.requests, 0U);
        built.build(scene.triangles, preset, threads);
        EXPECT_EQ(built.allocations.requests, 0U) << name_of(preset, scene.name);
      }
    }
  }
}

TEST(WideBuild, ACancelledBuildEndsAndTheNextIsWhole) {
  const Triangles triangles = stability::ball(20000, glm::vec3(0.0F), 1.0F);
  for (const BuildPreset preset : kPresets) {
    for (const int threads : {1, 2}) {
      BuiltTree built({}, preset, 1, MemoryMode::pool);
      BuildWatch watch;
      Workers workers(threads);
      const auto build = [&](std::uint64_t last_look) {
        watch.last_look = last_look;
        BuildMeter meter(&watch);
        workers.run([&] {
          built.builder.build(triangles, preset, workers, meter, built.tree, built.allocations);
        });
      };
      for (const std::uint64_t look : {1, 3, 6}) EXPECT_THROW(build(look), BuildCancelled);
      build(~std::uint64_t{0});
      EXPECT_GE(watch.looks, 6U);
      expect_sound(built.tree, triangles, preset == BuildPreset::best);
    }
  }
}

/// Long triangles across many small ones: boxes that are nearly empty.
Triangles beams(std::size_t small) {
  encore::test::Random random(31);
  Triangles triangles = encore::test::triangle_soup(small, 0.01F, 1.0F, 32);
  for (std::size_t i = 0; i < small / 50; ++i) {
    const glm::vec3 at = random.point(1.0F), end = random.point(1.0F);
    triangles.push_back(scene::make_triangle(at, end, at + random.point(0.01F)));
  }
  return triangles;
}

TEST(WideBuild, BetterPresetsMakeCheaperTrees) {
  const std::vector<Case> cases = {{"ball", stability::ball(30000, glm::vec3(0.0F), 1.0F)},
                                   {"soup", encore::test::triangle_soup(40000, 0.05F, 1.0F, 3)},
                                   {"beams", beams(20000)}};
  for (const Case& scene : cases) {
    const double fast = cost_of(BuiltTree(scene.triangles, BuildPreset::fast).tree);
    const double balanced = cost_of(BuiltTree(scene.triangles, BuildPreset::balanced).tree);
    const double best = cost_of(BuiltTree(scene.triangles, BuildPreset::best).tree);
    EXPECT_LE(balanced, 0.99 * fast) << scene.name;
    EXPECT_LE(fast, 1.7 * balanced) << scene.name;
    EXPECT_LE(best, (scene.name == "beams" ? 0.9 : 1.01) * balanced) << scene.name;
  }
}

TEST(WideBuild, BestSplitsLongTrianglesWithinItsLimit) {
  const Triangles long_ones = beams(10000);
  const BuiltTree split(long_ones, BuildPreset::best);
  EXPECT_GT(split.tree.references, long_ones.size());
  EXPECT_LE(split.tree.references, long_ones.size() * 3 / 2);
  expect_sound(split.tree, long_ones, true);
  // Where coordinates are out of all proportion triangles stay whole.
  const Triangles huge = encore::test::scaled(long_ones, 0x1p50F);
  const BuiltTree whole(huge, BuildPreset::best);
  EXPECT_EQ(whole.tree.references, huge.size());
  expect_sound(whole.tree, huge);
}

TEST(WideBuild, ATinyObjectInAHallIsBuiltAsIfAlone) {
  const Triangles ball = stability::ball(20000, glm::vec3(0.0F), 1.0F);
  const double alone = cost_of(BuiltTree(ball, BuildPreset::fast).tree);
  Triangles hall = encore::test::scaled(ball, glm::vec3(0x1p-12F));
  hall.push_back(scene::make_triangle({-50, -50, -50}, {50, -50, -50}, {0, 50, -50}));
  hall.push_back(scene::make_triangle({-50, -50, 50}, {50, -50, 50}, {0, 50, 50}));
  const BuiltTree built(hall, BuildPreset::fast);
  // Below the one node that has the ball's box.
  const double size = 2.0 * 0x1p-12;
  double sum = 0.0;
  for (const gpu::WideNode& node : built.tree.nodes.span()) {
    for (std::uint32_t k = 0; k < WideTree::kWidth; ++k) {
      if (node.child[k] == WideChild::kNoChild) continue;
      const double area = child_bounds(node, k).area();
      if (area < 6.1 * size * size) sum += area / (6.0 * size * size);
    }
  }
  EXPECT_LE(sum, 1.5 * alone + 2.0);
}

}  // namespace
}  // namespace encore::accel::test
