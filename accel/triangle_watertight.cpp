#include "accel/triangle_watertight.h"

namespace encore::accel {

namespace {

/// Whether precise arithmetic prefers triangle `a` to triangle `b`, both of which it hits.
bool precisely_nearer(const scene::Ray& ray, const scene::Triangle* triangles, std::uint32_t a,
                      std::uint32_t b) {
  scene::Hit nearest{.t = ray.t_max};
  decide_hit(ray, triangles[b], b, nearest);
  decide_hit(ray, triangles[a], a, nearest);
  return nearest.triangle == a;
}

}  // namespace

bool WatertightTester::accept(const scene::Triangle* triangles, std::uint32_t index,
                              Verdict verdict, const Weights& w, scene::Hit& best) const {
  // Grids and kd-trees meet a triangle in several places.
  if (index == best.triangle) return false;
  const scene::Triangle& triangle = triangles[index];
  scene::Hit hit{.t = ray_.t_max};
  if (verdict == Verdict::hit) {
    verdict = distance(triangle, hit.t);
    if (verdict == Verdict::miss) return false;
  }
  if (verdict == Verdict::hit) {
    const float inverse_sum = 1.0F / (w.a + w.b + w.c);
    hit.triangle = index;
    hit.u = w.b * inverse_sum;
    hit.v = w.c * inverse_sum;
  } else {
    hit.t = ray_.t_max;
    if (!decide_hit(ray_, triangle, index, hit)) return false;
  }

  // Which of two is nearer must not depend on which was met first, nor on single precision.
  if (best.found()) {
    if (std::fabs(hit.t - best.t) <= kSameDistance * hit.t) {
      if (!precisely_nearer(ray_, triangles, index, best.triangle)) return false;
    } else if (hit.t > best.t) {
      return false;
    }
  }
  best = hit;
  return true;
}

}  // namespace encore::accel
