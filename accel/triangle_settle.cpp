#include "accel/triangle_settle.h"

#include "accel/triangle_watertight.h"

namespace encore::accel {

bool settle_watertight(const scene::Ray& ray, const scene::Triangle* triangles, std::uint32_t index,
                       scene::Hit& best) {
  return WatertightTester(ray).test(triangles, index, best);
}

}  // namespace encore::accel
