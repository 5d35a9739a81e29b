// encore_feature_cost: what the features that a scene does not use cost it. Draws a plain scene
// (one light or more, diffuse colours; no shading normals, vertex colours, highlights, textures or
// further rays) either with renderer::CpuTracer, or with a tracer that never had those features:
// camera rays, batches through the structure, diffuse light on geometric normals, a loop over
// tiles, and no more, below. scripts/feature-cost.sh counts the instructions of both with
// callgrind, inside encore_frame() only.
#include "accel/acceleration_structure.h"
#include "accel/make_structure.h"
#include "renderer/cpu_tracer.h"
#include "scene/camera_basis.h"
#include "scene/sample_scenes.h"
#include "scene/scene_file.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <malloc.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace encore::bench {
namespace {

constexpr int kTileSide = 16;
constexpr std::size_t kTilePixels = std::size_t{kTileSide} * kTileSide;

/// A scene of diffuse surfaces that stands still, and a structure over it.
struct PlainScene {
  scene::Scene scene;
  scene::TriangleList list;
  std::unique_ptr<accel::AccelerationStructure> structure;
};

/// Takes from a scene all that is more than plain.
PlainScene load_plain_scene(const std::string& name, accel::StructureKind kind) {
  PlainScene plain;
  plain.scene = scene::load_scene(name);
  for (scene::Material& material : plain.scene.materials) {
    material.specular = glm::vec3(0.0F);
    material.diffuse_texture = nullptr;
    material.opacity = 1.0F;
    material.reflectivity = 0.0F;
  }
  scene::update_triangles(plain.scene, 0.0, plain.list);
  plain.list.normals = {};
  plain.list.colors = {};
  plain.list.texcoords = {};
  if (plain.scene.lights.empty()) plain.scene.lights.emplace_back();
  plain.structure = accel::make_structure(accel::default_spec(kind));
  plain.structure->build(plain.list.triangles);
  return plain;
}

/// The tracer without the features.
class PlainTracer {
 public:
  explicit PlainTracer(const PlainScene& plain) : plain_(plain) {}

  void render(const scene::Camera& camera, renderer::Image& image) {
    const View view(camera, image);
    hits_.store(0, std::memory_order_relaxed);
    const int columns = (image.width + kTileSide - 1) / kTileSide;
    const int rows = (image.height + kTileSide - 1) / kTileSide;
    for (int index = 0; index < columns * rows; ++index) {
      const int x = index % columns * kTileSide;
      const int y = index / columns * kTileSide;
      draw_tile(view, x, y, std::min(x + kTileSide, image.width),
                std::min(y + kTileSide, image.height), image);
    }
  }

 private:
  struct View {
    View(const scene::Camera& camera, const renderer::Image& image) : origin(camera.eye) {
      const scene::CameraBasis basis = scene::camera_basis(camera);
      const double pixel = 2.0 * scene::half_height_at_one(camera) / image.height;
      forward = basis.forward;
      right = basis.right * pixel;
      up = basis.up * pixel;
      center_x = 0.5 * image.width;
      center_y = 0.5 * image.height;
    }
    glm::vec3 origin;
    glm::dvec3 forward{0.0};
    glm::dvec3 right{0.0};
    glm::dvec3 up{0.0};
    double center_x = 0.0;
    double center_y = 0.0;
  };

