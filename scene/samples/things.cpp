#include "scene/samples/things.h"

#include "scene/samples/mesh_tools.h"
#include "scene/samples/sculpture.h"
#include "scene/samples/shapes.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace encore::scene::samples {

namespace {

/// One arm of the scissors: a blade to the right, a shank and a finger ring to the left.
/// 4 * 9 - 4 = 32 and 2 * 16 * 8 = 256 triangles.
Mesh scissor_arm() {
  Mesh arm;
  const Mesh blade = prism({{-6.8, -2.3, 0},
                            {-5.6, -3.2, 0},
                            {-0.5, -0.9, 0},
                            {1.0, -0.55, 0},
                            {13.0, 0.75, 0},
                            {13.3, 1.0, 0},
                            {9.0, 1.15, 0},
                            {1.0, 0.9, 0},
                            {-1.0, 0.6, 0}},
                           0.35);
  append(arm, flat_shaded(blade), 0);
  Mesh ring = stretched(torus(2.5, 0.55, 16, 8), {1.45, 1.0, 1.0});
  smooth_normals(ring);
  // The torus lies around the y axis; turned up, it lies in the plane of the blades.
  const Frame place = Frame{{-9.2, -4.2, 0.0}}.turned(kX, 90.0).turned(kZ, 24.0);
  append(arm, moved(ring, place), 1);
  return arm;
}

}  // namespace

Mesh scissors() {
  // Two arms of 288, and a rivet of 4 * 8 - 4 = 28.
  Mesh mesh;
  const Mesh arm = scissor_arm();
  Mesh mirrored = arm;
  for (std::size_t i = 0; i < mirrored.positions.size(); ++i) {
    mirrored.positions[i].y = -mirrored.positions[i].y;
    mirrored.normals[i].y = -mirrored.normals[i].y;
  }
  for (glm::uvec3& t : mirrored.triangles) std::swap(t.y, t.z);
  for (const auto& [half, z, turn] :
       {std::tuple<const Mesh&, double, double>{arm, 0.2, 14.0}, {mirrored, -0.2, -14.0}}) {
    const Mesh placed = moved(half, Frame{{0.0, 0.0, z}}.turned(kZ, turn));
    const std::size_t first = mesh.triangles.size();
    append(mesh, placed);
    std::copy(half.material_of.begin(), half.material_of.end(),
              mesh.material_of.begin() + std::ptrdiff_t(first));
  }
  std::vector<Vec> outline;
  for (int i = 0; i < 8; ++i) {
    outline.push_back(
        {0.6 * portable_cos_degrees(45.0 * i), 0.6 * portable_sin_degrees(45.0 * i), 0.0});
  }
  append(mesh, flat_shaded(prism(outline, 1.0)), 2);
  mesh = moved(std::move(mesh), Frame{}.turned(kZ, 32.0).turned(kX, -25.0));
  fit(mesh);
  return mesh;
}

Mesh steering_wheel() {
  // Rim 2 * 36 * 12 = 864, three spokes of 2 * 8 * 6 + 12 = 108, hub 2 * 18 * 5 = 180.
  Mesh mesh;
  append(mesh, smooth(torus(12.4, 1.1, 36, 12)), 0);
  for (const double degrees : {0.0, 180.0, 90.0}) {
    const Vec out = rotate(kX, kY, -degrees);
    append(mesh,
           smooth(tube({{out * 2.2 + kY * 0.4, 0.9},
                        {out * 6.0 - kY * 0.1, 0.65},
                        {out * 10.0 + kY * 0.2, 0.65},
                        {out * 12.2, 0.8}},
                       8, 6, true)),
           1);
  }
  append(mesh, smooth(lathe({{0.0, -1.0}, {2.6, -0.9}, {3.3, 0.2}, {2.4, 1.2}, {0.0, 1.5}}, 18, 6)),
         2);
  mesh = moved(std::move(mesh), Frame{}.turned(kX, 68.0).turned(kY, -20.0));
  fit(mesh);
  return mesh;
}

Mesh mug() {
  // Cup 2 * 48 * 30 = 2,880; the handle is a tube of 2 * 15 * 19 = 570 whose open ends lie inside
  // the wall.
  Mesh mesh;
  append(mesh,
         smooth(lathe({{0.0, -9.0},
                       {4.5, -9.0},
                       {7.0, -8.9},
                       {7.9, -8.1},
                       {8.0, -6.0},
                       {8.0, 0.0},
                       {8.0, 6.0},
                       {8.0, 8.8},
                       {7.6, 9.2},
                       {7.2, 8.8},
                       {7.1, 6.0},
                       {7.1, 0.0},
                       {7.1, -6.4},
                       {6.2, -7.8},
                       {3.0, -8.0},
                       {0.0, -8.0}},
                      48, 31)),
         0);
  append(mesh,
         smooth(tube({{{7.6, 5.4, 0}, 1.15},
                      {{10.6, 5.9, 0}, 1.0},
                      {{13.2, 3.6, 0}, 0.9},
                      {{13.0, -0.8, 0}, 0.9},
                      {{10.6, -4.4, 0}, 1.0},
                      {{7.6, -5.6, 0}, 1.15}},
                     15, 19, false)),
         1);
  mesh = moved(std::move(mesh), Frame{}.turned(kY, -28.0).turned(kX, 42.0));
  fit(mesh, 25.0);
  return mesh;
}

