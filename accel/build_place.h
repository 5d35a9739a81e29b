#pragma once

#include "accel/settings.h"

#include <optional>
#include <string>
#include <string_view>

namespace encore::accel {

/// Where a structure is built that a graphics device traces rays through.
enum class BuildPlace {
  automatic,  ///< on the device where it can and is no software renderer, else on the CPU
  cpu,        ///< on the CPU, from where the device is sent a copy
  device,     ///< on the device, which is sent triangles alone
};
/// The words of command line and files: "auto", "cpu", "device".
std::string_view to_string(BuildPlace place);
std::optional<BuildPlace> parse_build_place(std::string_view name);

/// Whether a device can build this structure, and is asked to under this policy: bvh-sah with
/// preset fast, built again for every frame that changes.
bool device_can_build(const StructureSpec& structure, Policy policy);
/// Where it is built, once it is known whether the device is a renderer in software: never
/// `automatic`, and `device` only where it can.
BuildPlace place_of_build(BuildPlace wanted, const StructureSpec& structure, Policy policy,
                          bool software);

}  // namespace encore::accel
