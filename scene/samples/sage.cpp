#include "scene/samples/creatures.h"
#include "scene/samples/mesh_tools.h"
#include "scene/samples/noise.h"
#include "scene/samples/sculpture.h"

namespace encore::scene::samples {

namespace {

/// A seat of two rows of petals, the upper ones standing, the lower ones hanging.
void add_lotus(Sculpture& s) {
  s.ellipsoid({{0.0, 1.4, 0.4}}, {8.0, 1.6, 6.6}, 0.5);
  constexpr int kPetals = 18;
  for (int i = 0; i < 2 * kPetals; ++i) {
    const bool upper = i < kPetals;
    const double degrees = 360.0 / kPetals * (i + (upper ? 0.0 : 0.5));
    const Vec out(portable_sin_degrees(degrees), 0.0, portable_cos_degrees(degrees));
    Frame petal{Vec(out.x * 7.8, upper ? 1.9 : 0.6, 0.4 + out.z * 6.4), cross(kY, out), kY, out};
    petal = petal.turned(petal.x, upper ? 28.0 : 62.0);
    s.ellipsoid(petal, {1.25, 1.75, 0.55}, 0.12);
  }
}

void add_body(Sculpture& s) {
  s.ellipsoid({{0.0, 8.0, 0.6}}, {4.5, 4.5, 3.8}, 1.2);
  s.ellipsoid({{0.0, 12.2, -0.1}}, {4.4, 3.4, 2.9}, 1.8);
  s.limb({{{0.0, 14.4, -0.2}, 1.7}, {{0.0, 16.6, 0.0}, 1.35}}, 3, 0.9);
  for (const double side : {-1.0, 1.0}) {
    const auto at = [&](double x, double y, double z) { return Vec(side * x, y, z); };
    s.limb({{at(3.4, 14.2, -0.4), 1.7},
            {at(5.5, 12.4, -0.2), 1.75},
            {at(6.2, 9.2, 0.7), 1.45},
            {at(4.3, 6.9, 3.5), 1.2},
            {at(2.0, 6.2, 5.2), 0.9}},
           16, 0.6);
    s.limb({{at(2.2, 4.3, -1.2), 2.6},
            {at(6.2, 4.2, 1.2), 2.2},
            {at(6.4, 3.7, 3.4), 1.7},
            {at(1.5, 3.6, 5.3), 1.35},
            {at(-1.6, 3.6, 5.2), 1.1}},
           18, 0.7);
    // The hands rest in each other, fingers slightly apart, thumbs touching.
    s.ellipsoid({at(1.2, 6.0, 5.6)}, {1.3, 0.55, 0.95}, 0.35);
    for (int finger = 0; finger < 4; ++finger) {
      const double z = 5.1 + 0.45 * finger;
      s.limb({{at(1.2, 5.95, z), 0.3}, {at(-0.6, 5.75, z + 0.1), 0.26}}, 2, 0.1);
    }
    s.limb({{at(1.7, 6.4, 5.3), 0.36}, {at(0.9, 7.0, 5.6), 0.3}, {at(0.1, 7.15, 5.7), 0.26}}, 4,
           0.15);
  }
  s.carve_ellipsoid({{0.0, 7.6, 4.45}}, {0.3, 0.36, 0.5}, 0.25);
}

void add_head(Sculpture& s) {
  s.ellipsoid({{0.0, 18.9, 0.2}}, {2.45, 2.9, 2.6}, 0.7);
  s.ball({0.0, 21.7, -0.2}, 1.35, 0.5);
  s.ellipsoid({{0.0, 17.2, 1.2}}, {1.5, 1.1, 1.35}, 0.9);
  s.limb({{{0.0, 19.5, 2.62}, 0.24}, {{0.0, 18.6, 3.0}, 0.36}, {{0.0, 18.25, 3.12}, 0.42}}, 4, 0.3);
  s.ball({0.0, 20.05, 2.62}, 0.2, 0.1);
  for (const double side : {-1.0, 1.0}) {
    const auto at = [&](double x, double y, double z) { return Vec(side * x, y, z); };
    s.ellipsoid(Frame{at(2.5, 18.3, 0.0)}.turned(kZ, side * 6.0), {0.4, 1.7, 0.75}, 0.2);
    s.carve_ellipsoid(Frame{at(1.0, 19.1, 2.75)}, {0.75, 0.42, 0.45}, 0.35);
    s.ellipsoid({at(1.0, 19.0, 2.2)}, {0.68, 0.42, 0.45}, 0.06);
    s.limb({{at(0.25, 19.55, 2.75), 0.12}, {at(1.0, 19.85, 2.55), 0.17}, {at(1.8, 19.5, 2.0), 0.1}},
           5, 0.2);
    s.ball(at(0.4, 18.15, 2.85), 0.28, 0.2);
    s.ball(at(1.35, 17.95, 1.75), 0.7, 0.7);
    // A smile: the lips rise towards the corners.
    s.limb({{at(0.0, 17.4, 2.6), 0.22}, {at(0.5, 17.45, 2.5), 0.2}, {at(1.05, 17.75, 2.15), 0.1}},
           5, 0.1);
    s.limb({{at(0.0, 17.05, 2.5), 0.26}, {at(0.45, 17.15, 2.42), 0.22}, {at(0.85, 17.5, 2.2), 0.1}},
           5, 0.1);
  }
}

/// 1 where the robe covers the figure: all but head, right shoulder and arm, hands and lotus.
double robe(const Vec& p) {
  const double sash = p.x * 0.8 - (p.y - 11.6);
  const double draped = smoothstep(-0.25, 0.25, sash);
  const double hands = smoothstep(2.9, 3.4, std::abs(p.x)) + smoothstep(4.8, 4.4, p.z);
  return draped * smoothstep(2.4, 2.9, p.y) * smoothstep(16.2, 15.2, p.y) * clamp(hands, 0.0, 1.0);
}

double relief(const Vec& p, const Vec& n) {
  const double grain = 0.012 * fractal_noise(p * 3.0, 2, 31);
  // Curls cover the head above the hairline, which drops towards the back.
  const double hairline = 20.3 - 1.3 * smoothstep(2.2, -0.4, p.z);
  const double hair = smoothstep(hairline, hairline + 0.15, p.y) * smoothstep(0.6, 0.2, n.z - n.y);
  if (hair > 0.0) {
    const Cellular c = cellular_noise(p * 1.75, 32);
    return grain + hair * (0.08 + 0.2 * (0.5 - c.nearest * c.nearest));
  }
  const double cloth = p.y < 16.5 ? robe(p) : 0.0;
  if (cloth > 0.0) {
    // Folds run across the body, bent by slow noise; ridges are sharper than valleys.
    const double bend = 2.4 * gradient_noise(p * 0.22, 33) + 0.5 * gradient_noise(p * 0.7, 34);
    const double wave = portable_sin(2.3 * (p.y + 0.55 * p.x + 0.2 * p.z) + 2.2 * bend);
    return grain + cloth * (0.14 + 0.13 * (1.0 - 2.0 * std::abs(wave)));
  }
  return grain;
}

}  // namespace

Mesh sage(std::size_t triangles, int levels) {
  Sculpture s;
  add_lotus(s);
  add_body(s);
  add_head(s);
  Mesh mesh = finished(s, triangles, levels, relief);
  mesh = moved(std::move(mesh), Frame{}.turned(kY, 14.0).turned(kX, 4.0));
  fit(mesh);
  return mesh;
}

}  // namespace encore::scene::samples
