#pragma once

#include "scene/ray.h"
#include "scene/triangle.h"

#include <cstddef>
#include <cstdint>

namespace encore::accel {

/// A rectangle of rays for a kernel that is compiled once an instruction set: width * height rays,
/// row by row, and where the results go. Rays that it does not take together it hands back to the
/// structure's own single-ray functions.
struct TileJob {
  const scene::Triangle* triangles;
  const scene::Ray* rays;
  std::size_t width;
  std::size_t height;
  scene::Hit* hits;       ///< null: any-hit
  std::uint8_t* blocked;  ///< null: nearest hit
  const void* structure;
  void (*intersect)(const void* structure, const scene::Ray* rays, std::size_t count,
                    scene::Hit* hits);
  void (*occluded)(const void* structure, const scene::Ray* rays, std::size_t count,
                   std::uint8_t* blocked);
};

/// The job of any structure with intersect() and occluded(); rays.size() is a multiple of `width`,
/// which may be 0 where there are no rays.
template <class Structure, class Rays>
TileJob make_tile_job(const Structure& structure, const scene::Triangle* triangles,
                      const Rays& rays, std::size_t width, scene::Hit* hits,
                      std::uint8_t* blocked) {
  return {triangles,
          rays.data(),
          width,
          width > 0 ? rays.size() / width : 0,  // an empty batch may have no width
          hits,
          blocked,
          &structure,
          [](const void* self, const scene::Ray* first, std::size_t count, scene::Hit* to) {
            static_cast<const Structure*>(self)->intersect({first, count}, {to, count});
          },
          [](const void* self, const scene::Ray* first, std::size_t count, std::uint8_t* to) {
            static_cast<const Structure*>(self)->occluded({first, count}, {to, count});
          }};
}

}  // namespace encore::accel
