#include "app/verification.h"

#include "accel/brute_force.h"
#include "accel/make_structure.h"
#include "accel/parallel.h"
#include "accel/test_rays.h"
#include "app/interrupt.h"
#include "renderer/camera_rays.h"

#include <algorithm>
#include <cmath>

namespace encore::app {

namespace {

/// A named set of rays to compare.
struct RaySet {
  std::string name;
  std::vector<scene::Ray> rays;
};

std::vector<scene::Ray> camera_view(const scene::Camera& camera, std::size_t count) {
  const int side = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(count))));
  std::vector<scene::Ray> rays(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  const renderer::CameraFrame frame = renderer::make_camera_frame(camera, side, side);
  renderer::camera_rays(frame, {0, 0, side, side}, rays);
  return rays;
}

class SceneVerifier {
 public:
  SceneVerifier(const scene::Scene& scene, const VerificationPlan& plan)
      : scene_(scene), plan_(plan) {}

  /// Rays for `structure`, fewer the more triangles the reference has to test.
  std::vector<RaySet> ray_sets(const accel::AccelerationStructure& structure,
                               std::span<const scene::Triangle> triangles, double share) const {
    // At least a hundred rays of each kind, unless fewer were asked for.
    const double affordable =
        share * plan_.reference_tests / std::max<double>(1.0, double(triangles.size()));
    const auto ray_count = [&](double rays) {
      return std::min(plan_.rays_per_kind, static_cast<std::size_t>(std::max(rays, 100.0)));
    };
    std::vector<RaySet> sets{{"camera", camera_view(scene_.camera, ray_count(affordable))}};
    for (const accel::RayKind kind : accel::all_ray_kinds()) {
      // From far away the reference's single-precision filter lets everything pass: ten times the
      // cost.
      const std::size_t count =
          ray_count(kind == accel::RayKind::far ? affordable / 10 : affordable);
      sets.push_back({std::string(accel::to_string(kind)),
                      accel::test_rays(kind, count, plan_.seed, triangles, structure)});
    }
    return sets;
  }

  /// Applies `compare` to slices of every set on all threads and sums what it returns.
  template <class Compare>
  static void compare_all(const std::vector<RaySet>& sets, VerificationRow& row,
                          const Compare& compare) {
    constexpr std::size_t kSlice = 256;
    for (const RaySet& set : sets) {
      const std::size_t slices = (set.rays.size() + kSlice - 1) / kSlice;
      std::vector<accel::OracleComparison> parts(slices);
      const auto run = [&](std::size_t begin, std::size_t end) {
        if (interrupted) return;
        parts[begin / kSlice] = compare(std::span(set.rays).subspan(begin, end - begin));
      };
      accel::Workers(0).for_parts(set.rays.size(), kSlice, run);
      for (const accel::OracleComparison& part : parts) {
        if (row.hits.mismatches() == 0 && part.hits.mismatches() > 0) row.first_kind = set.name;
        row.hits += part.hits;
        row.edge_cases += part.edge_cases;
      }
    }
  }

 private:
  const scene::Scene& scene_;
  const VerificationPlan& plan_;
};

/// Another time of the animation at which the triangles have moved but are still the same ones.
bool move_on(const scene::Scene& scene, double time_s, scene::TriangleList& list) {
  return scene.animated() && scene::update_triangles(scene, time_s + 0.37 * scene.duration_s(),
                                                     list) == scene::TriangleChange::moved;
}

}  // namespace

std::vector<VerificationRow> verify_scene(const scene::Scene& scene,
                                          const std::vector<accel::StructureSpec>& specs,
                                          const VerificationPlan& plan,
                                          const std::function<void(double)>& progress) {
  const SceneVerifier verifier(scene, plan);
  scene::TriangleList list;
  scene::update_triangles(scene, plan.time_s, list);
  std::vector<VerificationRow> rows;
  accel::BruteForce brute;
  brute.build(list.triangles);

  // The reference itself, against the exact oracle: slower, so with a tenth of the rays.
  {
    VerificationRow row{"brute", "exact oracle", "build", list.triangles.size(), {}, 0, {}};
    SceneVerifier::compare_all(verifier.ray_sets(brute, list.triangles, 0.1), row,
                               [&](std::span<const scene::Ray> rays) {
                                 return accel::compare_with_oracle(brute, list.triangles, rays);
                               });
    rows.push_back(row);
  }
  double done = 1;
  const double total = 1.0 + static_cast<double>(specs.size());
  progress(done / total);

  for (const accel::StructureSpec& spec : specs) {
    if (interrupted) break;
    scene::TriangleList moving = list;
    const auto structure = accel::make_structure(spec);
    const auto compare = [&](const std::string& action) {
      brute.build(moving.triangles);
      VerificationRow row{
          std::string(structure->name()), "brute", action, moving.triangles.size(), {}, 0, {}};
      SceneVerifier::compare_all(
          verifier.ray_sets(*structure, moving.triangles, 1.0), row,
          [&](std::span<const scene::Ray> rays) {
            return accel::OracleComparison{accel::compare_hits(*structure, brute, rays), 0};
          });
      rows.push_back(row);
    };
    structure->build(moving.triangles);
    compare("build");
    if (structure->can_refit() && move_on(scene, plan.time_s, moving)) {
      structure->update(moving.triangles);
      compare("refit");
    }
    progress(++done / total);
  }
  return rows;
}

}  // namespace encore::app
