// A refit keeps the topology and fits every box, in place.
#include "cases.h"
#include "check_wide_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace encore::accel::test {
namespace {

Triangles moved(Triangles triangles) {
  for (scene::Triangle& t : triangles) {
    for (glm::vec3* v : {&t.v0, &t.v1, &t.v2}) {
      *v = glm::vec3(v->y, 0.5F * v->x, v->z * 0.75F) + 0.01F * glm::vec3(1, 2, 3);
    }
  }
  return triangles;
}

std::vector<std::uint32_t> children_of(const WideTree& tree) {
  std::vector<std::uint32_t> children;
  for (const gpu::WideNode& node : tree.nodes.span()) {
    children.insert(children.end(), node.child, node.child + WideTree::kWidth);
  }
  return children;
}

TEST(WideRefit, BoxesAndCornersAreThoseOfTheMovedTriangles) {
  std::vector<Case> cases = hard_cases();
  cases.push_back({"large", stability::ball(60000, glm::vec3(0.0F), 1.0F)});
  for (const BuildPreset preset : {BuildPreset::fast, BuildPreset::balanced, BuildPreset::best}) {
    for (const Case& scene : cases) {
      SCOPED_TRACE(std::string(to_string(preset)) + ", " + scene.name);
      BuiltTree built(scene.triangles, preset);
      const std::vector<std::uint32_t> children = children_of(built.tree);
      const gpu::WideNode* const nodes = built.tree.nodes.data();
      const Triangles after = moved(scene.triangles);
      built.refit(after);
      EXPECT_EQ(children_of(built.tree), children);
      EXPECT_EQ(built.tree.nodes.data(), nodes);
      expect_sound(built.tree, after, preset == BuildPreset::best);

      BuiltTree shared(scene.triangles, preset);
      shared.refit(after, 2);
      EXPECT_TRUE(same(built.tree, shared.tree));

      // Back again: nothing is left of the way there.
      built.refit(scene.triangles);
      expect_sound(built.tree, scene.triangles, preset == BuildPreset::best);
    }
  }
}

TEST(WideRefit, WithoutPartsTheBoxesAreThoseOfTheBuild) {
  const Triangles triangles = encore::test::triangle_soup(20000, 0.05F, 1.0F, 21);
  for (const BuildPreset preset : {BuildPreset::fast, BuildPreset::balanced}) {
    const BuiltTree before(triangles, preset);
    BuiltTree built(triangles, preset);
    built.refit(triangles);
    EXPECT_TRUE(same(before.tree, built.tree));
  }
}

}  // namespace
}  // namespace encore::accel::test
