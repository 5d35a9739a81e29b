#pragma once

#include "scene/ray.h"
#include "scene/triangle.h"

#include <cstdint>

namespace encore::accel {

/// WatertightTester(ray).test(triangles, index, best), as an ordinary function: for inner loops
/// that are compiled with instructions that nothing else may use and must not bring along a copy of
/// their own (accel/simd/intrinsics.h).
bool settle_watertight(const scene::Ray& ray, const scene::Triangle* triangles, std::uint32_t index,
                       scene::Hit& best);

}  // namespace encore::accel
