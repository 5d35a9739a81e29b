#pragma once

#include "accel/settings.h"
#include "accel/stability_cases.h"
#include "app/stability_tally.h"
#include "renderer/gl/context.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// What to run of the stability suite.
struct StabilityPlan {
  std::vector<std::string> cases;  ///< names; empty: all
  accel::StabilitySize size = accel::StabilitySize::usual;
  std::vector<accel::StructureSpec> structures;  ///< empty: all, brute too, by their defaults
  std::vector<accel::IntersectionMode> modes;    ///< empty: all
  std::size_t rays_per_kind = 200;               ///< fewer where there are many triangles
  double reference_tests = 5e6;                  ///< rays times triangles for each structure
  std::uint64_t watertight_rays = 50'000;        ///< at edges and vertices of each closed mesh
  std::uint64_t seed = 1;
  bool cpu = true;
  std::shared_ptr<renderer::gl::Context> gpu;  ///< null: not on it
};

/// One structure by one intersection test on one device in one case.
struct StabilityRow {
  std::string name;       ///< of the case
  std::string structure;  ///< and its mode, device and what was done
  accel::IntersectionMode mode = accel::IntersectionMode::precise;
  std::string device = "cpu";
  std::string action = "build";
  std::string against;  ///< "exact oracle", "brute", or "closed mesh"
  std::uint64_t triangles = 0;
  StabilityTally tally;
  std::optional<std::uint64_t> most_steps;  ///< nodes or cells that one ray entered
  std::optional<double> build_s;
  std::optional<double> update_s;  ///< of one refit, on average
  std::optional<double> trace_s;   ///< of all rays, on one thread or the device
  std::optional<std::uint64_t> bytes;
  std::optional<std::uint64_t> asked_bytes;  ///< of the system's allocator, by all of the build
  std::optional<std::uint64_t> references;
  bool limited = false;  ///< BuildStats::limited
  std::string broken;    ///< the first limit that is broken, in words; empty: none
};

/// The names of all cases, those of closed meshes last.
std::vector<std::string> stability_case_names();

/// Runs the plan, case by case, and hands every row to `row` as soon as it is there. `progress` is
/// told the share done and the case in work. Stops early once interrupted.
///
/// Limits: `precise` answers every ray as the precise brute force does, bit for bit (brute itself,
/// and the GPU: as the exact oracle or brute does, but for one rounding of t and edges passed
/// within 2^-40); `watertight` differs only where single precision leaves it open (single_doubt())
/// and never at an edge or vertex of a closed mesh; `moller-trumbore` is reported. In all modes
/// any-hit agrees with the nearest hit, no ray enters more nodes or cells than there are, and no
/// structure holds more than accel::most_bytes().
///
/// Names of cases that do not exist throw UsageError.
void run_stability(const StabilityPlan& plan, const std::function<void(const StabilityRow&)>& row,
                   const std::function<void(double, const std::string&)>& progress);

}  // namespace encore::app
