#pragma once

#include "accel/inspect/node_table.h"
#include "accel/make_structure.h"
#include "scene/sample_scenes.h"
#include "scene/triangles.h"
#include "tests/bvh/test_scenes.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace encore::accel::test {

inline Triangles sample(std::string_view name, double time_share = 0.0) {
  const scene::Scene scene = scene::make_sample_scene(name).value();
  scene::TriangleList list;
  scene::update_triangles(scene, time_share * scene.duration_s(), list);
  return list.triangles;
}

/// Everything in one plane, in one leaf of a kd-tree: no split takes anything away.
inline Triangles stacked(std::size_t count) {
  return Triangles(count, make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
}

/// A structure, what it was built over, and its table.
struct Built {
  explicit Built(StructureKind kind, Triangles over = {})
      : triangles(std::move(over)), structure(make_structure(default_spec(kind))) {
    structure->build(triangles);
    table = NodeTable::make(*structure);
  }
  Triangles triangles;
  std::unique_ptr<AccelerationStructure> structure;
  NodeTable table;
};

/// The scenes that are hostile to structures, and two that are not.
inline std::vector<NamedTriangles> inspected_scenes() {
  std::vector<NamedTriangles> scenes = all_test_scenes();
  scenes.push_back({"toys", sample("toys")});
  scenes.push_back({"stacked", stacked(300)});
  return scenes;
}

/// Calls `check(built)` for every structure over every scene, with both names in the trace.
template <class Check>
void for_all_structures(const std::vector<NamedTriangles>& scenes, const Check& check) {
  for (const StructureKind kind : all_structure_kinds()) {
    for (const NamedTriangles& scene : scenes) {
      SCOPED_TRACE(std::string(to_string(kind)) + " over " + scene.name);
      const Built built(kind, scene.triangles);
      check(built);
    }
  }
}

}  // namespace encore::accel::test
