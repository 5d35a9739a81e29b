#include "accel/make_structure.h"

#include "accel/brute_force.h"
#include "accel/bvh/bvh.h"
#include "accel/grid/grid.h"
#include "accel/kdtree/kdtree.h"
#include "accel/wide/wide_bvh.h"

#include <utility>

namespace encore::accel {

namespace {

std::unique_ptr<AccelerationStructure> make_kind(const StructureSpec& spec) {
  const auto settings = [&]<class T>(std::type_identity<T>) {
    const T* given = std::get_if<T>(&spec.settings);
    return given ? *given : T{};
  };
  switch (spec.kind) {
    case StructureKind::brute:
      return std::make_unique<BruteForce>();
    case StructureKind::grid_exact:
    case StructureKind::grid_box:
      return std::make_unique<Grid>(spec.kind, settings(std::type_identity<GridSettings>{}),
                                    spec.memory);
    case StructureKind::kd_median:
    case StructureKind::kd_sah:
      return std::make_unique<KdTree>(spec.kind, settings(std::type_identity<KdTreeSettings>{}),
                                      spec.memory);
    case StructureKind::bvh_median:
      return std::make_unique<Bvh>(spec.kind, settings(std::type_identity<BvhSettings>{}),
                                   spec.memory);
    case StructureKind::bvh_sah:
      return std::make_unique<WideBvh>(settings(std::type_identity<BvhSettings>{}), spec.memory);
  }
  return nullptr;
}

}  // namespace

std::unique_ptr<AccelerationStructure> make_structure(const StructureSpec& spec) {
  auto structure = make_kind(spec);
  if (structure) structure->set_intersection(spec.intersection);
  if (structure) structure->set_grouping(spec.grouping);
  return structure;
}

}  // namespace encore::accel
