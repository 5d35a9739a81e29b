#pragma once

#include "accel/brute_force.h"
#include "accel/settings.h"
#include "scene/ray.h"
#include "scene/triangle.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace encore::test {

/// What the spot checks have found so far.
struct SpotCheckTally {
  std::uint64_t rays = 0;   ///< answers that were held to the truth
  std::uint64_t hits = 0;   ///< of these, rays that truly hit something
  std::uint64_t wrong = 0;  ///< answers that nothing excuses
  /// Answers of Möller and Trumbore's arithmetic, and those of them that brute force by the same
  /// arithmetic does not give: it promises no more than that these are few.
  std::uint64_t loose = 0;
  std::uint64_t loose_differing = 0;
  std::string first_wrong;
};

/// Holds answers to rays to precise brute force over the triangles as they are now.
class SpotCheck {
 public:
  explicit SpotCheck(std::span<const scene::Triangle> triangles);

  /// How answers came about.
  struct Source {
    accel::IntersectionMode mode = accel::IntersectionMode::precise;
    bool on_device = false;  ///< may round the last bit otherwise
    /// The structure was built over an earlier time: it may overlook a triangle, but not make one
    /// up.
    bool outdated = false;
    std::string name{};  ///< for the message
  };
  void check(std::span<const scene::Ray> rays, std::span<const scene::Hit> found,
             const Source& source, SpotCheckTally& tally);

 private:
  [[nodiscard]] bool right(const scene::Ray& ray, const scene::Hit& expected,
                           const scene::Hit& found, const Source& source) const;
  [[nodiscard]] bool is_a_hit(const scene::Ray& ray, const scene::Hit& found) const;

  std::span<const scene::Triangle> triangles_;
  accel::BruteForce precise_;
  accel::BruteForce loose_;
  std::vector<scene::Hit> expected_;
};

}  // namespace encore::test
