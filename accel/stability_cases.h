#pragma once

#include "accel/acceleration_structure.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace encore::accel {

/// How large a stability case is made.
enum class StabilitySize {
  small,  ///< for tests: hundreds of triangles
  usual,  ///< thousands
  full,   ///< a million, and 2^24
};

/// A scene, and the rays through it, that structures and intersection tests stumble over. Seeded,
/// and the same on every machine.
struct StabilityCase {
  enum class Rays {
    all,        ///< of every RayKind
    in_planes,  ///< along axes and in the structure's own planes only
    denormal,   ///< of every kind, their directions' lengths below the normal floats
    enormous,   ///< of every kind, their directions' lengths up to the largest floats
  };

  std::string_view name;
  std::string_view what;     ///< one line for people
  std::size_t triangles[3];  ///< about, by StabilitySize
  std::vector<Triangle> (*make)(std::size_t count, std::uint64_t seed);
  Rays rays = Rays::all;
  /// Frames of frame_of() that follow the first; 0 for cases that stand still.
  int frames = 0;
};

std::span<const StabilityCase> stability_cases();
/// Null if there is none of that name.
const StabilityCase* find_stability_case(std::string_view name);

std::vector<Triangle> stability_triangles(const StabilityCase& which, StabilitySize size,
                                          std::uint64_t seed);
/// `each` rays of each of the case's kinds; `structure` gives the planes to look into. An empty
/// scene has a few rays, too.
std::vector<Ray> stability_rays(const StabilityCase& which, std::size_t each, std::uint64_t seed,
                                std::span<const Triangle> triangles,
                                const AccelerationStructure& structure);

/// The triangles of `start` in frame `frame` of an explosion: each flies off on its own, ten
/// frames to every doubling of the distance, so that in frame 1,000 the scene is 10^30 times as
/// large as it was, and its triangles are not.
void frame_of(std::span<const Triangle> start, int frame, std::uint64_t seed,
              std::span<Triangle> out);

}  // namespace encore::accel
