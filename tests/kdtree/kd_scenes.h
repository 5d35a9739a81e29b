#pragma once

#include "accel/acceleration_structure.h"
#include "accel/settings.h"
#include "scene/triangle.h"
#include "tests/support/random_triangles.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace encore::accel::kd_test {

using encore::test::Random;
using encore::test::scaled;
using scene::Triangle;

/// Triangles of about `size` in the cube [-1, 1]^3.
inline std::vector<Triangle> soup(std::size_t count, float size, std::uint32_t seed) {
  return encore::test::triangle_soup(count, size, 1.0F, seed);
}

/// A wavy height field of 2 n^2 triangles whose vertices lie on a regular lattice in x and y, so
/// that median planes run through them.
inline std::vector<Triangle> terrain(int n, float height) {
  const auto vertex = [&](int x, int y) {
    const float wave = static_cast<float>((x * 7 + y * 13) % 8) - 3.5F;
    return glm::vec3(static_cast<float>(x), static_cast<float>(y), height * wave);
  };
  std::vector<Triangle> triangles;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      triangles.push_back(
          scene::make_triangle(vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1)));
      triangles.push_back(
          scene::make_triangle(vertex(x, y), vertex(x + 1, y + 1), vertex(x, y + 1)));
    }
  }
  return triangles;
}

/// Axis-aligned rectangles: every triangle is planar, and all planes coincide with vertices.
inline std::vector<Triangle> boxes(int n) {
  std::vector<Triangle> triangles;
  const auto quad = [&](const glm::vec3& a, const glm::vec3& u, const glm::vec3& v) {
    triangles.push_back(scene::make_triangle(a, a + u, a + u + v));
    triangles.push_back(scene::make_triangle(a, a + u + v, a + v));
  };
  for (int i = 0; i < n * n * n; ++i) {
    const glm::vec3 at(static_cast<float>(i % n), static_cast<float>(i / n % n),
                       static_cast<float>(i / (n * n)));
    quad(at, {1, 0, 0}, {0, 1, 0});
    quad(at, {0, 1, 0}, {0, 0, 1});
    quad(at, {0, 0, 1}, {1, 0, 0});
  }
  return triangles;
}

struct NamedScene {
  std::string name;
  std::vector<Triangle> triangles;
};

/// Sets that kd-trees like to stumble over.
inline std::vector<NamedScene> hostile_scenes() {
  std::vector<NamedScene> scenes;
  scenes.push_back({"one", soup(1, 1.0F, 1)});
  scenes.push_back({"soup", soup(2000, 0.2F, 2)});
  scenes.push_back({"spanning", soup(300, 4.0F, 3)});
  scenes.push_back({"terrain", terrain(24, 0.25F)});
  scenes.push_back({"flat", terrain(24, 0.0F)});
  scenes.push_back({"boxes", boxes(6)});
  scenes.push_back({"identical", std::vector<Triangle>(200, soup(1, 1.0F, 4)[0])});

  NamedScene twice{"twice", soup(500, 0.3F, 5)};
  for (int i = 499; i >= 0; --i)
    twice.triangles.push_back(twice.triangles[static_cast<unsigned>(i)]);
  scenes.push_back(twice);

  NamedScene centred{"same-centre", {}};
  Random random(6);
  for (int i = 0; i < 400; ++i) {
    const glm::vec3 a = random.point(1.0F);
    centred.triangles.push_back(
        scene::make_triangle(a, {a.y, a.z, a.x}, -a - glm::vec3(a.y, a.z, a.x)));
  }
  scenes.push_back(centred);

  NamedScene needles{"needles", {}};
  for (int i = 0; i < 600; ++i) {
    const glm::vec3 a = random.point(1.0F);
    const glm::vec3 b = random.point(1.0F);
    needles.triangles.push_back(scene::make_triangle(a, b, b + random.point(1e-5F)));
  }
  scenes.push_back(needles);

  NamedScene degenerate{"degenerate", soup(100, 0.3F, 7)};
  for (int i = 0; i < 100; ++i) {
    const glm::vec3 a = random.point(1.0F);
    const glm::vec3 b = random.point(1.0F);
    degenerate.triangles.push_back(scene::make_triangle(a, a, a));
    degenerate.triangles.push_back(scene::make_triangle(a, b, a));
  }
  scenes.push_back(degenerate);

  // Most triangles in a millionth of the box, some outliers, one that covers everything.
  NamedScene uneven{"uneven", soup(1500, 0.2F, 8)};
  for (Triangle& t : uneven.triangles) {
    for (glm::vec3* v : {&t.v0, &t.v1, &t.v2}) *v = *v * 0x1p-10F + glm::vec3(3.0F, 5.0F, -2.0F);
  }
  for (const Triangle& t : soup(20, 0.2F, 9)) {
    uneven.triangles.push_back(scene::make_triangle(t.v0 * 10.0F, t.v1 * 10.0F, t.v2 * 10.0F));
  }
  uneven.triangles.push_back(scene::make_triangle({-10, -10, -9}, {10, -10, -9}, {0, 10, 9}));
  scenes.push_back(uneven);
  return scenes;
}

/// Both builders, and how their tests are named.
inline const auto kKinds = testing::Values(StructureKind::kd_median, StructureKind::kd_sah);
inline std::string kind_name(const testing::TestParamInfo<StructureKind>& kind) {
  return kind.param == StructureKind::kd_sah ? "sah" : "median";
}

/// All nodes of a tree, depth first.
inline std::vector<NodeView> nodes_of(const AccelerationStructure& tree) {
  std::vector<NodeView> nodes;
  tree.visit([&](const NodeView& node) {
    nodes.push_back(node);
    return true;
  });
  return nodes;
}

}  // namespace encore::accel::kd_test
