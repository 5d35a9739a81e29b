#include "accel/build_place.h"

namespace encore::accel {

std::string_view to_string(BuildPlace place) {
  switch (place) {
    case BuildPlace::automatic:
      return "auto";
    case BuildPlace::cpu:
      return "cpu";
    case BuildPlace::device:
      return "device";
  }
  return "";
}

std::optional<BuildPlace> parse_build_place(std::string_view name) {
  for (const BuildPlace place : {BuildPlace::automatic, BuildPlace::cpu, BuildPlace::device}) {
    if (name == to_string(place)) return place;
  }
  return std::nullopt;
}

bool device_can_build(const StructureSpec& structure, Policy policy) {
  const auto* bvh = std::get_if<BvhSettings>(&structure.settings);
  return policy == Policy::rebuild && structure.kind == StructureKind::bvh_sah && bvh != nullptr &&
         bvh->preset == BuildPreset::fast;
}

BuildPlace place_of_build(BuildPlace wanted, const StructureSpec& structure, Policy policy,
                          bool software) {
  const bool device =
      wanted == BuildPlace::device || (wanted == BuildPlace::automatic && !software);
  return device && device_can_build(structure, policy) ? BuildPlace::device : BuildPlace::cpu;
}

}  // namespace encore::accel
