#include "accel/inspect/ray_recording.h"

#include "accel/triangle_tester.h"

#include <limits>

namespace encore::accel {

namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

}  // namespace

Recording::Recording(const scene::Ray& ray, IntersectionMode mode, RayPath& path)
    : ray_(ray), mode_(mode), box_ray_(ray), path_(path) {
  path_.clear();
  path_.recorded = true;
}

void Recording::add(const RayStep& step) {
  if (path_.steps.size() < path_.most_steps) {
    path_.steps.push_back(step);
  } else {
    ++path_.left_out;
  }
}

void Recording::end(const scene::Hit& hit) {
  path_.steps.push_back({.event = RayStep::Event::end,
                         .hit = hit.found(),
                         .triangle = hit.triangle,
                         .enter = hit.t,
                         .leave = kUnknown,
                         .u = hit.u,
                         .v = hit.v});
}

void Recording::scene_box(bool hit, float enter, float leave) {
  add({.event = RayStep::Event::scene_box, .hit = hit, .enter = enter, .leave = leave});
}

void Recording::node(std::uint32_t place) {
  float enter = kUnknown;
  float leave = kUnknown;
  if (bounds_of_) {
    // A cell that is visited only because planes are too close to tell apart may be missed.
    const scene::Bounds box = bounds_of_(place);
    const BoxStretch stretch = box_stretch(box.min, box.max, box_ray_, ray_.t_min, ray_.t_max);
    if (stretch.hit()) {
      enter = stretch.enter;
      leave = stretch.leave;
    }
  }
  node(place, enter, leave);
}

void Recording::node(std::uint32_t place, float enter, float leave) {
  ++path_.counters.steps;
  add({.event = RayStep::Event::enter, .place = place, .enter = enter, .leave = leave});
}

void Recording::box(std::uint32_t place, bool hit, float enter) {
  ++path_.counters.box_tests;
  add({.event = RayStep::Event::box,
       .hit = hit,
       .place = place,
       .enter = hit ? enter : kUnknown,
       .leave = kUnknown});
}

void Recording::plane(std::uint32_t place, float t, PlaneSides sides) {
  add({.event = RayStep::Event::plane,
       .sides = sides,
       .place = place,
       .enter = t,
       .leave = kUnknown});
}

void Recording::triangles(const scene::Triangle* triangles, const std::uint32_t* references,
                          std::uint32_t count, scene::Hit best) {
  for (std::uint32_t i = 0; i < count; ++i) judge(triangles, references[i], best);
}

void Recording::triangle(const scene::Triangle* triangles, std::uint32_t index, scene::Hit best) {
  judge(triangles, index, best);
}

void Recording::judge(const scene::Triangle* triangles, std::uint32_t index, scene::Hit& best) {
  ++path_.counters.triangle_tests;
  RayStep step{.event = RayStep::Event::triangle,
               .triangle = index,
               .enter = kUnknown,
               .leave = kUnknown,
               .u = kUnknown,
               .v = kUnknown};
  scene::Hit alone{.t = ray_.t_max};
  if (test_triangle(mode_, ray_, triangles, index, alone)) {
    step.result = test_triangle(mode_, ray_, triangles, index, best) ? RayStep::Result::hit
                                                                     : RayStep::Result::farther;
    step.hit = true;
    step.enter = alone.t;
    step.u = alone.u;
    step.v = alone.v;
  }
  add(step);
}

void Recording::skipped(std::uint32_t place, float enter, float best) {
  add({.event = RayStep::Event::skipped, .place = place, .enter = enter, .leave = best});
}

}  // namespace encore::accel
