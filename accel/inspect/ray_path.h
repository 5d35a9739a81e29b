#pragma once

#include "accel/counters.h"
#include "scene/ray.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace encore::accel {

class NodeTable;

/// One thing that a traversal does on behalf of a ray. Members that an event has no use for, and
/// distances that the traversal does not know, are NaN or kNoHit.
struct RayStep {
  enum class Event : std::uint8_t {
    scene_box,  ///< the box of everything was tested: `hit`, and the stretch enter .. leave
    enter,      ///< entered node `place`, stretch enter .. leave (a BVH knows no leave)
    box,        ///< tested the box of node `place`: `hit`, entered at `enter`
    plane,      ///< met the split plane of node `place` at `enter`; went to `sides`
    triangle,   ///< tested `triangle`: `result`; if not missed, `enter` is the distance, and u, v
    skipped,    ///< node `place`, which begins at `enter`, lies behind the best hit at `leave`
    end,        ///< the search is over; `hit`: with `triangle` at `enter`, u, v
  };
  enum class Result : std::uint8_t {
    missed,   ///< the ray does not cross it within (t_min, t_max]
    hit,      ///< it became the best hit
    farther,  ///< crossed, but no nearer than the best hit
  };

  Event event = Event::end;
  bool hit = false;
  Result result = Result::missed;
  PlaneSides sides = PlaneSides::both;
  std::uint32_t place = scene::kNoHit;  ///< NodeView::place; NodeTable::index_of finds the node
  std::uint32_t triangle = scene::kNoHit;
  float enter = 0.0F;
  float leave = 0.0F;
  float u = 0.0F;
  float v = 0.0F;
};

/// Everything that one ray did, in order.
struct RayPath {
  static constexpr std::size_t kMostSteps = 1'000'000;  ///< 32 bytes each

  /// How many steps to keep. Later ones are counted but not kept, only the last (Event::end) is.
  std::size_t most_steps = kMostSteps;
  std::vector<RayStep> steps;
  std::uint64_t left_out = 0;  ///< steps that were not kept
  TraceCounters counters;      ///< of the whole search, kept or not; as intersect_counted() counts
  bool recorded = false;       ///< false if the structure cannot tell what it does

  /// Forgets everything but `most_steps`.
  void clear() {
    steps.clear();
    left_out = 0;
    counters = {};
    recorded = false;
  }
  [[nodiscard]] bool cut() const { return left_out > 0; }
};

/// One plain sentence: "node 17 (depth 4): entered at 12.31". The table gives nodes the numbers
/// that they have there, and cells their coordinates; it may belong to an older version of the
/// structure only if that was refitted since.
std::string describe(const RayStep& step, const NodeTable& table);

/// What the path amounts to: "hit triangle 4711 at 12.4 after 31 steps, …".
std::string summary(const RayPath& path);

}  // namespace encore::accel
