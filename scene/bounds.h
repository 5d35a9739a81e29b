#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <limits>

namespace encore::scene {

/// Axis-aligned box, closed on all sides. Default: empty (min > max), so that extending works.
struct Bounds {
  glm::vec3 min{std::numeric_limits<float>::infinity()};
  glm::vec3 max{-std::numeric_limits<float>::infinity()};

  void extend(const glm::vec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  void extend(const Bounds& b) {
    min = glm::min(min, b.min);
    max = glm::max(max, b.max);
  }
  [[nodiscard]] bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  [[nodiscard]] glm::vec3 size() const { return empty() ? glm::vec3(0.0F) : max - min; }
  [[nodiscard]] glm::vec3 center() const { return min * 0.5F + max * 0.5F; }
  /// Surface area; double, so that boxes of size 1e18 or 1e-18 neither overflow nor vanish.
  [[nodiscard]] double area() const {
    if (empty()) return 0.0;
    const double x = double(max.x) - double(min.x);
    const double y = double(max.y) - double(min.y);
    const double z = double(max.z) - double(min.z);
    return 2.0 * (x * y + y * z + z * x);
  }
  [[nodiscard]] int longest_axis() const {
    const glm::vec3 s = size();
    if (s.x >= s.y && s.x >= s.z) return 0;
    return s.y >= s.z ? 1 : 2;
  }
  friend bool operator==(const Bounds& a, const Bounds& b) {
    return a.min == b.min && a.max == b.max;
  }
};

}  // namespace encore::scene
