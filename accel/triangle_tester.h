#pragma once

#include "accel/settings.h"
#include "accel/triangle_filter.h"
#include "accel/triangle_moller_trumbore.h"
#include "accel/triangle_watertight.h"

namespace encore::accel {

/// The testers, one an intersection mode; traversals are templates on them, so that inner loops do
/// not ask for the mode. Each is made for one ray and has
///
///   bool test(triangles, index, best)              one triangle
///   bool test(triangles, references, count, best)  several: the same, only faster
///   static float reach(float best)
///
/// No traversal can lose a hit by a tester's rounding, nor run longer for it. Where it goes follows
/// from the ray and the planes alone; of the hits it only asks, in one place, what begins behind
/// the best one and can be left out. There it compares with reach(best), which is no less than the
/// true distance of the best hit, and so leaves out no more than with precise distances. Nothing
/// asks whether a hit lies inside the present cell, so a distance that is rounded across the cell's
/// end changes nothing.
///
/// with_tester() calls work.template operator()<Tester>() with the mode's own.
template <class Work>
void with_tester(IntersectionMode mode, const Work& work) {
  switch (mode) {
    case IntersectionMode::precise:
      return work.template operator()<TriangleFilter>();
    case IntersectionMode::moller_trumbore:
      return work.template operator()<MollerTrumboreTester>();
    case IntersectionMode::watertight:
      return work.template operator()<WatertightTester>();
  }
}

/// One triangle by the mode's tester; true if it became the best hit. For those who look at single
/// tests, not for traversals.
inline bool test_triangle(IntersectionMode mode, const scene::Ray& ray,
                          const scene::Triangle* triangles, std::uint32_t index, scene::Hit& best) {
  bool accepted = false;
  with_tester(mode, [&]<class Tester>() { accepted = Tester(ray).test(triangles, index, best); });
  return accepted;
}

}  // namespace encore::accel

/// Compiles Structure::trace for every use of TracedStructure; in the file that defines it.
#define ENCORE_COMPILE_TRACE_BY(Structure, Tester)                                              \
  template void Structure::trace<false, Tester, NotCounting>(const Ray&, Hit&, NotCounting&)    \
      const;                                                                                    \
  template void Structure::trace<false, Tester, Counting>(const Ray&, Hit&, Counting&) const;   \
  template void Structure::trace<false, Tester, Recording>(const Ray&, Hit&, Recording&) const; \
  template void Structure::trace<true, Tester, NotCounting>(const Ray&, Hit&, NotCounting&) const;
#define ENCORE_COMPILE_TRACE(Structure)                    \
  ENCORE_COMPILE_TRACE_BY(Structure, TriangleFilter)       \
  ENCORE_COMPILE_TRACE_BY(Structure, MollerTrumboreTester) \
  ENCORE_COMPILE_TRACE_BY(Structure, WatertightTester)
