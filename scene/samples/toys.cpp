#include "scene/samples/creatures.h"
#include "scene/samples/mesh_tools.h"
#include "scene/samples/refine.h"
#include "scene/samples/scenes.h"
#include "scene/samples/shapes.h"
#include "scene/samples/stage.h"
#include "scene/samples/things.h"

#include <algorithm>
#include <cmath>

namespace encore::scene::samples {

namespace {

constexpr double kSeconds = 8.0;

/// The whole box leans towards the camera, which looks into it from the front.
const Frame& tilt() {
  static const Frame frame = Frame{{0.0, -2.2, 0.0}}.turned(kX, 48.0);
  return frame;
}

/// Only the turn of the tilt: what a moving part's own vertices need, its keys hold the rest.
glm::mat4 tilted() {
  Frame turn = tilt();
  turn.origin = Vec(0.0);
  return matrix_of(turn);
}

double wave_at(double share, double turns) {
  return portable_sin(2.0 * kPi * turns * share);
}

void put(Scene& scene, const std::string& name, Mesh mesh, std::vector<Material> materials,
         const Vec& position, double yaw = 0.0) {
  const Frame spot{tilt().world(position), tilt().x, tilt().y, tilt().z};
  place(scene, make_model(name, std::move(mesh), std::move(materials)),
        matrix_of(spot.turned(tilt().y, yaw)));
}

void put_moving(Scene& scene, const std::shared_ptr<const Model>& model, int keys,
                const std::function<Pose(double)>& pose) {
  place(scene, model, tilted()).motion = looping(tilt(), kSeconds, keys, pose);
}

/// Floor and four walls of wood; five rounded boxes of 12 * 16 = 192 triangles.
void add_box(Scene& scene) {
  Mesh box;
  const auto add = [&](const Vec& size, const Vec& center) {
    append(box, moved(rounded_box(size, 0.2, 4), {center}));
  };
  add({25.0, 0.8, 19.0}, {0.0, -0.4, 0.0});
  for (const double side : {-1.0, 1.0}) {
    add({25.0, 4.6, 0.8}, {0.0, 1.5, side * 9.2});
    add({0.8, 4.6, 17.8}, {side * 12.1, 1.5, 0.0});
  }
  put(scene, "box", smooth(std::move(box)), {paint("wood", {0.62F, 0.42F, 0.24F}, 0.12F)},
      Vec(0.0));
}

/// A beach ball of six coloured sectors (2 * 30 * 19 = 1,140) that bounces three times a loop.
void add_ball(Scene& scene) {
  Mesh mesh = smooth(ball(1.9, 30, 20));
  for (const glm::uvec3& t : mesh.triangles) {
    const Vec c =
        widen(mesh.positions[t.x]) + widen(mesh.positions[t.y]) + widen(mesh.positions[t.z]);
    // Sectors of 60 degrees, told apart without an angle: by the side of three planes.
    const bool a = c.z > 0.0;
    const bool b = c.z > 1.7320508 * c.x;
    const bool d = c.z > -1.7320508 * c.x;
    const float lowest =
        std::min(std::abs(mesh.positions[t.x].y),
                 std::min(std::abs(mesh.positions[t.y].y), std::abs(mesh.positions[t.z].y)));
    mesh.material_of.push_back(lowest > 1.6F ? 0U : (a != b) != d ? 1U : (a ? 2U : 0U));
  }
  const auto model = make_model(
      "ball", std::move(mesh),
      {paint("white", {0.92F, 0.91F, 0.88F}, 0.4F), paint("red", {0.86F, 0.18F, 0.16F}, 0.4F),
       paint("blue", {0.16F, 0.38F, 0.82F}, 0.4F)});
  put_moving(scene, model, 72, [](double share) {
    const double bounce = share * 3.0 - std::floor(share * 3.0);
    const double height = 4.0 * bounce * (1.0 - bounce);
    return Pose{{-8.2, 1.9 + 4.6 * height, 3.6}, normalize(Vec(0.4, 0.2, -1.0)), 360.0 * share};
  });
}

/// Three rings (2 * 28 * 10 = 560 each) that rise from a peg (2 * 20 * 7 = 280) one by one.
void add_ring_tower(Scene& scene) {
  put(scene, "peg",
      smooth(lathe(
          {{0.0, 0.0}, {2.6, 0.0}, {2.6, 0.45}, {0.75, 0.6}, {0.65, 3.2}, {0.5, 4.6}, {0.0, 5.0}},
          20, 8)),
      {paint("peg", {0.9F, 0.78F, 0.5F})}, {-7.4, 0.0, -4.8});
  const glm::vec3 colors[3] = {{0.18F, 0.6F, 0.36F}, {0.96F, 0.7F, 0.12F}, {0.84F, 0.24F, 0.3F}};
  for (int i = 0; i < 3; ++i) {
    const auto model =
        make_model("ring " + std::to_string(i + 1), smooth(torus(2.1 - 0.35 * i, 0.66, 28, 10)),
                   {paint("ring", colors[i], 0.4F)});
    put_moving(scene, model, 48, [i](double share) {
      // The top ring starts first and comes back last.
      const double up = smoothstep(0.1 + 0.12 * (2 - i), 0.34 + 0.12 * (2 - i), share) *
                        smoothstep(0.95 - 0.12 * (2 - i), 0.75 - 0.12 * (2 - i), share);
      return Pose{{-7.4, 1.1 + 1.25 * i + up * (1.2 + 1.0 * i), -4.8}, kY, 360.0 * share};
    });
  }
}

/// A spinning top, 2 * 28 * 19 = 1,064 triangles; baked leaning, so that turning it around the
/// vertical makes it both spin and sway.
void add_top(Scene& scene) {
  Mesh mesh = smooth(lathe({{0.0, 0.0},
                            {0.25, 0.3},
                            {1.6, 1.5},
                            {2.2, 2.2},
                            {1.7, 2.8},
                            {0.4, 3.1},
                            {0.28, 4.1},
                            {0.34, 4.4},
                            {0.0, 4.6}},
                           28, 20));
  for (const glm::uvec3& t : mesh.triangles) {
    const Vec c =
        widen(mesh.positions[t.x]) + widen(mesh.positions[t.y]) + widen(mesh.positions[t.z]);
    mesh.material_of.push_back(c.y > 9.0 ? 2U : (c.x > 0.0) != (c.z > 0.0) ? 0U : 1U);
  }
  mesh = moved(std::move(mesh), Frame{}.turned(kZ, 13.0));
  const auto model =
      make_model("spinning top", std::move(mesh),
                 {paint("violet", {0.48F, 0.24F, 0.68F}, 0.5F),
                  paint("cream", {0.95F, 0.88F, 0.7F}, 0.5F), paint("wood", {0.75F, 0.5F, 0.26F})});
  put_moving(scene, model, 96, [](double share) {
    return Pose{{1.2 + 0.8 * wave_at(share + 0.25, 1.0), 0.0, 1.6 + 0.8 * wave_at(share, 1.0)},
                kY,
                360.0 * 8.0 * share};
  });
}

/// A car that drives to and fro: body 2 * 192 triangles, four wheels of 544.
void add_car(Scene& scene) {
  const auto drive = [](double share) { return 2.0 + 4.6 * wave_at(share, 1.0); };
  Mesh body = smooth(moved(rounded_box({6.0, 1.3, 3.0}, 0.4, 4), {{0.0, 1.6, 0.0}}));
  body.material_of.assign(body.triangles.size(), 0);
  append(body, smooth(moved(rounded_box({3.0, 1.5, 2.5}, 0.45, 4), {{-0.5, 2.8, 0.0}})), 1);
  const auto body_model = make_model(
      "car body", std::move(body),
      {paint("orange", {0.95F, 0.45F, 0.1F}, 0.5F), paint("windows", {0.55F, 0.8F, 0.92F}, 0.6F)});
  put_moving(scene, body_model, 48, [&](double share) {
    return Pose{{drive(share), 0.03 * wave_at(share, 8.0), 6.3}, kY, 0.0};
  });
  const auto wheel = make_model(
      "car wheel", road_wheel(),
      {paint("tyre", {0.13F, 0.13F, 0.14F}, 0.2F), paint("hub", {0.9F, 0.85F, 0.3F}, 0.4F)});
  for (const double x : {-1.9, 1.9}) {
    for (const double z : {-1.6, 1.6}) {
      put_moving(scene, wheel, 48, [&](double share) {
        // Rolling without slipping: one radian a radius.
        return Pose{{drive(share) + x, 1.0, 6.3 + z}, kZ, -(drive(share) - 2.0) * (180.0 / kPi)};
      });
    }
  }
}

/// Three blocks of 12 * 16 = 192 triangles, one of them rocking on the other two.
void add_blocks(Scene& scene) {
  const auto block = [] { return smooth(rounded_box(Vec(2.4), 0.28, 4)); };
  put(scene, "blue block", block(), {paint("blue", {0.2F, 0.45F, 0.85F})}, {-2.6, 1.2, -6.2}, 20.0);
  put(scene, "green block", block(), {paint("green", {0.4F, 0.72F, 0.25F})}, {0.4, 1.2, -6.4},
      -12.0);
  const auto top = make_model("yellow block", block(), {paint("yellow", {0.98F, 0.82F, 0.2F})});
  put_moving(scene, top, 32, [](double share) {
    return Pose{{-1.1, 3.65, -6.3}, kY, 38.0 * wave_at(share, 1.0)};
  });
}

/// A robot that turns its head and swings its arms; 2 * 192 + 2 * 80 + 2 * 108 + 108 * 2 + 92.
void add_robot(Scene& scene) {
  const Vec at(7.6, 0.0, -4.4);
  const Material steel = paint("steel", {0.6F, 0.68F, 0.74F}, 0.5F);
  const Material red = paint("red", {0.85F, 0.2F, 0.18F}, 0.4F);
  Mesh torso = smooth(moved(rounded_box({3.0, 3.0, 2.0}, 0.3, 4), {{0.0, 3.2, 0.0}}));
  torso.material_of.assign(torso.triangles.size(), 0);
  for (const double side : {-0.8, 0.8}) {
    append(torso,
           smooth(tube({{{side, 0.0, 0.2}, 0.75}, {{side, 0.9, 0.0}, 0.5}, {{side, 2.2, 0.0}, 0.5}},
                       8, 6, true)),
           1);
  }
  put(scene, "robot", std::move(torso), {steel, red}, at, -20.0);
  Mesh head = smooth(rounded_box({2.2, 1.8, 1.8}, 0.3, 4));
  head.material_of.assign(head.triangles.size(), 0);
  for (const double side : {-0.5, 0.5}) {
    append(head, smooth(moved(ball(0.36, 8, 6), {{side, 0.15, 0.9}})), 1);
  }
  append(head,
         smooth(tube({{{0.0, 0.8, 0.0}, 0.16},
                      {{0.0, 1.5, 0.0}, 0.14},
                      {{0.0, 1.9, 0.0}, 0.34},
                      {{0.0, 2.1, 0.0}, 0.1}},
                     8, 5, true)),
         2);
  const auto head_model = make_model("robot head", std::move(head),
                                     {steel, paint("eyes", {0.98F, 0.9F, 0.3F}, 0.6F), red});
  put_moving(scene, head_model, 32, [at](double share) {
    return Pose{at + Vec(0.0, 5.7, 0.0), kY, -20.0 + 40.0 * wave_at(share, 1.0)};
  });
  const auto arm = make_model(
      "robot arm",
      smooth(tube({{{0.0, 0.0, 0.0}, 0.5}, {{0.0, -1.2, 0.0}, 0.4}, {{0.0, -2.4, 0.3}, 0.55}}, 8, 6,
                  true)),
      {red});
  for (const double side : {-1.0, 1.0}) {
    const Vec shoulder = at + rotate({side * 2.0, 4.2, 0.0}, kY, -20.0);
    const Vec hinge = rotate(kX, kY, -20.0);
    put_moving(scene, arm, 32, [=](double share) {
      return Pose{shoulder, hinge, side * 50.0 * wave_at(share, 2.0) - 20.0};
    });
  }
}

/// A duck of 1,200 triangles that rocks.
void add_duck(Scene& scene) {
  Mesh mesh = duck(1'200);
  mesh = moved(std::move(mesh), Frame{}.turned(kY, -145.0), 0.46);
  const auto model = make_model(
      "duck", std::move(mesh),
      {paint("duck", {1.0F, 0.82F, 0.15F}, 0.4F), paint("beak", {0.95F, 0.45F, 0.1F}, 0.3F),
       paint("eyes", {0.08F, 0.08F, 0.09F}, 0.8F)});
  put_moving(scene, model, 32, [](double share) {
    return Pose{{7.4, 0.0, 1.2}, normalize(Vec(-0.8, 0.0, 0.6)), 9.0 * wave_at(share, 4.0)};
  });
}

}  // namespace

Scene toys() {
  Scene scene = stage("toys");
  add_box(scene);
  add_ball(scene);
  add_ring_tower(scene);
  add_top(scene);
  add_car(scene);
  add_blocks(scene);
  add_robot(scene);
  add_duck(scene);
  // A cloth at the bottom of the box makes up the exact count; it is open at its rim, so the odd
  // number comes out by splitting an edge there.
  Mesh cloth = uv_grid(20, 15, false, false, [](double u, double v) {
    return Vec(22.6 * (u - 0.5), 0.03, 16.6 * (0.5 - v));
  });
  split_to(cloth, missing_to(scene, 11'141));
  put(scene, "cloth", smooth(std::move(cloth)), {paint("felt", {0.36F, 0.55F, 0.52F}, 0.0F)},
      Vec(0.0));
  return scene;
}

}  // namespace encore::scene::samples