  void draw_tile(const View& view, int x0, int y0, int x1, int y1, renderer::Image& image) {
    std::array<scene::Ray, kTilePixels> ray_store;
    std::array<scene::Hit, kTilePixels> hit_store;
    std::size_t count = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const glm::dvec3 row = view.forward + (view.center_y - (y + 0.5)) * view.up;
        const glm::dvec3 along = row + ((x + 0.5) - view.center_x) * view.right;
        const double scale = 1.0 / std::sqrt(glm::dot(along, along));
        ray_store[count++] =
            scene::Ray{.origin = view.origin, .direction = glm::vec3(along * scale)};
      }
    }
    const auto rays = std::span(ray_store).first(count);
    const auto hits = std::span(hit_store).first(count);
    plain_.structure->intersect(rays, hits);
    std::uint64_t found = 0;
    for (const scene::Hit& hit : hits) found += hit.found() ? 1 : 0;
    hits_.fetch_add(found, std::memory_order_relaxed);
    std::size_t i = 0;
    for (int y = y0; y < y1; ++y) {
      glm::vec3* const row =
          &image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width)];
      for (int x = x0; x < x1; ++x, ++i) {
        row[x] = hits[i].found() ? shade(rays[i], hits[i]) : plain_.scene.background;
      }
    }
  }

  [[nodiscard]] glm::vec3 shade(const scene::Ray& ray, const scene::Hit& hit) const {
    static const scene::Material kMissing;
    const scene::Triangle& triangle = plain_.list.triangles[hit.triangle];
    const auto& materials = plain_.scene.materials;
    const scene::Material& material =
        triangle.material < materials.size() ? materials[triangle.material] : kMissing;
    const glm::dvec3 corner(triangle.v0);
    const glm::dvec3 edge1 = glm::dvec3(triangle.v1) - corner;
    const glm::dvec3 edge2 = glm::dvec3(triangle.v2) - corner;
    const glm::dvec3 view = -glm::dvec3(ray.direction);
    glm::dvec3 normal = glm::cross(edge1, edge2);
    if (glm::dot(normal, view) < 0.0) normal = -normal;
    const double squared = glm::dot(normal, normal);
    normal = squared > 0.0 ? normal * (1.0 / std::sqrt(squared)) : view;
    const glm::dvec3 point =
        corner + edge1 * static_cast<double>(hit.u) + edge2 * static_cast<double>(hit.v);
    glm::vec3 arrived{0.0F};
    for (const scene::Light& light : plain_.scene.lights) {
      const glm::dvec3 to_light = glm::dvec3(light.position) - point;
      const double along_normal = glm::dot(normal, to_light);
      if (!(along_normal > 0.0)) continue;
      const double inverse_distance = 1.0 / std::sqrt(glm::dot(to_light, to_light));
      arrived += light.color * static_cast<float>(along_normal * inverse_distance);
    }
    return material.emission + renderer::kAmbientLight * material.ambient +
           material.diffuse * arrived;
  }

  const PlainScene& plain_;
  std::atomic<std::uint64_t> hits_{0};
};

/// The heap that is in use.
std::size_t heap_bytes() {
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// FNV-1a over the bits of the pixels: equal pictures have equal ones.
std::uint64_t picture_hash(const renderer::Image& image) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const glm::vec3& pixel : image.pixels) {
    std::array<unsigned char, sizeof(glm::vec3)> bits{};
    std::memcpy(bits.data(), &pixel, sizeof pixel);
    for (const unsigned char byte : bits) hash = (hash ^ byte) * 0x100000001b3ULL;
  }
  return hash;
}

}  // namespace
}  // namespace encore::bench

/// What is counted. Not inlined, and with a plain name for callgrind's --toggle-collect.
extern "C" [[gnu::noinline]] void encore_frame(const std::function<void()>* draw);
extern "C" void encore_frame(const std::function<void()>* draw) {
  (*draw)();
}

namespace encore::bench {
namespace {

int number(const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 1) {
    throw std::invalid_argument("not a number above 0: '" + text + "'");
  }
  return value;
}

/// Draws two frames, the second of which is counted; prints one line of figures. `with_tracer`
/// makes a tracer and calls what it is given with it. The heap is that which the tracer holds
/// besides itself.
template <class WithTracer>
void measure(const std::string& which, const PlainScene& plain, int size, WithTracer with_tracer) {
  renderer::Image image;
  image.resize(size, size);
  // The library of threads makes itself ready when it is first asked: that is no feature of scenes.
  tbb::this_task_arena::max_concurrency();
  const std::size_t before = heap_bytes();
  std::size_t after = 0;
  std::size_t object = 0;
  with_tracer([&](auto& tracer) {
    tracer.render(plain.scene.camera, image);
    const auto once = [&] { tracer.render(plain.scene.camera, image); };
    const std::function<void()> draw = std::ref(once);
    encore_frame(&draw);
    after = heap_bytes();
    object = sizeof tracer;
  });
  fmt::print("{} heap {} object {} picture {:016x}\n", which, after - before, object,
             picture_hash(image));
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() != 4) {
    fmt::print(stderr, "usage: encore_feature_cost plain|tracer SCENE STRUCTURE SIZE\n");
    return 2;
  }
  const auto kind = accel::parse_structure_kind(arguments[2]);
  if (!kind) throw std::invalid_argument("unknown structure '" + arguments[2] + "'");
  const PlainScene plain = load_plain_scene(arguments[1], *kind);
  const int size = number(arguments[3]);
  if (arguments[0] == "plain") {
    measure("plain", plain, size, [&](auto&& draw) {
      PlainTracer tracer(plain);
      draw(tracer);
    });
  } else if (arguments[0] == "tracer") {
    measure("tracer", plain, size, [&](auto&& draw) {
      renderer::CpuTracer tracer(1);
      tracer.init({&plain.scene, &plain.list, plain.structure.get()});
      draw(tracer);
    });
  } else {
    throw std::invalid_argument("say plain or tracer, not '" + arguments[0] + "'");
  }
  return 0;
}

}  // namespace
}  // namespace encore::bench

int main(int argc, char** argv) {
  try {
    return encore::bench::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "encore_feature_cost: %s\n", error.what());
    return 1;
  }
}
