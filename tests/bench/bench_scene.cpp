#include "tests/bench/bench_scene.h"

#include "renderer/camera_rays.h"
#include "scene/sample_scenes.h"
#include "scene/scene_file.h"
#include "scene/triangles.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace encore::bench {

namespace {

constexpr float kLongestSide = 27.0F;

/// The vertices of all triangles, to be changed by `change(vertex)`.
template <class F>
void change_vertices(std::vector<scene::Triangle>& triangles, F change) {
  for (scene::Triangle& t : triangles) {
    change(t.v0);
    change(t.v1);
    change(t.v2);
  }
}

}  // namespace

BenchScene load_bench_scene(const std::string& name_or_path) {
  scene::TriangleList list;
  scene::update_triangles(scene::load_scene(name_or_path), 0.0, list);
  const scene::Bounds bounds = list.bounds();
  const glm::vec3 size = bounds.size();
  const float factor = kLongestSide / std::max({size.x, size.y, size.z, 1e-30F});

  BenchScene result;
  result.name = std::filesystem::path(name_or_path).stem().string();
  result.triangles = std::move(list.triangles);
  change_vertices(result.triangles, [&](glm::vec3& v) { v = (v - bounds.center()) * factor; });
  result.moved = result.triangles;
  change_vertices(result.moved, [](glm::vec3& v) {
    v += glm::vec3(0.01F + 0.02F * v.y, 0.01F + 0.02F * v.z, 0.01F + 0.02F * v.x);
  });

  const renderer::PixelRect image{0, 0, kImageSize, kImageSize};
  result.rays.resize(image.count());
  camera_rays(renderer::make_camera_frame(scene::Camera{}, kImageSize, kImageSize), image,
              result.rays);
  return result;
}

std::vector<std::string> default_bench_scenes() {
  std::vector<std::string> names;
  for (const double wanted : {11e3, 69e3, 203e3, 1.09e6}) {
    const auto distance = [&](const scene::SampleScene& s) {
      return std::abs(static_cast<double>(s.triangles) - wanted);
    };
    const auto& samples = scene::sample_scenes();
    const auto nearest =
        std::min_element(samples.begin(), samples.end(),
                         [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    if (nearest != samples.end()) names.push_back(nearest->name);
  }
  if (const char* models = std::getenv("ENCORE_MODELS")) {
    const auto bunny = std::filesystem::path(models) / "thesis" / "bun_zipper.ply";
    if (std::filesystem::exists(bunny)) names.push_back(bunny.string());
  }
  return names;
}

}  // namespace encore::bench
