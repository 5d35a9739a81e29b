#include "scene/samples/creatures.h"
#include "scene/samples/mesh_tools.h"
#include "scene/samples/noise.h"
#include "scene/samples/sculpture.h"

namespace encore::scene::samples {

namespace {

Sculpture cow_sculpture() {
  Sculpture s;
  s.ellipsoid({{0.0, 8.2, 0.0}}, {7.0, 3.5, 3.2}, 1.0);
  s.ball({-4.8, 8.7, 0.0}, 3.1, 1.5);
  s.ball({4.6, 8.0, 0.0}, 3.2, 1.5);
  s.ellipsoid({{-0.5, 6.4, 0.0}}, {4.5, 2.4, 2.9}, 1.5);
  s.limb({{{4.8, 9.4, 0.0}, 2.5}, {{7.0, 10.9, 0.0}, 1.9}, {{8.7, 11.7, 0.0}, 1.6}}, 5, 0.8);
  s.ellipsoid(Frame{{9.9, 11.4, 0.0}}.turned(kZ, -32.0), {2.7, 1.55, 1.5}, 0.7);
  s.ellipsoid(Frame{{11.7, 10.1, 0.0}}.turned(kZ, -32.0), {1.15, 1.1, 1.3}, 0.4);
  s.ball({-3.0, 5.0, 0.0}, 1.5, 0.6);
  s.limb({{{-7.7, 10.2, 0.0}, 0.55},
          {{-8.9, 8.8, 0.1}, 0.45},
          {{-9.0, 6.2, 0.2}, 0.42},
          {{-8.9, 5.0, 0.2}, 0.8},
          {{-8.9, 4.0, 0.2}, 0.4}},
         12, 0.3);
  for (const double side : {-1.0, 1.0}) {
    const auto at = [&](double x, double y, double out) { return Vec(x, y, side * out); };
    s.limb({{at(9.0, 12.5, 0.8), 0.62}, {at(8.9, 13.2, 1.9), 0.56}, {at(9.3, 14.4, 2.5), 0.4}}, 6,
           0.2);
    s.ellipsoid(Frame{at(8.1, 11.9, 2.3)}.turned({1.0, 0.0, 0.0}, side * 20.0), {0.55, 0.65, 1.7},
                0.3);
    s.ball(at(10.1, 12.2, 1.2), 0.42, 0.1);
    for (const double x : {-5.2, 4.7}) {
      s.limb({{at(x, 7.0, 1.7), 1.7},
              {at(x + 0.2, 4.0, 1.8), 1.0},
              {at(x - 0.1, 1.6, 1.8), 0.78},
              {at(x + 0.15, 0.6, 1.8), 0.95}},
             9, 0.6);
    }
    for (const double x : {-3.5, -2.5}) {
      s.limb({{at(x, 4.2, 0.6), 0.4}, {at(x, 3.4, 0.65), 0.34}}, 2, 0.2);
    }
  }
  return s;
}

/// Brown patches on cream, pink at muzzle and udder, dark hooves.
glm::vec3 cow_color(const Vec& p) {
  const Vec cream(0.93, 0.89, 0.82);
  const Vec brown(0.36, 0.2, 0.12);
  const Vec pink(0.9, 0.62, 0.56);
  const double patches = fractal_noise(p * 0.27 + Vec(3.1, 0.7, 5.3), 3, 41);
  Vec color = mix(cream, brown, smoothstep(0.02, 0.12, patches));
  const double udder =
      smoothstep(5.6, 4.9, p.y) * smoothstep(2.2, 1.6, length(p - Vec(-3, 4.5, 0)));
  color = mix(color, pink, std::max(udder, smoothstep(11.3, 11.8, p.x)));
  color = mix(color, Vec(0.13, 0.11, 0.1), smoothstep(1.0, 0.7, p.y));
  const double horn = smoothstep(13.1, 13.5, p.y);
  return narrow(mix(color, Vec(0.85, 0.8, 0.66), horn));
}

}  // namespace

Mesh cow(std::size_t triangles) {
  Mesh mesh = finished(cow_sculpture(), triangles, 0, nullptr);
  for (const glm::vec3& p : mesh.positions) mesh.colors.push_back(cow_color(widen(p)));
  mesh = moved(std::move(mesh), Frame{}.turned({0.0, 1.0, 0.0}, -28.0));
  fit(mesh);
  return mesh;
}

Mesh spider(std::size_t triangles) {
  Mesh legs;
  for (int i = 0; i < 8; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const double turn = 50.0 - 33.0 * double(i / 2);  // two legs a pair
    const Vec out = rotate({0.0, 0.0, side}, {0.0, 1.0, 0.0}, side * turn);
    const auto at = [&](double far, double y) { return Vec(0.0, y, 0.0) + out * far; };
    Mesh leg = tube({{at(1.0, 2.6), 0.5},
                     {at(4.2, 6.6), 0.42},
                     {at(7.4, 4.4), 0.34},
                     {at(9.6, 0.6), 0.2},
                     {at(10.4, 0.1), 0.12}},
                    8, 14, true);
    append(legs, leg);
  }
  smooth_normals(legs);
  Sculpture s;
  s.ellipsoid({{0.4, 2.8, 0.0}}, {2.4, 1.5, 2.0}, 0.4);
  s.ellipsoid(Frame{{-4.6, 3.9, 0.0}}.turned(kZ, -14.0), {3.9, 3.0, 3.2}, 0.7);
  for (const double side : {-1.0, 1.0}) {
    s.limb({{{2.2, 2.6, side * 0.6}, 0.55},
            {{3.2, 2.2, side * 0.8}, 0.45},
            {{3.4, 1.2, side * 0.6}, 0.16}},
           5, 0.2);
    s.ball({2.2, 3.6, side * 0.45}, 0.42, 0.05);
    s.ball({1.8, 3.9, side * 1.0}, 0.3, 0.05);
  }
  const Relief hairy = [](const Vec& p, const Vec&) { return 0.1 * fractal_noise(p * 2.2, 2, 51); };
  Mesh mesh = finished(s, triangles - legs.triangles.size(), 0, hairy);
  mesh.material_of.assign(mesh.triangles.size(), 0);
  append(mesh, legs, 1);
  fit(mesh);
  return mesh;
}

Mesh duck(std::size_t triangles) {
  Mesh beak;
  append(beak, moved(stretched(ball(1.0, 12, 6), {1.5, 0.32, 0.95}), {{6.1, 8.0, 0.0}}));
  Mesh eyes;
  for (const double side : {-1.0, 1.0}) {
    append(eyes, moved(ball(0.36, 10, 6), {{4.9, 9.3, side * 1.35}}));
  }
  smooth_normals(beak);
  smooth_normals(eyes);
  Sculpture s;
  s.ellipsoid({{0.0, 3.4, 0.0}}, {5.4, 3.2, 3.8}, 1.0);
  s.ball({3.6, 8.2, 0.0}, 2.5, 1.2);
  s.limb({{{-3.6, 4.2, 0.0}, 2.2}, {{-5.6, 6.2, 0.0}, 0.8}}, 4, 1.2);
  for (const double side : {-1.0, 1.0}) {
    s.ellipsoid(Frame{{-0.8, 4.4, side * 3.1}}.turned(kZ, 14.0), {2.9, 1.7, 1.2}, 0.5);
  }
  Mesh mesh = finished(s, triangles - beak.triangles.size() - eyes.triangles.size(), 0, nullptr);
  mesh.material_of.assign(mesh.triangles.size(), 0);
  append(mesh, beak, 1);
  append(mesh, eyes, 2);
  return mesh;
}

}  // namespace encore::scene::samples
