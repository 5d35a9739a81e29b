#include "app/bench/bench_scene.h"

#include "app/bench/random.h"
#include "app/exit_code.h"
#include "scene/scene_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

namespace encore::app::bench {

namespace {

constexpr std::size_t kSoupTriangles = 1'000'000;
constexpr std::uint64_t kSoupSeed = 1;
constexpr float kSoupSide = 27.0F;
constexpr std::uint64_t kMostParts = 4096;
constexpr std::uint64_t kMostTriangles = 1U << 27U;

std::uint64_t parse_count(std::string_view text, std::string_view argument) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 1 ||
      value > kMostTriangles) {
    throw UsageError(
        fmt::format("'{}': '{}' is no number of 1 to {}", argument, text, kMostTriangles));
  }
  return value;
}

bool is_power_of_four(std::uint64_t n) {
  while (n > 1 && n % 4 == 0) n /= 4;
  return n == 1;
}

scene::Triangle sheared(const scene::Triangle& t, const scene::Bounds& bounds) {
  const glm::vec3 size = bounds.size();
  const float step = 1e-3F * (size.x + size.y + size.z);
  const auto move = [&](const glm::vec3& v) {
    const glm::vec3 from_middle = v - bounds.center();
    return v + step + 1e-3F * glm::vec3(from_middle.y, from_middle.z, from_middle.x);
  };
  scene::Triangle result = t;
  result.v0 = move(t.v0);
  result.v1 = move(t.v1);
  result.v2 = move(t.v2);
  return result;
}

/// Without the parts that subdivision makes.
BenchScene load_whole(std::string_view name) {
  BenchScene result;
  if (name == "soup" || name.starts_with("soup:")) {
    const std::size_t count = name == "soup" ? kSoupTriangles : parse_count(name.substr(5), name);
    result.triangles = triangle_soup(count, kSoupSeed);
    return result;
  }
  const scene::Scene scene = scene::load_scene(std::string(name));
  scene::TriangleList list;
  scene::update_triangles(scene, 0.0, list);
  result.triangles = std::move(list.triangles);
  result.camera = scene.camera;
  return result;
}

}  // namespace

std::vector<scene::Triangle> split_in_four(const std::vector<scene::Triangle>& triangles) {
  std::vector<scene::Triangle> parts;
  parts.reserve(4 * triangles.size());
  for (const scene::Triangle& t : triangles) {
    const glm::vec3 a = 0.5F * t.v0 + 0.5F * t.v1;
    const glm::vec3 b = 0.5F * t.v1 + 0.5F * t.v2;
    const glm::vec3 c = 0.5F * t.v2 + 0.5F * t.v0;
    parts.push_back(scene::make_triangle(t.v0, a, c, t.material));
    parts.push_back(scene::make_triangle(a, t.v1, b, t.material));
    parts.push_back(scene::make_triangle(c, b, t.v2, t.material));
    parts.push_back(scene::make_triangle(a, b, c, t.material));
  }
  return parts;
}

std::vector<scene::Triangle> triangle_soup(std::size_t count, std::uint64_t seed) {
  // As large as their distance: rays meet a few of them before they are through.
  const float reach = kSoupSide / std::cbrt(static_cast<float>(count));
  std::vector<scene::Triangle> soup;
  soup.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto random = [&](std::uint64_t k) { return random_unit(seed, 16 * i + k) - 0.5F; };
    const glm::vec3 center = kSoupSide * glm::vec3(random(0), random(1), random(2));
    const auto corner = [&](std::uint64_t k) {
      return center + reach * glm::vec3(random(k), random(k + 1), random(k + 2));
    };
    soup.push_back(scene::make_triangle(corner(3), corner(6), corner(9)));
  }
  return soup;
}

BenchScene load_bench_scene(const std::string& argument, std::uint64_t subdivide) {
  std::string_view name = argument;
  std::uint64_t parts = subdivide;
  if (const std::size_t at = name.rfind('@'); at != std::string_view::npos) {
    parts *= parse_count(name.substr(at + 1), argument);
    name = name.substr(0, at);
  }
  if (!is_power_of_four(parts) || parts > kMostParts) {
    throw UsageError(
        fmt::format("'{}': triangles are split into 4, 16, 64 … {} parts", argument, kMostParts));
  }
  BenchScene result = load_whole(name);
  if (result.triangles.size() * parts > kMostTriangles) {
    throw UsageError(fmt::format("'{}': more than {} triangles", argument, kMostTriangles));
  }
  for (std::uint64_t n = parts; n > 1; n /= 4) result.triangles = split_in_four(result.triangles);
  const std::string file(name.substr(name.rfind('/') + 1));
  result.name = parts > 1 ? fmt::format("{}@{}", file, parts) : file;
  scene::Bounds bounds;
  for (const scene::Triangle& t : result.triangles) bounds.extend(scene::bounds_of(t));
  result.moved.reserve(result.triangles.size());
  for (const scene::Triangle& t : result.triangles) result.moved.push_back(sheared(t, bounds));
  return result;
}

std::vector<std::string> default_bench_scenes() {
  return {"toys", "bunny", "bunny@16", "hall", "soup"};
}

}  // namespace encore::app::bench
