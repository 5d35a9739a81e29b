#include "scene/samples/creatures.h"
#include "scene/samples/mesh_tools.h"
#include "scene/samples/noise.h"
#include "scene/samples/sculpture.h"

namespace encore::scene::samples {

namespace {

Sculpture sculpt() {
  const Vec z(0.0, 0.0, 1.0);
  Sculpture s;
  s.ellipsoid(Frame{{-1.2, 5.6, 0.0}}.turned(z, 14.0), {6.4, 5.2, 4.7}, 1.0);
  s.ellipsoid(Frame{{3.4, 6.2, 0.0}}.turned(z, 60.0), {4.6, 3.5, 3.5}, 2.0);
  s.ball({-7.4, 3.9, 0.0}, 2.0, 0.7);
  // Head: skull, muzzle, cheeks, nose, chin.
  s.ellipsoid(Frame{{6.2, 11.6, 0.0}}.turned(z, -18.0), {3.7, 3.0, 2.8}, 1.4);
  s.ball({8.6, 10.5, 0.0}, 1.75, 1.0);
  s.ball({9.9, 11.15, 0.0}, 0.5, 0.4);
  s.ball({8.6, 9.5, 0.0}, 1.0, 0.6);
  for (const double side : {-1.0, 1.0}) {
    const auto at = [&](double x, double y, double out) { return Vec(x, y, side * out); };
    s.ball(at(8.5, 10.2, 1.0), 1.25, 0.6);
    s.ball(at(7.6, 12.3, 2.5), 0.62, 0.06);
    // Ears lean back and apart; each is hollowed on the side that faces forwards and out.
    const Frame ear = frame_along(at(2.9, 17.0, 2.0), {-0.52, 1.0, side * 0.16});
    const Vec forward = normalize(Vec(0.75, 0.4, side * 0.5));
    Frame blade = ear;
    blade.x = normalize(forward - ear.y * dot(forward, ear.y));
    blade.z = cross(blade.x, blade.y);
    s.ellipsoid(blade, {0.85, 5.0, 1.65}, 0.8);
    Frame hollow = blade;
    hollow.origin = blade.origin + blade.x * 0.85 + blade.y * 0.3;
    s.carve_ellipsoid(hollow, {0.75, 3.9, 1.0}, 0.4);
    // Haunch, hind foot, front leg with paw.
    s.ellipsoid(Frame{at(-2.7, 4.2, 3.1)}.turned(z, 25.0), {4.2, 3.7, 2.2}, 0.7);
    s.ellipsoid({at(1.2, 1.0, 3.6)}, {3.5, 1.15, 1.3}, 0.5);
    s.limb({{at(4.0, 5.2, 1.9), 1.7},
            {at(5.2, 2.6, 2.0), 1.15},
            {at(5.8, 1.1, 2.0), 1.0},
            {at(7.4, 0.9, 2.0), 0.95}},
           10, 0.7);
  }
  return s;
}

}  // namespace

Mesh bunny(std::size_t triangles) {
  const Relief fur = [](const Vec& p, const Vec& n) {
    // Tufts drawn out downwards and backwards; finest where the fur is long, on breast and back.
    const Vec q = p + Vec(0.35, 0.5, 0.0) * fractal_noise(p * 0.5, 2, 21);
    const double tufts = fractal_noise(Vec(q.x * 1.5, q.y * 0.75, q.z * 1.9), 4, 22);
    const double smooth_face = smoothstep(9.0, 7.0, p.x) * smoothstep(15.0, 12.0, p.y);
    return (0.05 + 0.13 * smooth_face) * tufts + 0.05 * n.y * smooth_face;
  };
  // Cut open where it sits. The sampled surface may be a little larger than a quarter of the
  // wanted count, because the cut takes some away.
  const std::size_t base = triangles / 4;
  Mesh sampled = sculpt().surface_of((base + base / 40) & ~std::size_t(1));
  cut_below(sampled, 0.35);
  Mesh mesh = finished(std::move(sampled), triangles, 1, fur);
  mesh = moved(std::move(mesh), Frame{}.turned({0.0, 1.0, 0.0}, -32.0));
  fit(mesh);
  return mesh;
}

}  // namespace encore::scene::samples
