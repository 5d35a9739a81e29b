#include "scene/samples/creatures.h"
#include "scene/samples/mesh_tools.h"
#include "scene/samples/noise.h"
#include "scene/samples/sculpture.h"

namespace encore::scene::samples {

namespace {

/// From the tip of the tail to the back of the head.
const std::vector<PathPoint>& spine() {
  static const std::vector<PathPoint> path = {
      {{-13.2, 5.6, 2.4}, 0.22}, {{-13.4, 7.6, 1.0}, 0.36}, {{-11.6, 8.6, -1.0}, 0.6},
      {{-9.9, 6.8, -2.0}, 0.9},  {{-9.8, 4.0, -1.0}, 1.2},  {{-7.4, 2.8, 0.8}, 1.6},
      {{-4.4, 3.8, 1.0}, 2.1},   {{-1.4, 5.0, 0.0}, 2.5},   {{1.7, 4.6, -0.8}, 2.4},
      {{4.4, 4.2, -0.4}, 2.2},   {{6.6, 5.6, 0.4}, 1.8},    {{7.0, 8.2, 0.8}, 1.45},
      {{5.8, 10.4, 0.6}, 1.25},  {{6.2, 12.7, 0.5}, 1.15},  {{8.2, 13.9, 0.6}, 1.2}};
  return path;
}

void add_head(Sculpture& s) {
  const Vec z(0.0, 0.0, 1.0);
  const Frame skull = Frame{{9.2, 14.0, 0.65}}.turned(z, -12.0);
  s.ellipsoid(skull, {1.9, 1.25, 1.3}, 0.8);
  s.ellipsoid(Frame{{11.3, 13.7, 0.65}}.turned(z, -6.0), {1.9, 0.8, 0.95}, 0.7);
  // The lower jaw hangs open below the carved mouth.
  s.limb({{{8.8, 13.0, 0.65}, 0.8}, {{10.4, 12.1, 0.65}, 0.6}, {{12.2, 11.7, 0.65}, 0.42}}, 6, 0.4);
  s.carve_ellipsoid(Frame{{11.9, 12.75, 0.65}}.turned(z, -14.0), {2.3, 0.34, 1.6}, 0.2);
  for (const double side : {-1.0, 1.0}) {
    const auto at = [&](double x, double y, double out) { return Vec(x, y, 0.65 + side * out); };
    s.ball(at(9.9, 14.75, 0.85), 0.52, 0.25);
    s.ball(at(10.0, 14.72, 1.1), 0.36, 0.05);
    s.ball(at(12.7, 14.25, 0.45), 0.36, 0.3);
    s.limb({{at(8.5, 14.8, 0.7), 0.5},
            {at(7.0, 16.2, 1.2), 0.42},
            {at(5.0, 16.5, 1.7), 0.3},
            {at(3.6, 17.4, 2.0), 0.14}},
           10, 0.3);
    s.limb({{at(8.2, 13.6, 1.1), 0.45}, {at(6.9, 13.9, 2.1), 0.4}, {at(6.0, 14.4, 2.8), 0.14}}, 6,
           0.3);
    s.limb({{at(8.3, 12.9, 0.9), 0.4}, {at(7.4, 12.4, 1.8), 0.34}, {at(6.8, 12.2, 2.4), 0.14}}, 6,
           0.3);
    // Teeth, upper and lower.
    s.limb({{at(12.6, 13.1, 0.5), 0.2}, {at(12.7, 12.5, 0.5), 0.1}}, 2, 0.1);
    s.limb({{at(11.9, 11.9, 0.3), 0.2}, {at(12.0, 12.5, 0.35), 0.1}}, 2, 0.1);
  }
  s.limb({{{10.8, 11.9, 0.65}, 0.35}, {{10.5, 10.7, 0.65}, 0.28}, {{10.9, 9.8, 0.65}, 0.12}}, 6,
         0.3);
}

/// A leg through the given joints, with three claws at its end.
void add_leg(Sculpture& s, const std::vector<PathPoint>& joints) {
  s.limb(joints, 14, 0.9);
  const PathPoint& foot = joints.back();
  for (const double spread : {-0.65, 0.0, 0.65}) {
    const Vec toe = foot.position + Vec(0.95, -0.05, spread * 1.1);
    s.limb({{foot.position, 0.5}, {toe, 0.42}, {toe + Vec(0.75, -0.28, spread * 0.3), 0.14}}, 5,
           0.2);
  }
}

Sculpture sculpt() {
  Sculpture s;
  s.limb(spine(), 72, 0.5);
  add_head(s);
  add_leg(s, {{{4.4, 4.4, 1.4}, 1.5},
              {{5.4, 2.6, 2.6}, 1.0},
              {{4.6, 1.1, 2.9}, 0.72},
              {{5.4, 0.4, 3.0}, 0.62}});
  add_leg(s, {{{4.6, 4.4, -2.0}, 1.5},
              {{6.8, 3.0, -3.2}, 1.0},
              {{7.2, 1.4, -3.4}, 0.72},
              {{8.2, 0.5, -3.4}, 0.62}});
  add_leg(s, {{{-4.2, 3.9, 2.0}, 1.9},
              {{-2.4, 2.7, 3.4}, 1.25},
              {{-4.0, 1.1, 3.6}, 0.76},
              {{-3.0, 0.4, 3.7}, 0.66}});
  add_leg(s, {{{-4.6, 3.9, -0.4}, 1.9},
              {{-5.2, 2.4, -2.6}, 1.2},
              {{-6.6, 1.0, -2.8}, 0.76},
              {{-5.6, 0.4, -2.9}, 0.66}});
  // A crest of spikes that lean back along the spine.
  for (int i = 0; i < 30; ++i) {
    const double t = 0.03 + 0.93 * i / 29.0;
    const PathPoint p = on_path(spine(), t);
    const Vec along = normalize(on_path(spine(), t + 0.01).position - p.position);
    // On the tail and body the crest points up, on the neck away from its bend, to the left.
    const Vec wish = mix(Vec(0.0, 1.0, 0.0), Vec(-1.0, 0.25, 0.0), smoothstep(0.66, 0.78, t));
    const Vec up = normalize(wish - along * dot(wish, along));
    const double size = 0.45 + 0.3 * p.radius;
    const Vec root = p.position + up * (p.radius - 0.25);
    s.limb({{root, 0.42 * size + 0.12},
            {root + up * (0.7 * size) - along * 0.15, 0.3 * size + 0.06},
            {root + up * (1.3 * size) - along * (0.55 * size), 0.1}},
           4, 0.25);
  }
  return s;
}

}  // namespace

Mesh dragon(std::size_t triangles) {
  // Scales are as fine as the triangles can show: about five triangles across one.
  const double fine = triangles > 100'000 ? 2.1 : 1.35;
  const Relief scales = [fine](const Vec& p, const Vec& n) {
    const Cellular c = cellular_noise(p * fine, 11);
    const double edge = smoothstep(0.0, 0.35, c.second - c.nearest);
    const double dome = 1.0 - c.nearest * c.nearest;
    // The belly is smoother than the back.
    const double strength = mix(0.45, 1.0, smoothstep(-0.8, 0.3, n.y));
    return strength * (0.2 / fine) * (0.55 * edge + 0.45 * dome - 0.6) +
           0.03 * fractal_noise(p * 0.9, 3, 12);
  };
  Mesh mesh = finished(sculpt(), triangles, 1, scales);
  mesh = moved(std::move(mesh), Frame{}.turned({0.0, 1.0, 0.0}, -22.0));
  fit(mesh);
  return mesh;
}

}  // namespace encore::scene::samples
