#include "accel/memory_bound.h"

#include "accel/grid/grid.h"
#include "accel/kdtree/kdtree_builder.h"
#include "accel/wide/wide_build.h"
#include "shaders/shared/gpu_types.h"

#include <cstddef>
#include <variant>

namespace encore::accel {

namespace {

template <class Settings>
Settings settings_of(const StructureSpec& spec) {
  const auto* given = std::get_if<Settings>(&spec.settings);
  return given != nullptr ? *given : Settings{};
}

std::uint64_t most_grid_bytes(const GridSettings& settings, std::uint64_t triangles) {
  const std::uint64_t side = grid_cells_per_axis(settings, triangles);
  const std::uint64_t numbers =
      grid_reference_limit(settings, triangles) + side * side * side + 1 + 3 * (side + 1);
  return 4 * numbers;
}

std::uint64_t most_kd_bytes(const KdTreeSettings& settings, std::uint64_t triangles) {
  const KdLimits limits = kd_limits(settings, static_cast<std::size_t>(triangles));
  return limits.references * (sizeof(std::uint32_t) + sizeof(gpu::KdNode));
}

}  // namespace

std::uint64_t most_bytes(const StructureSpec& spec, std::uint64_t triangles) {
  switch (spec.kind) {
    case StructureKind::brute:
      return 0;
    case StructureKind::grid_exact:
    case StructureKind::grid_box:
      return most_grid_bytes(settings_of<GridSettings>(spec), triangles);
    case StructureKind::kd_median:
    case StructureKind::kd_sah:
      return most_kd_bytes(settings_of<KdTreeSettings>(spec), triangles);
    case StructureKind::bvh_median:
      return 2 * sizeof(gpu::BvhNode) * triangles;
    case StructureKind::bvh_sah:
      return most_wide_bytes(settings_of<BvhSettings>(spec).preset, triangles);
  }
  return 0;
}

}  // namespace encore::accel
