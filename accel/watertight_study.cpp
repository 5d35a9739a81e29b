#include "accel/watertight_study.h"

#include "accel/triangle_watertight.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace encore::accel {

namespace {

constexpr std::size_t kBatch = 2048;
// Every so many batches, the tests of one batch's first rays are looked at one by one.
constexpr std::uint64_t kSampledRays = 64;
constexpr std::uint64_t kBatchesPerSample = 16;

/// Random numbers that are the same everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// In [0, 1), a multiple of 2^-24.
  float unit() { return static_cast<float>(engine_() >> 40) * 0x1p-24F; }
  std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(engine_() % count); }
  /// In a shell between two radii.
  glm::vec3 point(float inner, float outer) {
    for (;;) {
      const glm::vec3 d{2 * unit() - 1, 2 * unit() - 1, 2 * unit() - 1};
      const float length = glm::length(d);
      if (length > 0.01F && length < 1.0F) {
        return d * ((inner + (outer - inner) * unit()) / length);
      }
    }
  }

 private:
  std::mt19937_64 engine_;
};

/// The triangles around each edge and each vertex of a closed mesh.
class Neighbours {
 public:
  explicit Neighbours(std::span<const Triangle> triangles) : triangles_(triangles) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const glm::vec3 corners[3] = {triangles[t].v0, triangles[t].v1, triangles[t].v2};
      for (const glm::vec3& corner : corners) corners_.push_back({key(corner), t});
    }
    std::sort(corners_.begin(), corners_.end());
  }
  /// Calls `visit` with every triangle that has this very corner.
  template <class Visit>
  void around(const glm::vec3& corner, const Visit& visit) const {
    const Key wanted = key(corner);
    auto at = std::lower_bound(corners_.begin(), corners_.end(), std::pair{wanted, 0U});
    for (; at != corners_.end() && at->first == wanted; ++at) visit(at->second);
  }

 private:
  using Key = std::array<float, 3>;
  // Either zero is the same place.
  static Key key(const glm::vec3& p) { return {p.x + 0.0F, p.y + 0.0F, p.z + 0.0F}; }

  std::span<const Triangle> triangles_;
  std::vector<std::pair<Key, std::uint32_t>> corners_;
};

/// A ray and the corner that all triangles around its target share.
struct AimedRay {
  Ray ray;
  glm::vec3 corner;
  bool from_inside = false;
};

AimedRay aim(const WatertightCase& mesh, Random& random, bool from_inside) {
  const Triangle& t = mesh.triangles[random.below(mesh.triangles.size())];
  const glm::vec3 corners[3] = {t.v0, t.v1, t.v2};
  const std::uint32_t first = random.below(3);
  const glm::vec3 a = corners[first];
  const glm::vec3 b = corners[(first + 1) % 3];
  const float share = random.below(2) == 0 ? 0.0F : random.unit();
  const glm::vec3 target = a + share * (b - a);
  AimedRay aimed;
  aimed.corner = a;
  aimed.from_inside = from_inside;
  aimed.ray.origin =
      mesh.center + (from_inside ? random.point(0.0F, 0.9F * mesh.clearance)
                                 : random.point(1.2F * mesh.radius, 4.0F * mesh.radius));
  aimed.ray.direction = target - aimed.ray.origin;
  return aimed;
}

/// What is asked of a structure in one go, and what it answers.
struct Batch {
  std::vector<AimedRay> aimed;
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  std::vector<std::uint8_t> blocked;

  void trace(const AccelerationStructure& structure) {
    rays.clear();
    for (const AimedRay& a : aimed) rays.push_back(a.ray);
    hits.resize(rays.size());
    blocked.resize(rays.size());
    structure.intersect(rays, hits);
    structure.occluded(rays, blocked);
  }
};

bool certainly_hit(const AimedRay& aimed, const WatertightCase& mesh,
                   const Neighbours& neighbours) {
  if (aimed.from_inside) return true;
  Hit hit{.t = aimed.ray.t_max};
  neighbours.around(aimed.corner,
                    [&](std::uint32_t t) { decide_hit(aimed.ray, mesh.triangles[t], t, hit); });
  return hit.found();
}

bool truly_there(const Ray& ray, const WatertightCase& mesh, const Hit& hit) {
  Hit truth{.t = ray.t_max};
  return decide_hit(ray, mesh.triangles[hit.triangle], hit.triangle, truth) &&
         std::fabs(truth.t - hit.t) <= 0x1p-14F * truth.t;
}

void judge(const Batch& batch, const WatertightCase& mesh, const Neighbours& neighbours,
           WatertightCounts& counts) {
  for (std::size_t i = 0; i < batch.rays.size(); ++i) {
    const Hit& hit = batch.hits[i];
    const std::uint64_t before = counts.wrong();
    ++counts.rays;
    counts.from_inside += batch.aimed[i].from_inside ? 1 : 0;
    if (hit.found()) {
      ++counts.hits;
      if (!truly_there(batch.rays[i], mesh, hit)) ++counts.invented;
    } else if (certainly_hit(batch.aimed[i], mesh, neighbours)) {
      ++counts.missed;
    }
    if ((batch.blocked[i] != 0) != hit.found()) ++counts.wrong_occlusion;
    if (before == 0 && counts.wrong() > 0) counts.first_wrong = batch.rays[i];
  }
}

void sample_doubts(const AccelerationStructure& structure, const WatertightCase& mesh,
                   std::span<const Ray> rays, WatertightCounts& counts) {
  RayPath path;
  Hit hit;
  for (const Ray& ray : rays) {
    structure.trace_path(ray, hit, path);
    const WatertightTester tester(ray);
    for (const RayStep& step : path.steps) {
      if (step.event != RayStep::Event::triangle) continue;
      ++counts.sampled_tests;
      if (tester.doubtful(mesh.triangles[step.triangle])) ++counts.sampled_doubts;
    }
  }
}

}  // namespace

WatertightCounts& WatertightCounts::operator+=(const WatertightCounts& other) {
  if (wrong() == 0 && other.wrong() > 0) first_wrong = other.first_wrong;
  rays += other.rays;
  from_inside += other.from_inside;
  hits += other.hits;
  missed += other.missed;
  invented += other.invented;
  wrong_occlusion += other.wrong_occlusion;
  sampled_tests += other.sampled_tests;
  sampled_doubts += other.sampled_doubts;
  return *this;
}

WatertightCounts run_watertight_case(const AccelerationStructure& structure,
                                     const WatertightCase& mesh, std::uint64_t rays,
                                     std::uint64_t seed) {
  WatertightCounts counts;
  if (mesh.triangles.empty()) return counts;
  Random random(seed);
  const Neighbours neighbours(mesh.triangles);
  Batch batch;
  for (std::uint64_t done = 0, number = 0; done < rays; done += batch.rays.size(), ++number) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(kBatch, rays - done));
    batch.aimed.clear();
    for (std::size_t i = 0; i < count; ++i) {
      batch.aimed.push_back(aim(mesh, random, (done + i) % 2 == 0));
    }
    batch.trace(structure);
    judge(batch, mesh, neighbours, counts);
    if (number % kBatchesPerSample == 0) {
      const std::size_t sampled = std::min<std::size_t>(kSampledRays, count);
      sample_doubts(structure, mesh, std::span(batch.rays).first(sampled), counts);
    }
  }
  return counts;
}

}  // namespace encore::accel
