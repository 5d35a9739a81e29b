#include "accel/inspect/ray_path.h"

#include "accel/inspect/node_table.h"

#include <fmt/format.h>

#include <cmath>

namespace encore::accel {

namespace {

/// Enough digits to tell distances of one ray apart.
std::string number(float x) {
  return fmt::format("{:.6g}", x);
}

std::string name_of(const RayStep& step, const NodeTable& table) {
  const auto& cells = table.cells();
  if (table.kind() == NodeKind::cells && cells[0] > 0) {
    return fmt::format("cell ({}, {}, {})", step.place % cells[0], step.place / cells[0] % cells[1],
                       step.place / (cells[0] * cells[1]));
  }
  const std::uint32_t node = table.index_of(step.place);
  if (node == kNoNode) return fmt::format("node at place {}", step.place);
  return fmt::format("node {} (depth {})", node, table[node].depth);
}

std::string describe_entered(const RayStep& step, const NodeTable& table) {
  const std::uint32_t node = table.index_of(step.place);
  std::string text = name_of(step, table) + ": entered";
  if (!std::isnan(step.enter)) text += " at " + number(step.enter);
  if (!std::isnan(step.leave)) text += ", left at " + number(step.leave);
  if (node == kNoNode) return text + (table.kind() == NodeKind::cells ? ", empty" : "");
  const NodeRecord& record = table[node];
  if (!record.leaf) return text;
  if (record.triangles == 0) return text + ", an empty leaf";
  return text + fmt::format(", {} triangle{}", record.triangles, record.triangles == 1 ? "" : "s");
}

std::string describe_plane(const RayStep& step, const NodeTable& table) {
  const char* const sides = step.sides == PlaneSides::near  ? "goes on on the near side only"
                            : step.sides == PlaneSides::far ? "goes on on the far side only"
                                                            : "near side first, far side waits";
  // Along the plane 0 * inf gives NaN: there is no distance.
  const std::string where = std::isnan(step.enter) ? "runs inside the split plane"
                            : std::isinf(step.enter)
                                ? "runs beside the split plane"
                                : "meets the split plane at " + number(step.enter);
  return name_of(step, table) + ": " + where + ", " + sides;
}

std::string describe_triangle(const RayStep& step) {
  if (step.result == RayStep::Result::missed) {
    return fmt::format("triangle {}: missed", step.triangle);
  }
  return fmt::format("triangle {}: {} at {}, u {:.2f}, v {:.2f}", step.triangle,
                     step.result == RayStep::Result::hit ? "hit" : "crossed behind the best hit",
                     number(step.enter), step.u, step.v);
}

}  // namespace

std::string describe(const RayStep& step, const NodeTable& table) {
  switch (step.event) {
    case RayStep::Event::scene_box:
      if (!step.hit) return "the box of the scene: missed";
      return "the box of the scene: met from " + number(step.enter) + " to " + number(step.leave);
    case RayStep::Event::enter:
      return describe_entered(step, table);
    case RayStep::Event::box:
      if (!step.hit) return name_of(step, table) + ": box missed";
      return name_of(step, table) + ": box met at " + number(step.enter);
    case RayStep::Event::plane:
      return describe_plane(step, table);
    case RayStep::Event::triangle:
      return describe_triangle(step);
    case RayStep::Event::skipped:
      return name_of(step, table) + ": skipped, begins at " + number(step.enter) +
             " behind the hit at " + number(step.leave);
    case RayStep::Event::end:
      break;
  }
  if (!step.hit) return "end: nothing hit";
  return fmt::format("end: triangle {} hit at {}", step.triangle, number(step.enter));
}

std::string summary(const RayPath& path) {
  if (!path.recorded || path.steps.empty()) return "this structure does not tell what a ray does";
  const RayStep& end = path.steps.back();
  std::string text = end.hit ? fmt::format("hit triangle {} at {}", end.triangle, number(end.enter))
                             : "hit nothing";
  text += fmt::format(" after {} steps, {} box tests, {} triangle tests", path.counters.steps,
                      path.counters.box_tests, path.counters.triangle_tests);
  if (path.cut()) text += fmt::format("; {} of the events were too many to keep", path.left_out);
  return text;
}

}  // namespace encore::accel
