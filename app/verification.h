#pragma once

#include "accel/settings.h"
#include "accel/verify.h"
#include "scene/scene.h"
#include "scene/triangles.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace encore::app {

/// How thoroughly to verify. The reference tests every triangle against every ray, so large scenes
/// get fewer rays: `reference_tests` bounds rays * triangles for each structure and ray kind.
struct VerificationPlan {
  std::size_t rays_per_kind = 20000;
  double reference_tests = 5e7;
  std::uint64_t seed = 1;
  double time_s = 0.0;
};

/// One line of the report: a structure (or `brute` against the exact oracle), all ray kinds summed.
struct VerificationRow {
  std::string structure;
  std::string against;  ///< "exact oracle" or "brute"
  std::string action;   ///< "build", or "refit" after moving to another time of the animation
  std::uint64_t triangles = 0;
  accel::HitComparison hits;
  std::uint64_t edge_cases = 0;  ///< oracle only: ties and rounding edges, not mistakes
  std::string first_kind;        ///< kind of the first ray that differs
};

/// Holds the reference to the exact oracle and every structure to the reference, over rays of every
/// kind and the scene's own camera; animated scenes with fixed topology also after an update.
/// `progress` is told the share done. Stops early, with the rows so far, once interrupted.
std::vector<VerificationRow> verify_scene(const scene::Scene& scene,
                                          const std::vector<accel::StructureSpec>& specs,
                                          const VerificationPlan& plan,
                                          const std::function<void(double)>& progress);

}  // namespace encore::app
