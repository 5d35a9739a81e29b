#include "app/stability_closed.h"

#include "accel/make_structure.h"
#include "accel/parallel.h"
#include "accel/watertight_study.h"
#include "app/interrupt.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace encore::app {

namespace {

using accel::IntersectionMode;
using Clock = std::chrono::steady_clock;

const std::vector<accel::WatertightCase>& meshes() {
  static const std::vector<accel::WatertightCase> all = accel::watertight_cases();
  return all;
}

std::string name_of(const accel::WatertightCase& mesh) {
  std::string name = "closed-" + mesh.name;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

/// The study on all threads, each part under a seed of its own.
accel::WatertightCounts study(const accel::AccelerationStructure& structure,
                              const accel::WatertightCase& mesh, std::uint64_t rays,
                              std::uint64_t seed) {
  constexpr std::uint64_t kPart = 5'000;
  std::vector<accel::WatertightCounts> counts((rays + kPart - 1) / kPart);
  accel::Workers(0).for_parts(rays, kPart, [&](std::size_t begin, std::size_t end) {
    if (interrupted) return;
    const std::uint64_t part = begin / kPart;
    counts[part] =
        accel::run_watertight_case(structure, mesh, end - begin, seed * 1'000'003 + part);
  });
  accel::WatertightCounts sum;
  for (const accel::WatertightCounts& part : counts) sum += part;
  return sum;
}

}  // namespace

std::vector<std::string> closed_case_names() {
  std::vector<std::string> names;
  for (const accel::WatertightCase& mesh : meshes()) names.push_back(name_of(mesh));
  return names;
}

std::vector<StabilityRow> run_closed_case(const std::string& name, const accel::StructureSpec& spec,
                                          const StabilityPlan& plan) {
  std::vector<StabilityRow> rows;
  const auto mesh = std::find_if(meshes().begin(), meshes().end(),
                                 [&](const auto& one) { return name_of(one) == name; });
  if (mesh == meshes().end() || !plan.cpu) return rows;
  const auto structure = accel::make_structure(spec);
  const auto begun = Clock::now();
  structure->build(mesh->triangles);
  const double build_s = std::chrono::duration<double>(Clock::now() - begun).count();
  const accel::BuildStats stats = structure->stats();
  // Brute force needs a few hundred times as long for each ray.
  const std::uint64_t share = spec.kind == accel::StructureKind::brute ? 50 : 1;
  const std::uint64_t rays = std::max<std::uint64_t>(plan.watertight_rays / share, 100);
  for (const IntersectionMode mode :
       plan.modes.empty() ? accel::all_intersection_modes() : plan.modes) {
    structure->set_intersection(mode);
    const accel::WatertightCounts counts = study(*structure, *mesh, rays, plan.seed);
    StabilityRow row;
    row.name = name;
    row.structure = structure->name();
    row.mode = mode;
    row.against = "closed mesh";
    row.triangles = mesh->triangles.size();
    row.tally.rays = counts.rays;
    row.tally.hits = counts.hits;
    row.tally.missed = counts.missed;
    row.tally.invented = counts.invented;
    row.tally.wrong_occlusion = counts.wrong_occlusion;
    row.build_s = build_s;
    row.bytes = stats.bytes;
    row.references = stats.references;
    row.limited = stats.limited;
    if (mode != IntersectionMode::moller_trumbore && counts.wrong() > 0) {
      row.broken = fmt::format("{} of {} rays slipped through or were answered wrong",
                               counts.wrong(), counts.rays);
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace encore::app