Mesh urn() {
  // 2 * 64 * 63 = 8,064; bands of paint follow its rows.
  Mesh mesh = smooth(lathe({{0.0, -13.4},
                            {4.2, -13.4},
                            {4.4, -12.6},
                            {2.4, -11.2},
                            {3.2, -9.0},
                            {6.6, -4.0},
                            {8.2, 1.6},
                            {7.2, 6.2},
                            {4.0, 8.6},
                            {3.2, 10.4},
                            {4.6, 12.8},
                            {5.0, 13.4},
                            {4.4, 13.3},
                            {2.8, 10.4},
                            {2.6, 8.0},
                            {0.0, 7.0}},
                           64, 64));
  // All of the lathe but its two poles comes in rows of 2 * 64 triangles.
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::size_t row = t / 128;
    const bool band = row < 4 || row == 19 || row == 20 || row == 26 || (row > 43 && row < 48);
    mesh.material_of.push_back(band ? 1 : 0);
  }
  fit(mesh);
  return mesh;
}

Mesh road_wheel() {
  // Tyre 2 * 24 * 8 = 384, hub 2 * 16 * 5 = 160.
  Mesh mesh;
  append(mesh, stretched(torus(0.74, 0.26, 24, 8), {1.0, 1.3, 1.0}), 0);
  append(mesh,
         lathe({{0.0, -0.2}, {0.45, -0.26}, {0.62, -0.1}, {0.62, 0.1}, {0.45, 0.26}, {0.0, 0.2}},
               16, 6),
         1);
  smooth_normals(mesh);
  mesh = moved(std::move(mesh), Frame{}.turned(kX, 90.0));
  return mesh;
}

Mesh sports_car() {
  Mesh mesh;
  const auto ellipsoid = [](const Vec& center, const Vec& radii, int sides, int stacks) {
    return smooth(moved(stretched(ball(1.0, sides, stacks), radii), {center}));
  };
  // The glass is an ellipsoid of its own that the narrower, taller roof leaves bare all around.
  append(mesh, ellipsoid({-1.7, 5.7, 0.0}, {6.3, 2.55, 4.15}, 20, 10), 1);
  const Mesh wheel = road_wheel();
  for (const double x : {-8.3, 8.2}) {
    for (const double z : {-4.9, 4.9}) {
      const std::size_t first = mesh.triangles.size();
      append(mesh, moved(wheel, {{x, 2.2, z}}, 2.2));
      for (std::size_t i = 0; i < wheel.triangles.size(); ++i) {
        mesh.material_of[first + i] = 2 + wheel.material_of[i];
      }
    }
  }
  for (const double side : {-1.0, 1.0}) {
    append(mesh, ellipsoid({11.2, 4.3, side * 3.8}, {0.8, 0.7, 0.75}, 10, 6), 4);
    append(mesh, ellipsoid({-12.2, 4.5, side * 3.2}, {0.5, 0.4, 1.3}, 10, 6), 5);
  }
  Sculpture s;
  s.ellipsoid({{0.0, 3.5, 0.0}}, {13.4, 2.3, 5.0}, 1.0);
  s.ellipsoid({{-0.5, 2.7, 0.0}}, {12.6, 1.9, 5.5}, 1.0);
  s.ellipsoid(Frame{{-5.5, 4.6, 0.0}}.turned(kZ, 8.0), {7.4, 2.1, 4.2}, 1.4);
  s.ellipsoid({{-1.9, 5.6, 0.0}}, {5.0, 3.2, 3.3}, 0.5);
  for (const double side : {-1.0, 1.0}) {
    s.ellipsoid({{8.2, 3.1, side * 4.0}}, {4.2, 2.9, 1.9}, 1.0);
    s.ellipsoid({{-8.2, 3.3, side * 4.0}}, {4.4, 3.0, 2.1}, 1.0);
    for (const double x : {-8.3, 8.2}) {
      s.carve_disc(Frame{{x, 2.0, side * 5.9}}.turned(kX, 90.0), 2.6, 1.7, 0.3);
    }
  }
  s.carve_ellipsoid({{0.0, -3.0, 0.0}}, {60.0, 4.3, 40.0}, 0.4);
  append(mesh, finished(s, 10'474 - mesh.triangles.size(), 0, nullptr), 0);
  mesh = moved(std::move(mesh), Frame{}.turned(kY, -35.0).turned(kX, 18.0));
  fit(mesh);
  return mesh;
}

}  // namespace encore::scene::samples
