#pragma once

#include "scene/scene.h"
#include "scene/triangles.h"

#include <cstdint>
#include <string>
#include <vector>

namespace encore::app::bench {

/// What is built over and looked at.
struct BenchScene {
  std::string name;
  std::vector<scene::Triangle> triangles;
  std::vector<scene::Triangle> moved;  ///< the same, sheared a little: every vertex differs
  scene::Camera camera;
};

/// Loads what the command line names: anything that scene::load_scene() takes, or "soup" for a
/// seeded million of small triangles without any order, or "soup:COUNT". "@4", "@16" … behind it:
/// every triangle split into that many, in its own plane; `subdivide` does the same to all.
/// Throws UsageError for a number that is no power of 4, scene::InputError.
BenchScene load_bench_scene(const std::string& argument, std::uint64_t subdivide = 1);

/// What is measured if no scene is named: about 11 k, 69 k and 1.1 M triangles, a hall of very
/// uneven ones, and a soup.
std::vector<std::string> default_bench_scenes();

/// Splits every triangle into four at the middles of its edges.
std::vector<scene::Triangle> split_in_four(const std::vector<scene::Triangle>& triangles);

/// `count` small triangles at random places of a cube of 27 units; the same for the same seed.
std::vector<scene::Triangle> triangle_soup(std::size_t count, std::uint64_t seed);

}  // namespace encore::app::bench
