#pragma once

#include "accel/box_hit.h"
#include "accel/inspect/ray_path.h"
#include "accel/settings.h"
#include "scene/bounds.h"
#include "scene/triangle.h"

#include <functional>
#include <utility>

namespace encore::accel {

/// The counter policy that writes down what a traversal does (counters.h says what the calls mean).
///
/// Triangles are judged one by one in the mode's arithmetic, on a copy of the best hit: traversals
/// test several at once, to the same outcome.
class Recording {
 public:
  /// Starts `path` afresh; only its `most_steps` stays. Both must outlive this.
  Recording(const scene::Ray& ray, IntersectionMode mode, RayPath& path);
  /// Writes the last step.
  void end(const scene::Hit& hit);

  void scene_box(bool hit, float enter, float leave);
  void node(std::uint32_t place);
  void node(std::uint32_t place, float enter, float leave);
  template <class Place>
  void box(const Place& place, bool hit, float enter) {
    box(std::uint32_t{place()}, hit, enter);
  }
  void box(std::uint32_t place, bool hit, float enter);
  void plane(std::uint32_t place, float t, PlaneSides sides);
  void triangles(const scene::Triangle* triangles, const std::uint32_t* references,
                 std::uint32_t count, scene::Hit best);
  void triangle(const scene::Triangle* triangles, std::uint32_t index, scene::Hit best);
  void skipped(std::uint32_t place, float enter, float best);
  void cells(std::function<scene::Bounds(std::uint32_t)> bounds_of) {
    bounds_of_ = std::move(bounds_of);
  }

 private:
  void add(const RayStep& step);
  void judge(const scene::Triangle* triangles, std::uint32_t index, scene::Hit& best);

  const scene::Ray& ray_;
  IntersectionMode mode_;
  BoxRay box_ray_;
  RayPath& path_;
  std::function<scene::Bounds(std::uint32_t)> bounds_of_;
};

}  // namespace encore::accel
